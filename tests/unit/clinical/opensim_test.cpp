#include "libtracker/clinical/opensim.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "libtracker/clinical/anatomical.h"
#include "libtracker/core/csv.h"
#include "libtracker/core/random.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

constexpr double kRad = std::numbers::pi / 180.0;

double value(const OpenSimCoordinates& values, std::string_view name) {
  const auto found = std::find(kOpenSimCoordinates.begin(), kOpenSimCoordinates.end(), name);
  return values[found - kOpenSimCoordinates.begin()];
}

// A joint of the model: turns about z, x, y (right, forward, up of its axes x forward, y up, z right); on the left the
// last two are about the opposite axes.
Eigen::Matrix3d modelRotation(double z_deg, double x_deg, double y_deg, double sign) {
  return (Eigen::AngleAxisd(kRad * z_deg, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(sign * kRad * x_deg, Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(sign * kRad * y_deg, Eigen::Vector3d::UnitY()))
      .toRotationMatrix();
}

// A rotation of ours in the model's axes.
Eigen::Matrix3d inModelAxes(const Eigen::Matrix3d& R) {
  Eigen::Matrix3d axes;  // openSimPoint as a matrix
  for (int i = 0; i < 3; ++i) axes.col(i) = openSimPoint(Eigen::Vector3d::Unit(i));
  return axes * R * axes.transpose();
}

TEST(OpenSim, CoordinatesTurnTheModelAsTheBonesAre) {
  Random random(8);
  OpenSimReader reader;
  ForwardKinematics fk;
  for (int i = 0; i < 100; ++i) {
    Pose q = Pose::Zero();
    for (int k = kFirstRotationDof; k < kDofCount; ++k) q[k] = random.uniform(-0.9, 0.9);
    q[kRootRy] = random.uniform(-3, 3);
    fk.update(makeSkeleton(BoneLengths{}), q);
    const OpenSimCoordinates c = reader.read(fk, 0.17, Eigen::Vector3d::Zero());
    const auto expectJoint = [&](const std::array<const char*, 3>& names, double sign, const Eigen::Matrix3d& R) {
      const Eigen::Matrix3d model = modelRotation(value(c, names[0]), value(c, names[1]), value(c, names[2]), sign);
      EXPECT_LT((model - inModelAxes(R)).norm(), 1e-9) << names[0];
    };
    expectJoint({"pelvis_tilt", "pelvis_list", "pelvis_rotation"}, 1, fk.R_world_bone(Bone::Root));
    expectJoint({"lumbar_extension", "lumbar_bending", "lumbar_rotation"}, 1,
                relativeRotation(fk, Bone::Root, Bone::UpperBack));
    expectJoint({"hip_flexion_r", "hip_adduction_r", "hip_rotation_r"}, 1,
                relativeRotation(fk, Bone::Root, Bone::RightFemur));
    expectJoint({"hip_flexion_l", "hip_adduction_l", "hip_rotation_l"}, -1,
                relativeRotation(fk, Bone::Root, Bone::LeftFemur));
    expectJoint({"arm_flex_r", "arm_add_r", "arm_rot_r"}, 1, armInThorax(fk, BodySide::Right));
    expectJoint({"arm_flex_l", "arm_add_l", "arm_rot_l"}, -1, armInThorax(fk, BodySide::Left));
    EXPECT_NEAR(value(c, "knee_angle_r"), q[kRtibiaRx] / kRad, 1e-9);
    EXPECT_NEAR(value(c, "elbow_flex_l"), -q[kLradiusRy] / kRad, 1e-9);
  }
}

TEST(OpenSim, TheModelsHipsAreWhereOursAre) {
  Pose q = Pose::Zero();
  q.head<3>() = Eigen::Vector3d(0.3, 1.1, -2.0);
  q[kRootRy] = 0.7;
  q[kRootRx] = 0.2;
  ForwardKinematics fk;
  const BoneLengths lengths;
  fk.update(makeSkeleton(lengths), q);
  const Eigen::Vector3d origin(0.1, -0.5, -2.5);
  const OpenSimCoordinates c = OpenSimReader().read(fk, lengths.hip_width, origin);
  const Eigen::Vector3d pelvis(value(c, "pelvis_tx"), value(c, "pelvis_ty"), value(c, "pelvis_tz"));
  const Eigen::Matrix3d R =
      modelRotation(value(c, "pelvis_tilt"), value(c, "pelvis_list"), value(c, "pelvis_rotation"), 1);
  const double scale = lengths.hip_width / (2 * 0.07726);
  const Eigen::Vector3d hip_r = pelvis + R * (scale * Eigen::Vector3d(-0.056276, -0.07849, 0.07726));
  EXPECT_LT((hip_r - openSimPoint(fk.origin(Bone::RightFemur) - origin)).norm(), 1e-9);
}

TEST(OpenSim, AngleOfTheArmDoesNotJumpThroughTheTPose) {
  OpenSimReader reader;
  ForwardKinematics fk;
  Pose q = Pose::Zero();
  double before = 0;
  for (int step = 0; step <= 120; ++step) {
    q[kRhumerusRz] = (90 - 1.5 * step) * kRad;  // from hanging to straight up
    fk.update(makeSkeleton(BoneLengths{}), q);
    const double now = value(reader.read(fk, 0.17, Eigen::Vector3d::Zero()), "arm_add_r");
    EXPECT_NEAR(now, -1.5 * step, 1e-6);
    EXPECT_LE(std::abs(now - before), 1.6);
    before = now;
  }
}

TEST(OpenSim, MotionFilesSayWhatTheyHold) {
  const TemporaryFolder folder;
  OpenSimRow row;
  row.time_s = 0.5;
  row.values.setConstant(1.25);
  writeMot({row, row}, folder / "a.mot");
  const std::string text = readBytes(folder / "a.mot");
  EXPECT_NE(text.find("nRows=2\nnColumns=28\ninDegrees=yes\n"), std::string::npos);
  EXPECT_NE(text.find("endheader\ntime\tpelvis_tilt\tpelvis_list\t"), std::string::npos);
  EXPECT_NE(text.find("\n0.500000\t1.250000\t"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap
