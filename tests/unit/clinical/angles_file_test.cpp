#include "libtracker/clinical/angles_file.h"

#include <gtest/gtest.h>

#include "libtracker/clinical/joint_angles.h"
#include "libtracker/core/random.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

TrackedFrame trackedFrame(std::int64_t frame, const Pose& q) {
  TrackedFrame tracked;
  tracked.frame = frame;
  tracked.time_s = static_cast<double>(frame) / 30.0;
  tracked.state = TrackState::Tracking;
  tracked.q = q;
  tracked.joints_camera = tracked.R_world_camera.transpose() * jointPositions(makeSkeleton(tracked.lengths), q);
  tracked.confidence.setConstant(0.5);
  return tracked;
}

Pose standing() {
  Pose q = Pose::Zero();
  q.head<3>() = Eigen::Vector3d(0.1, 0.2, -3);
  q[kRhumerusRz] = 1.4;
  q[kLhumerusRz] = -1.4;
  return q;
}

TEST(AnglesFile, IsReadAsItWasWritten) {
  const TemporaryFolder folder;
  ClinicalAngleReader reader;
  Pose q = standing();
  q[kRtibiaRx] = 0.7;
  const AnglesRow row = anglesRow(trackedFrame(0, q), reader);
  TrackedFrame gone = trackedFrame(1, q);
  gone.state = TrackState::Lost;
  AnglesWriter writer(folder / "a.csv");
  writer.write(row);
  writer.write(anglesRow(gone, reader));
  writer.finish();
  const auto rows = readAnglesFile(folder / "a.csv");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_LT((rows[0].angles - row.angles).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_EQ(rows[0].confidence, row.confidence);
  EXPECT_NEAR(rows[0].signals.pelvis_y_m, 0.2, 1e-5);
  EXPECT_NEAR(rows[0].angles[clinicalAngleIndex("right_knee_flexion")], 40.107, 1e-3);
  EXPECT_EQ(rows[1].state, TrackState::Lost);
  const std::string text = readBytes(folder / "a.csv");
  EXPECT_EQ(text.substr(0, 34), "frame,time_s,state,pelvis_tilt,pel");
}

TEST(AnglesFile, RowsOfSeveralPeopleAreToldApart) {
  const TemporaryFolder folder;
  ClinicalAngleReader reader;
  AnglesWriter writer(folder / "a.csv", FileOf::People);
  for (const int person : {1, 2}) {
    Pose q = standing();
    q[kRtibiaRx] = 0.1 * person;
    AnglesRow row = anglesRow(trackedFrame(0, q), reader);
    row.person = person;
    writer.write(row);
  }
  writer.finish();
  const auto second = readAnglesFile(folder / "a.csv", 2);
  ASSERT_EQ(second.size(), 1U);
  EXPECT_NEAR(second[0].angles[clinicalAngleIndex("right_knee_flexion")], 11.459, 1e-3);
  EXPECT_EQ(readAnglesFile(folder / "a.csv", 3).size(), 0U);
}

TEST(AnglesFile, DamageIsNamedWithItsLine) {
  const TemporaryFolder folder;
  ClinicalAngleReader reader;
  AnglesWriter writer(folder / "a.csv");
  writer.write(anglesRow(trackedFrame(0, standing()), reader));
  writer.finish();
  writeBytes(folder / "b.csv", readBytes(folder / "a.csv") + "1,0.03,tracking,1,2\n");
  EXPECT_NE(errorOf([&] { readAnglesFile(folder / "b.csv"); }).find("b.csv: line 3"), std::string::npos);
  writeBytes(folder / "c.csv", "frame,time_s,state,knee\n");
  EXPECT_NE(errorOf([&] { readAnglesFile(folder / "c.csv"); }), "");
}

// What joints alone say agrees with the pose where the trunk is straight and nothing is twisted.
TEST(JointAngles, AgreeWithThePose) {
  Random random(6);
  for (int i = 0; i < 50; ++i) {
    Pose q = standing();
    q[kRtibiaRx] = random.uniform(0.1, 1.5);
    q[kLfemurRx] = random.uniform(-1.5, 0.2);
    q[kLradiusRy] = -random.uniform(0.1, 2.0);
    q[kRfootRx] = random.uniform(-0.3, 0.5);
    q[kRhumerusRy] = random.uniform(-0.5, 1.0);
    q[kRootRy] = random.uniform(-3.0, 3.0);
    const TrackedFrame tracked = trackedFrame(i, q);
    ClinicalAngleReader reader;
    const AnglesRow whole = anglesRow(tracked, reader);
    const AnglesRow joints = anglesOfJoints({jointsRow(tracked)}).at(0);
    for (const char* name : {"right_knee_flexion", "left_hip_flexion", "left_elbow_flexion", "right_ankle_dorsiflexion",
                             "right_shoulder_flexion", "left_shoulder_abduction", "left_hip_abduction"}) {
      const int angle = clinicalAngleIndex(name);
      EXPECT_NEAR(joints.angles[angle], whole.angles[angle], 1e-3) << name;
    }
    EXPECT_NEAR(joints.signals.left_foot_ahead_m, whole.signals.left_foot_ahead_m, 1e-9);
    EXPECT_NEAR(joints.signals.right_sole_y_m, whole.signals.right_sole_y_m, 1e-9);
  }
}

}  // namespace
}  // namespace depthmocap
