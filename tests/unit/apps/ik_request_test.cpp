#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include "apps/ik/request.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

using nlohmann::json;

const IkRequests& requests() {
  static const IkRequests all(
      {.actor = {}, .priors = std::filesystem::path(DEPTHMOCAP_SOURCE_DIR) / "forest/models/pose_priors.bin"});
  return all;
}

constexpr const char* kTargets =
    R"("targets": {"left_wrist": [0.4, 1.2, 0.3], "right_ankle": [-0.1, 0.1, 0], "head": [0, 1.6, 0]})";

std::string withTargets(const std::string& more) {
  return std::string("{") + kTargets + more + "}";
}

TEST(IkRequests, AnswersWithTheWholeBody) {
  const json answer = json::parse(requests().answer(withTargets("")));
  EXPECT_EQ(answer["joints"].size(), 18U);
  EXPECT_EQ(answer["rotations"].size(), 16U);
  EXPECT_NEAR(answer["joints"]["left_wrist"][0].get<double>(), 0.4, 0.02);
  EXPECT_EQ(answer["root"].size(), 3U);
  EXPECT_LT(answer["residual_m"].get<double>(), 0.02);
  EXPECT_GT(answer["ms"].get<double>(), 0);
  for (const auto& [bone, r] : answer["rotations"].items()) {
    double norm = 0;
    for (const double x : r) norm += x * x;
    EXPECT_NEAR(norm, 1, 1e-5) << bone;
  }
}

TEST(IkRequests, TakesEachPriorAndSolver) {
  for (const auto prior : kIkPriorNames) {
    const json answer = json::parse(requests().answer(withTargets(R"(, "prior": ")" + std::string(prior) + "\"")));
    EXPECT_LT(answer["residual_m"].get<double>(), 0.05) << prior;
  }
  for (const auto solver : kIkMethodNames) {
    const json answer = json::parse(requests().answer(withTargets(R"(, "solver": ")" + std::string(solver) + "\"")));
    EXPECT_LT(answer["residual_m"].get<double>(), 0.05) << solver;
  }
}

TEST(IkRequests, SaysWhatIsWrong) {
  const std::pair<std::string, const char*> cases[] = {
      {"", "is not valid JSON"},
      {"[1]", "must hold a JSON object"},
      {"{}", "targets must be"},
      {R"({"targets": {}})", "targets must be"},
      {R"({"targets": {"left_hand": [0, 0, 0]}})", "no joint 'left_hand'"},
      {R"({"targets": {"head": [0, 0]}})", "must be [x, y, z]"},
      {R"({"targets": {"head": [0, "a", 0]}})", "must be [x, y, z]"},
      {R"({"targets": {"head": [0, 1600, 0]}})", "in metres"},
      {R"({"targets": {"head": [0, 1e999, 0]}})", "request"},
      {withTargets(R"(, "prior": "dream")"), "there is no such prior"},
      {withTargets(R"(, "prior": 3)"), "must be a text"},
      {withTargets(R"(, "solver": "ccd", "prior": "vae")"), "needs the solver lm"},
      {withTargets(R"(, "weight": 3)"), "no key 'weight'"}};
  for (const auto& [body, reason] : cases) {
    const std::string error = errorOf([&, &text = body] { (void)requests().answer(text); });
    EXPECT_NE(error.find(reason), std::string::npos) << body << ": " << error;
  }
}

}  // namespace
}  // namespace depthmocap
