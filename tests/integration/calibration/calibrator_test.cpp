#include "calibration/calibrator.h"

#include <cmath>

#include <gtest/gtest.h>

#include "libtracker/body/builtin_body.h"
#include "libtracker/body/makehuman_model.h"
#include "tests/integration/calibration/tpose_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/body/makehuman_data.h"

namespace depthmocap {
namespace {

constexpr double kDegree = 3.14159265358979 / 180.0;

BodySurface adult(Sex sex, double stature_m, double weight_kg) {
  return makeBuiltinBody({sex, stature_m, weight_kg});
}

// Ten frames with a little sway and new noise in each.
Actor calibrated(const Stander& actor, SensorKind kind, const CalibratorConfig& config = {}) {
  const CameraModel camera = sensorCamera(kind);
  Calibrator calibrator(shippedModels(), camera, config);
  for (int i = 0; i < 10; ++i) {
    Stander swaying = actor;
    swaying.q[kRootTx] += 0.004 * std::sin(0.7 * i);
    swaying.q[kUpperbackRz] += 0.01 * std::cos(0.9 * i);
    const TPoseVerdict verdict = calibrator.add(photograph({swaying}, kind, camera, i));
    EXPECT_TRUE(verdict.good()) << verdict.advice;
  }
  return calibrator.solve();
}

// Arms and legs: within 2.5 cm in the mean and 5 cm each; the stature within 2 cm.
void expectNear(const Actor& actor, const BodySurface& truth) {
  const LengthVector error = lengthVector(actor.skeleton.lengths) - lengthVector(truth.skeleton.lengths);
  EXPECT_NEAR(actor.stature_m(), statureOf(truth.skeleton.lengths), 0.02);
  EXPECT_LT(error.head<4>().cwiseAbs().mean(), 0.025) << error.transpose();
  EXPECT_LT(error.head<4>().cwiseAbs().maxCoeff(), 0.05) << error.transpose();
}

TEST(Calibrator, MeasuresASmallWoman) {
  const BodySurface body = adult(Sex::Female, 1.52, 47);
  const Actor actor = calibrated(standing(body, 0, 2.5), SensorKind::Kinect1);
  expectNear(actor, body);
  EXPECT_EQ(actor.measured->fit.tpose_frames, 10);
  EXPECT_GT(actor.measured->fit.confidence, 0.6);
}

TEST(Calibrator, MeasuresATallHeavyManWithTheOtherSensor) {
  const BodySurface body = adult(Sex::Male, 1.93, 112);
  expectNear(calibrated(standing(body, 0.05, 3.0), SensorKind::Kinect2), body);
}

TEST(Calibrator, MeasuresABodyOfAnotherFamily) {
  if (!std::filesystem::is_directory(makeHumanFolder())) GTEST_SKIP() << "no MakeHuman files";
  MakeHumanShape shape;
  shape.stature_m = 1.78;
  const BodySurface body = MakeHumanModel(makeHumanFolder()).make(shape);
  expectNear(calibrated(standing(body, 0, 2.7), SensorKind::Kinect1), body);
}

TEST(Calibrator, ThickLimbsGetWiderRadii) {
  const auto thin = calibrated(standing(adult(Sex::Male, 1.75, 58), 0, 2.6), SensorKind::Kinect2);
  const auto heavy = calibrated(standing(adult(Sex::Male, 1.75, 110), 0, 2.6), SensorKind::Kinect2);
  EXPECT_GT(heavy.measured->upper_leg_radius_m, thin.measured->upper_leg_radius_m + 0.005);
  EXPECT_GT(heavy.radii_m[static_cast<std::size_t>(partIndex(Part::Torso))],
            thin.radii_m[static_cast<std::size_t>(partIndex(Part::Torso))]);
}

TEST(Calibrator, AGivenStatureFixesTheScaleOfAWrongCamera) {
  const BodySurface body = adult(Sex::Male, 1.80, 78);
  const CameraModel camera = sensorCamera(SensorKind::Kinect1);
  CalibratorConfig config;
  config.stature_m = 1.80;
  Calibrator calibrator(shippedModels(), camera, config);
  for (int i = 0; i < 10; ++i) {
    DepthFrame frame = photograph({standing(body, 0, 2.7)}, SensorKind::Kinect1, camera, i);
    for (float& depth : frame.depth.data) depth *= 1.05F;
    calibrator.add(frame);
  }
  const Actor actor = calibrator.solve();
  EXPECT_NEAR(actor.stature_m(), 1.80, 1e-6);
  EXPECT_NEAR(actor.measured->depth_scale, 1 / 1.05, 0.012);
  expectNear(actor, body);
}

TEST(Calibrator, IsTheSameForAnyNumberOfThreads) {
  const Stander actor = standing(adult(Sex::Female, 1.65, 60), 0, 2.5);
  CalibratorConfig one;
  one.threads = 1;
  CalibratorConfig three;
  three.threads = 3;
  const ShapeVector a = calibrated(actor, SensorKind::Kinect1, one).measured->shape;
  EXPECT_EQ(a, calibrated(actor, SensorKind::Kinect1, three).measured->shape);
}

TPoseVerdict verdictOn(const std::vector<Stander>& people) {
  const CameraModel camera = sensorCamera(SensorKind::Kinect1);
  Calibrator calibrator(shippedModels(), camera, {});
  return calibrator.add(photograph(people, SensorKind::Kinect1, camera, 0));
}

TEST(Calibrator, TellsTheActorWhatToChange) {
  const BodySurface body = adult(Sex::Male, 1.78, 75);
  EXPECT_EQ(verdictOn({standing(body, 0, 2.7, 25 * kDegree)}).fault, TPoseFault::Turned);
  EXPECT_EQ(verdictOn({standing(body, 0, 2.7, 0, -28 * kDegree)}).advice,
            "the arms are lower than the shoulders: raise both hands");
  const TPoseVerdict near = verdictOn({standing(body, 0, 1.5)});
  EXPECT_EQ(near.fault, TPoseFault::OutOfImage);
  EXPECT_NE(near.advice.find("step back"), std::string::npos) << near.advice;
  Stander low = standing(body, 0, 2.6);
  low.q[kRootTy] -= 0.35;
  EXPECT_NE(verdictOn({low}).advice.find("the feet are out of the image"), std::string::npos)
      << verdictOn({low}).advice;
}

TEST(Calibrator, RefusesADollOf60Centimetres) {
  BodySurface doll = adult(Sex::Female, 1.6, 55);
  const float factor = 0.6F / 1.6F;
  for (auto& vertex : doll.vertices) vertex *= factor;
  doll.skeleton = makeSkeleton(doll.skeleton.lengths.scaled(0.6 / 1.6));
  const TPoseVerdict verdict = verdictOn({standing(doll, 0, 2.4)});
  EXPECT_FALSE(verdict.good());
  EXPECT_NE(verdict.advice.find("no adult's size"), std::string::npos) << verdict.advice;
}

// The other stands nearer to the camera, arms down.
TEST(Calibrator, TakesTheOneWhoStandsInATPose) {
  const CameraModel camera = sensorCamera(SensorKind::Kinect1);
  const BodySurface body = adult(Sex::Male, 1.82, 80);
  const Stander other = standing(adult(Sex::Female, 1.62, 60), 1.15, 2.6, 0, -1.4);
  Calibrator calibrator(shippedModels(), camera, {});
  for (int i = 0; i < 11; ++i) {
    const TPoseVerdict verdict =
        calibrator.add(photograph({standing(body, -0.35, 3.0), other}, SensorKind::Kinect1, camera, i));
    EXPECT_TRUE(verdict.good()) << verdict.advice;
  }
  EXPECT_TRUE(calibrator.hadCompany());
  EXPECT_NEAR(calibrator.solve().stature_m(), 1.82, 0.03);
}

TEST(Calibrator, RefusesTwoInATPose) {
  const CameraModel camera = sensorCamera(SensorKind::Kinect2);
  Calibrator calibrator(shippedModels(), camera, {});
  const std::vector<Stander> people = {standing(adult(Sex::Male, 1.75, 70), -0.95, 3.4),
                                       standing(adult(Sex::Female, 1.65, 60), 0.95, 3.4)};
  for (int i = 0; i < 11; ++i) calibrator.add(photograph(people, SensorKind::Kinect2, camera, i));
  const std::string error = errorOf([&] { calibrator.solve(); });
  EXPECT_NE(error.find("two people stand in a T-pose"), std::string::npos) << error;
}

TEST(Calibrator, WithoutATPoseItStillRefusesTwoPeopleFewFramesAndFewPoses) {
  const CameraModel camera = sensorCamera(SensorKind::Kinect1);
  CalibratorConfig config;
  config.any_pose = true;
  const BodySurface man = adult(Sex::Male, 1.75, 70);
  const auto refusal = [&](const std::vector<Stander>& people, int frames) {
    Calibrator calibrator(shippedModels(), camera, config);
    for (int i = 0; i < frames; ++i) calibrator.add(photograph(people, SensorKind::Kinect1, camera, i));
    return errorOf([&] { calibrator.solveWithoutTPose({}, 1.7); });
  };
  const Stander lowered = standing(man, -0.4, 2.9, 0, -1.3);
  EXPECT_NE(refusal({lowered}, 10).find("only 0 frames show clearly different poses"), std::string::npos)
      << refusal({lowered}, 10);
  EXPECT_NE(refusal({lowered}, 5).find("5 frames are too few"), std::string::npos) << refusal({lowered}, 5);
  const std::string two = refusal({lowered, standing(adult(Sex::Female, 1.65, 60), 0.6, 3.3, 0, -1.3)}, 10);
  EXPECT_NE(two.find("two people are in view"), std::string::npos) << two;
}

TEST(Calibrator, RefusesFiveFrames) {
  const CameraModel camera = sensorCamera(SensorKind::Kinect1);
  Calibrator calibrator(shippedModels(), camera, {});
  for (int i = 0; i < 5; ++i) {
    calibrator.add(photograph({standing(adult(Sex::Male, 1.75, 70), 0, 2.7)}, SensorKind::Kinect1, camera, i));
  }
  const std::string error = errorOf([&] { calibrator.solve(); });
  EXPECT_NE(error.find("5 frames are too few"), std::string::npos) << error;
}

TEST(Calibrator, SaysWhyNoFrameDid) {
  const CameraModel camera = sensorCamera(SensorKind::Kinect1);
  Calibrator calibrator(shippedModels(), camera, {});
  const Stander actor = standing(adult(Sex::Male, 1.75, 70), 0, 2.7, 0, -1.3);
  for (int i = 0; i < 12; ++i) calibrator.add(photograph({actor}, SensorKind::Kinect1, camera, i));
  const std::string error = errorOf([&] { calibrator.solve(); });
  EXPECT_NE(error.find("only 0 of the 10 frames needed show a T-pose"), std::string::npos) << error;
  EXPECT_NE(error.find("raise both hands"), std::string::npos) << error;
}

TEST(Calibrator, AnEmptyPictureShowsNobody) {
  const CameraModel camera = sensorCamera(SensorKind::Kinect1);
  Calibrator calibrator(shippedModels(), camera, {});
  DepthFrame frame;
  frame.depth.reset(camera.width, camera.height, 0.0F);
  EXPECT_EQ(calibrator.add(frame).fault, TPoseFault::Nobody);
}

}  // namespace
}  // namespace depthmocap
