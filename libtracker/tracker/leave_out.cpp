#include "libtracker/tracker/leave_out.h"

#include <algorithm>
#include <array>
#include <limits>

#include "depthmocap/error.h"

namespace depthmocap {
namespace {

struct OptionalPart {
  const char* name;
  void (*leaveOut)(TrackerConfig&);
};

void takePaperWeights(TrackerConfig& config) {
  const MapConfig paper = paperConfig().solve;
  config.solve.lambda_prior = std::min(config.solve.lambda_prior, paper.lambda_prior);  // 0 stays 0
  config.solve.lambda_smooth = std::min(config.solve.lambda_smooth, paper.lambda_smooth);
  config.solve.lambda_surface = paper.lambda_surface;
  config.solve.velocity_share = paper.velocity_share;
}

// With the weight that is best for the paper's subspace.
void takePaperPrior(TrackerConfig& config) {
  constexpr double kSubspaceWeight = 30.0;
  config.prior = paperConfig().prior;
  config.solve.lambda_prior = std::min(config.solve.lambda_prior, kSubspaceWeight);
}

constexpr std::array<OptionalPart, 10> kParts = {{
    {"prior", [](TrackerConfig& c) { c.solve.lambda_prior = 0; }},
    {"smooth", [](TrackerConfig& c) { c.solve.lambda_smooth = 0; }},
    {"limits", [](TrackerConfig& c) { c.solve.lambda_limit = 0; }},
    {"push-in", [](TrackerConfig& c) { c.markers.push_in = false; }},
    {"dense", [](TrackerConfig& c) { c.policy.dense_rounds = 0; }},
    {"sides", [](TrackerConfig& c) { c.policy.expect_sides = false; }},
    {"feet", [](TrackerConfig& c) { c.policy.hold_feet = false; }},
    {"recovery",
     [](TrackerConfig& c) { c.policy.suspect_rms_m = c.policy.suspect_misfit = std::numeric_limits<double>::max(); }},
    {"gaussian", takePaperPrior},
    {"weights", takePaperWeights},
}};

}  // namespace

std::vector<std::string> optionalParts() {
  std::vector<std::string> names;
  names.reserve(kParts.size());
  for (const OptionalPart& part : kParts) names.emplace_back(part.name);
  return names;
}

void leaveOut(const std::string& name, TrackerConfig& config) {
  const auto part = std::find_if(kParts.begin(), kParts.end(), [&](const auto& p) { return name == p.name; });
  if (part != kParts.end()) return part->leaveOut(config);
  std::string names;
  for (const OptionalPart& p : kParts) names += (names.empty() ? "" : ", ") + std::string(p.name);
  throw Error("'" + name + "' is no part that can be left out", "TrackerConfig", "there are " + names);
}

}  // namespace depthmocap
