#include <Eigen/Geometry>
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

TEST(IkRequests, APriorOfMoreWeightLeavesTargetsFartherOff) {
  const auto residual = [&](const char* weight) {
    const json answer = json::parse(requests().answer(withTargets(std::string(R"(, "prior_weight_m": )") + weight)));
    return answer["residual_m"].get<double>();
  };
  EXPECT_LT(residual("0"), residual("0.02"));
  EXPECT_EQ(residual("0.001"), json::parse(requests().answer(withTargets("")))["residual_m"].get<double>());
}

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Vector3d vectorOf(const json& list) {
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

// The joints at which bones start, and by which names.
const std::pair<const char*, const char*> kJointBones[] = {
    {"pelvis", "Hips"},           {"spine", "Spine"},           {"neck", "Neck"},
    {"left_shoulder", "LeftArm"}, {"left_wrist", "LeftHand"},   {"right_elbow", "RightForeArm"},
    {"left_knee", "LeftLeg"},     {"right_ankle", "RightFoot"}, {"right_toe", "RightToeBase"}};

// Where the nodes of a glTF viewer end up.
Vector3d placeInGltf(const json& bones, const std::string& name, Matrix3d& R_world) {
  const json& bone = bones[name];
  Vector3d p_parent = Vector3d::Zero();
  Matrix3d R_parent = Matrix3d::Identity();
  if (bone.contains("parent")) p_parent = placeInGltf(bones, bone["parent"], R_parent);
  const json& r = bone["rotation"];
  R_world = R_parent * Quaterniond(r[3], r[0], r[1], r[2]).normalized().toRotationMatrix();
  return p_parent + R_parent * vectorOf(bone["translation"]);
}

TEST(IkRequests, BonesOfGltfLeadToTheJoints) {
  const json answer = json::parse(requests().answer(withTargets(R"(, "bones": "gltf")")));
  EXPECT_EQ(answer["bones"].size(), 25U);
  for (const auto& [joint, bone] : kJointBones) {
    Matrix3d R;
    EXPECT_LT((placeInGltf(answer["bones"], bone, R) - vectorOf(answer["joints"][joint])).norm(), 1e-4) << joint;
  }
}

// The rest matrix of a bone in Blender: y along the bone, z as align_roll() has it.
Matrix3d restOf(const json& bone) {
  const Vector3d y = (vectorOf(bone["tail"]) - vectorOf(bone["head"])).normalized();
  const Vector3d z = vectorOf(bone["z_axis"]);
  return (Matrix3d() << y.cross(z), y, z).finished();
}

// pose = pose of parent * inverse rest of parent * rest * basis, as Blender has it.
Vector3d placeInBlender(const json& bones, const std::string& name, Matrix3d& R_pose) {
  const json& bone = bones[name];
  const json& r = bone["rotation_quaternion"];
  const Matrix3d basis = Quaterniond(r[0], r[1], r[2], r[3]).normalized().toRotationMatrix();
  const Matrix3d rest = restOf(bone);
  if (!bone.contains("parent")) {
    R_pose = rest * basis;
    return vectorOf(bone["head"]) + rest * vectorOf(bone["location"]);
  }
  Matrix3d R_parent;
  const Vector3d p_parent = placeInBlender(bones, bone["parent"], R_parent);
  const json& parent = bones[bone["parent"].get<std::string>()];
  const Matrix3d to_parent = R_parent * restOf(parent).transpose();
  R_pose = to_parent * rest * basis;
  return p_parent + to_parent * (vectorOf(bone["head"]) - vectorOf(parent["head"]));
}

TEST(IkRequests, BonesOfBlenderLeadToTheJoints) {
  const json answer = json::parse(requests().answer(withTargets(R"(, "bones": "blender")")));
  EXPECT_EQ(answer["bones"].size(), 20U);
  for (const auto& [joint, bone] : kJointBones) {
    Matrix3d R;
    const Vector3d p = placeInBlender(answer["bones"], bone, R);
    EXPECT_LT((Vector3d(p.x(), p.z(), -p.y()) - vectorOf(answer["joints"][joint])).norm(), 1e-4) << joint;
  }
  for (const auto& [name, bone] : answer["bones"].items()) {
    EXPECT_NEAR(restOf(bone).determinant(), 1, 1e-4) << name;
  }
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
      {withTargets(R"(, "prior_weight_m": -1)"), "a number from 0 to 1"},
      {withTargets(R"(, "prior_weight_m": 2)"), "a number from 0 to 1"},
      {withTargets(R"(, "prior_weight_m": 0.1, "solver": "ccd")"), "need the solver lm"},
      {withTargets(R"(, "bones": "unity")"), "bones must be one of gltf, blender"},
      {withTargets(R"(, "weight": 3)"), "no key 'weight'"}};
  for (const auto& [body, reason] : cases) {
    const std::string error = errorOf([&, &text = body] { (void)requests().answer(text); });
    EXPECT_NE(error.find(reason), std::string::npos) << body << ": " << error;
  }
}

}  // namespace
}  // namespace depthmocap
