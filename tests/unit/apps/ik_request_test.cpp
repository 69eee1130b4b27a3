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

TEST(IkRequests, GoesOnFromAPoseAndHoldsJoints) {
  const json first = json::parse(requests().answer(withTargets("")));
  ASSERT_EQ(first["pose"].size(), 36U);
  // Dragged by 2 cm while the ankles stay.
  const json dragged = {{"targets", {{"left_wrist", {0.42, 1.2, 0.3}}}},
                        {"start", first["pose"]},
                        {"hold", {"left_ankle", "right_ankle", "head"}}};
  const json answer = json::parse(requests().answer(dragged.dump()));
  EXPECT_LT(answer["residual_m"].get<double>(), 0.01);
  for (const char* joint : {"left_ankle", "right_ankle", "right_wrist"}) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(answer["joints"][joint][axis].get<double>(), first["joints"][joint][axis].get<double>(), 0.02);
    }
  }
}

TEST(IkRequests, AHeavyJointComesNearerThanALightOne) {
  // Farther apart than arms reach.
  const char* const far =
      R"({"targets": {"left_wrist": [0.9, 1.3, 0], "right_wrist": [-0.9, 1.3, 0]}, "weights": {"left_wrist": %}})";
  const auto missedBy = [&](const char* weight) {
    std::string request = far;
    request.replace(request.find('%'), 1, weight);
    const json answer = json::parse(requests().answer(request));
    return std::abs(answer["joints"]["left_wrist"][0].get<double>() - 0.9);
  };
  EXPECT_LT(missedBy("10"), 0.5 * missedBy("0.1"));
}

TEST(IkRequests, SaysWhatIsWrong) {
  const std::pair<std::string, const char*> cases[] = {
      {"", "is not valid JSON"},
      {"[1]", "must hold a JSON object"},
      {"{}", "targets must be"},
      {withTargets(R"(, "weights": {"neck": 1})"), "'neck' has a weight but no target"},
      {withTargets(R"(, "weights": {"head": 0})"), "must be above 0"},
      {withTargets(R"(, "weights": 3)"), "weights must be"},
      {withTargets(R"(, "start": [1, 2])"), "36 numbers"},
      {withTargets(R"(, "hold": ["neck"])"), "hold needs a start"},
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
