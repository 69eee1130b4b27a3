// Models, actors, calibrations and inverse kinematics, with public headers only.
#include <gtest/gtest.h>

#include "depthmocap/depthmocap.h"

namespace depthmocap {
namespace {

TEST(Models, NamesTheFileThatIsMissing) {
  try {
    static_cast<void>(Models::load("no/such.forest", {}));
    FAIL() << "loaded";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no/such.forest"), std::string::npos);
  }
}

TEST(Actor, AnAverageOneHasTheStatureThatIsAskedFor) {
  EXPECT_NEAR(averageActor(1.90).stature_m(), 1.90, 1e-9);
  EXPECT_THROW(static_cast<void>(averageActor(5)), Error);
}

TEST(Calibration, AdvisesAndSaysWhatIsMissing) {
  const CameraModel camera;
  Calibration calibration(Models::shipped(), camera);
  const CalibrationAdvice advice = calibration.add({0, 0.0, DepthImage(camera.width, camera.height, 0.0F)});
  EXPECT_FALSE(advice.good);
  EXPECT_FALSE(advice.text.empty());
  EXPECT_EQ(advice.good_frames, 0);
  EXPECT_FALSE(calibration.enough());
  EXPECT_THROW(static_cast<void>(calibration.solve()), Error);
}

TEST(Calibration, RefusesOptionsOutOfRange) {
  CalibrationOptions options;
  options.frames = 0;
  EXPECT_THROW(Calibration(Models::shipped(), CameraModel{}, options), Error);
}

class IkPriors : public testing::TestWithParam<IkPrior> {};

TEST_P(IkPriors, ReachTargetsOfABody) {
  IkOptions options;
  options.prior = GetParam();
  const Ik ik(averageActor(1.75), options);
  Pose q = Pose::Zero();
  q[kRootTy] = 0.95;
  q[kLhumerusRz] = -0.8;
  const JointPositions truth = ik.joints(q);
  JointTargets targets;
  for (const Joint joint : {Joint::Head, Joint::LeftWrist, Joint::RightWrist, Joint::LeftAnkle, Joint::RightAnkle}) {
    EXPECT_EQ(targets.add(joint, truth.col(static_cast<int>(joint))), "");
  }
  const IkResult result = ik.solve(targets);
  EXPECT_LT(result.residual_m, 0.02);
  const auto wrist = static_cast<int>(Joint::LeftWrist);
  EXPECT_LT((ik.joints(result.q).col(wrist) - truth.col(wrist)).norm(), 0.03);
}

INSTANTIATE_TEST_SUITE_P(All, IkPriors, testing::Values(IkPrior::None, IkPrior::Gmm, IkPrior::Vae),
                         [](const auto& tested) {
                           return std::string(kIkPriorNames[static_cast<std::size_t>(tested.param)]);
                         });

TEST(Ik, RefusesWhatDoesNotGoTogether) {
  IkOptions options;
  options.method = IkMethod::Fabrik;
  options.prior = IkPrior::Gmm;
  EXPECT_THROW(Ik{options}, Error);
}

TEST(Ik, NeedsATarget) {
  EXPECT_THROW(static_cast<void>(Ik().solve({})), Error);
}

TEST(Version, IsOneNumber) {
  EXPECT_EQ(DEPTHMOCAP_VERSION_STRING, std::to_string(DEPTHMOCAP_VERSION_MAJOR) + "." +
                                           std::to_string(DEPTHMOCAP_VERSION_MINOR) + "." +
                                           std::to_string(DEPTHMOCAP_VERSION_PATCH));
}

}  // namespace
}  // namespace depthmocap
