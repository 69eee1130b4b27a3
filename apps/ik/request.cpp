#include "apps/ik/request.h"

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/json_file.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

using nlohmann::json;

constexpr const char* kWhere = "request";

json parsed(const std::string& body) {
  json request = parseJson(body, kWhere);
  for (const auto& [key, value] : request.items()) {
    if (key != "targets" && key != "prior" && key != "solver") {
      throw Error(fmt::format("there is no key '{}'", key), kWhere, "keys are targets, prior, solver");
    }
  }
  return request;
}

JointTargets targetsOf(const json& request) {
  if (!request.contains("targets") || !request["targets"].is_object() || request["targets"].empty()) {
    throw Error("targets must be an object with at least one joint", kWhere);
  }
  JointTargets targets;
  for (const auto& [name, p] : request["targets"].items()) {
    const auto joint = jointNamed(name);
    if (!joint)
      throw Error(fmt::format("there is no joint '{}'", name), kWhere, fmt::format("{}", fmt::join(kJointNames, " ")));
    const auto is_number = [](const json& value) { return value.is_number(); };
    if (!p.is_array() || p.size() != 3 || !std::all_of(p.begin(), p.end(), is_number)) {
      throw Error(fmt::format("the target of '{}' must be [x, y, z]", name), kWhere);
    }
    const std::string refused = targets.add(*joint, {p[0].get<double>(), p[1].get<double>(), p[2].get<double>()});
    if (!refused.empty()) throw Error(refused, kWhere);
  }
  return targets;
}

std::string textOf(const json& request, const char* key) {
  if (!request.contains(key)) return {};
  if (!request[key].is_string()) throw Error(fmt::format("{} must be a text", key), kWhere);
  return request[key].get<std::string>();
}

// Micrometres and microradians are enough.
double rounded(double value) {
  return std::round(value * 1e6) / 1e6;
}

json listOf(const Eigen::Vector3d& p) {
  return {rounded(p.x()), rounded(p.y()), rounded(p.z())};
}

}  // namespace

IkRequests::IkRequests(const IkCommandOptions& options) : skeleton_(ikSkeleton(options)) {
  const auto learned = ikLearnedPoses(options);
  for (int prior = 0; prior < kIkPriorCount; ++prior) {
    IkConfig config;
    config.prior = static_cast<IkPrior>(prior);
    lm_.emplace_back(skeleton_, config, learned);
  }
  for (const IkMethod method : {IkMethod::Jacobian, IkMethod::Ccd, IkMethod::Fabrik}) {
    IkConfig config;
    config.method = method;
    classic_.emplace_back(skeleton_, config, nullptr);
  }
}

std::string IkRequests::answer(const std::string& body) const {
  const json request = parsed(body);
  const JointTargets targets = targetsOf(request);
  const std::string solver_name = textOf(request, "solver");
  const std::string prior_name = textOf(request, "prior");
  const IkMethod method = solver_name.empty() ? IkMethod::Lm : ikMethodNamed(solver_name);
  const IkPrior prior = prior_name.empty() ? defaultPrior(method) : ikPriorNamed(prior_name);
  if (method != IkMethod::Lm && prior != IkPrior::None) throw Error("a prior needs the solver lm", kWhere);
  const IkSolver& solver =
      method == IkMethod::Lm ? lm_[static_cast<std::size_t>(prior)] : classic_[static_cast<std::size_t>(method) - 1];
  const auto start = std::chrono::steady_clock::now();
  const IkResult result = solver.solve(targets);
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  const JointPositions positions = jointPositions(skeleton_, result.q);
  json joints;
  for (int i = 0; i < kJointCount; ++i) {
    joints[std::string(kJointNames[static_cast<std::size_t>(i)])] = listOf(positions.col(i));
  }
  json rotations;
  for (int i = 0; i < kBoneCount; ++i) {
    const Eigen::Quaterniond r(localRotation(static_cast<Bone>(i), result.q));
    rotations[std::string(kBoneNames[static_cast<std::size_t>(i)])] = {rounded(r.w()), rounded(r.x()), rounded(r.y()),
                                                                       rounded(r.z())};
  }
  return json{{"joints", joints},
              {"rotations", rotations},
              {"root", listOf(result.q.head<3>())},
              {"residual_m", rounded(result.residual_m)},
              {"ms", time.count()}}
      .dump();
}

}  // namespace depthmocap
