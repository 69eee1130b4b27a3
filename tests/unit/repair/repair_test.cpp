#include "libtracker/repair/repair.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/core/random.h"
#include "libtracker/repair/fill_gaps.h"
#include "libtracker/repair/marker_pca.h"
#include "libtracker/repair/steady_track.h"

namespace depthmocap {
namespace {

std::shared_ptr<const LearnedPoses> shipped() {
  static const auto learned = std::make_shared<const LearnedPoses>(
      loadLearnedPoses(std::filesystem::path(DEPTHMOCAP_SOURCE_DIR) / "forest/models/pose_priors.bin"));
  return learned;
}

// Somebody who walks in a circle and swings his arms.
Pose walking(double time_s) {
  const double phase = 2.0 * std::numbers::pi * time_s;
  Pose q = Pose::Zero();
  q.head<3>() << std::sin(0.5 * time_s), 0.95 + 0.02 * std::cos(2 * phase), std::cos(0.5 * time_s);
  q[kRootRy] = 0.5 * time_s + 0.5 * std::numbers::pi;
  q[kLhumerusRz] = -1.2;
  q[kRhumerusRz] = 1.2;
  q[kLhumerusRy] = -0.5 * std::sin(phase);
  q[kRhumerusRy] = -0.5 * std::sin(phase);
  q[kLradiusRy] = -0.4;
  q[kRradiusRy] = 0.4;
  q[kLfemurRx] = 0.5 * std::sin(phase);
  q[kRfemurRx] = -0.5 * std::sin(phase);
  q[kLtibiaRx] = 0.4 + 0.3 * std::cos(phase);
  q[kRtibiaRx] = 0.4 - 0.3 * std::cos(phase);
  return q;
}

struct Worn {
  std::string name;
  BonePoint point;
};

// Markers of a person of another size than the average, of some of them with other offsets than their name says.
std::vector<Worn> worn(const Skeleton& skeleton) {
  std::vector<Worn> markers;
  const auto points = jointPoints(skeleton);
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    BonePoint point = points[joint];
    if (joint % 3 == 0) point.p_bone += Eigen::Vector3d(0.01, -0.015, 0.02);
    markers.push_back({std::string(kJointNames[joint]), point});
  }
  markers.push_back({"unknown", {Bone::LeftTibia, {0.05, -0.1, 0.03}}});
  return markers;
}

MarkerSequence recorded(const std::vector<Worn>& markers, const Skeleton& skeleton, int frames, double noise_m) {
  MarkerSequence sequence;
  std::vector<std::string> names;
  for (const Worn& marker : markers) names.push_back(marker.name);
  for (int t = 0; t < frames; ++t) {
    sequence.frame.push_back(t);
    sequence.time_s.push_back(t / 30.0);
  }
  sequence.addTracks(names);
  Random random(3);
  ForwardKinematics fk;
  for (int t = 0; t < frames; ++t) {
    fk.update(skeleton, walking(t / 30.0));
    for (std::size_t m = 0; m < markers.size(); ++m) {
      sequence.tracks[m].p.col(t) = fk.position(markers[m].point);
      for (double& x : sequence.tracks[m].p.col(t)) x += noise_m * random.normal();
      sequence.tracks[m].seen[t] = true;
    }
  }
  return sequence;
}

void hide(MarkerTrack& track, int first, int count) {
  for (int t = first; t < first + count; ++t) {
    track.seen[t] = false;
    track.p.col(t).setZero();
  }
}

double errorOf(const MarkerTrack& a, const MarkerTrack& b, int first, int count) {
  return (a.p - b.p).middleCols(first, count).colwise().norm().mean();
}

class RepairTest : public testing::Test {
 protected:
  Skeleton skeleton_ = makeSkeleton(BoneLengths{}.scaled(0.85));
  std::vector<Worn> markers_ = worn(skeleton_);
  MarkerSequence truth_ = recorded(markers_, skeleton_, 120, 0);
};

constexpr std::size_t kLeftWrist = 6;
constexpr std::size_t kRightKnee = 15;
constexpr std::size_t kUnknown = 18;

TEST_F(RepairTest, FillsAGapBetterThanASpline) {
  MarkerSequence gaps = truth_;
  hide(gaps.tracks[kLeftWrist], 40, 30);
  hide(gaps.tracks[kRightKnee], 50, 30);
  MarkerSequence splines = gaps;
  for (MarkerTrack& track : splines.tracks) fillBySpline(splines.time_s, track);
  const RepairResult result = repair(gaps, shipped(), {});
  EXPECT_EQ(result.outliers, 0);
  EXPECT_NEAR(statureOf(result.body.skeleton.lengths), statureOf(skeleton_.lengths), 0.06);
  const double knee_m = errorOf(result.markers.tracks[kRightKnee], truth_.tracks[kRightKnee], 50, 30);
  EXPECT_LT(knee_m, 0.03);
  EXPECT_LT(knee_m, 0.5 * errorOf(splines.tracks[kRightKnee], truth_.tracks[kRightKnee], 50, 30));
  EXPECT_LT(errorOf(result.markers.tracks[kLeftWrist], truth_.tracks[kLeftWrist], 40, 30),
            errorOf(splines.tracks[kLeftWrist], truth_.tracks[kLeftWrist], 40, 30));
  // What was seen without noise stays.
  EXPECT_LT(errorOf(result.markers.tracks[kRightKnee], truth_.tracks[kRightKnee], 0, 40), 0.001);
}

TEST_F(RepairTest, RemovesNoise) {
  const MarkerSequence noisy = recorded(markers_, skeleton_, 120, 0.02);
  const RepairResult result = repair(noisy, shipped(), {});
  EXPECT_NEAR(result.noise_m, 0.02, 0.004);
  double before_m = 0;
  double after_m = 0;
  for (std::size_t m = 0; m < noisy.tracks.size(); ++m) {
    before_m += errorOf(noisy.tracks[m], truth_.tracks[m], 0, 120);
    after_m += errorOf(result.markers.tracks[m], truth_.tracks[m], 0, 120);
  }
  EXPECT_LT(after_m, 0.55 * before_m);
}

TEST_F(RepairTest, MarkersOfUnknownNameJoinTheirBone) {
  MarkerSequence gaps = truth_;
  hide(gaps.tracks[kUnknown], 60, 30);
  const RepairResult result = repair(gaps, shipped(), {});
  EXPECT_TRUE(result.loose.empty());
  ASSERT_EQ(result.body.markers.back().track, kUnknown);
  EXPECT_EQ(result.body.markers.back().site.bone, Bone::LeftTibia);
  EXPECT_LT(errorOf(result.markers.tracks[kUnknown], truth_.tracks[kUnknown], 60, 30), 0.02);
}

TEST_F(RepairTest, AMarkerThatJumpsIsTakenForWrong) {
  MarkerSequence jumps = truth_;
  jumps.tracks[kLeftWrist].p.col(50) += Eigen::Vector3d(0.5, 0.5, 0);
  const RepairResult result = repair(jumps, shipped(), {});
  EXPECT_EQ(result.outliers, 1);
  EXPECT_LT(errorOf(result.markers.tracks[kLeftWrist], truth_.tracks[kLeftWrist], 50, 1), 0.03);
}

TEST_F(RepairTest, FindsWhichWayIsUp) {
  MarkerSequence z_up = truth_;
  for (MarkerTrack& track : z_up.tracks) {
    const Eigen::Matrix3Xd p = track.p;
    track.p.row(1) = -p.row(2);
    track.p.row(2) = p.row(1);
  }
  const RepairResult result = repair(z_up, shipped(), {});
  EXPECT_TRUE((result.R_world_file * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_NEAR(result.poses[60][kRootTy], 0.95, 0.06);
}

TEST_F(RepairTest, TheSameForAnyNumberOfThreads) {
  MarkerSequence gaps = truth_;
  hide(gaps.tracks[kLeftWrist], 40, 30);
  RepairConfig config;
  config.sequence.threads = 1;
  const RepairResult one = repair(gaps, shipped(), config);
  config.sequence.threads = 3;
  const RepairResult three = repair(gaps, shipped(), config);
  for (std::size_t m = 0; m < gaps.tracks.size(); ++m) EXPECT_EQ(one.markers.tracks[m].p, three.markers.tracks[m].p);
}

TEST_F(RepairTest, UnknownNamesAreAnError) {
  MarkerSequence nameless = truth_;
  for (MarkerTrack& track : nameless.tracks) track.name = "x";
  EXPECT_THROW(repair(nameless, shipped(), {}), Error);
}

TEST(MarkerSites, NamesOfSeveralPrograms) {
  const auto boneOf = [](const char* name) {
    const auto site = siteNamed(name);
    return site ? static_cast<int>(site->bone) : -1;
  };
  EXPECT_EQ(boneOf("left_wrist"), static_cast<int>(Bone::LeftRadius));
  EXPECT_EQ(boneOf("Subject 1:RTIB"), static_cast<int>(Bone::RightTibia));
  EXPECT_EQ(boneOf("mixamorig:RightUpLeg"), static_cast<int>(Bone::RightFemur));
  EXPECT_EQ(boneOf("L.Asis"), static_cast<int>(Bone::Root));
  EXPECT_EQ(boneOf("C7"), static_cast<int>(Bone::UpperBack));
  EXPECT_EQ(boneOf("stick2"), -1);
  EXPECT_LT(siteNamed("RASI")->offset.x(), 0);
}

TEST(FillGaps, SplinesFollowACubicAndLinesALine) {
  std::vector<double> time_s;
  MarkerTrack curve{"m", Eigen::Matrix3Xd(3, 40), Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(40, true)};
  for (int t = 0; t < 40; ++t) {
    time_s.push_back(0.1 * t);
    curve.p.col(t) << 0.1 * t, std::sin(0.1 * t), 1;
  }
  MarkerTrack spline = curve;
  hide(spline, 15, 6);
  MarkerTrack line = spline;
  fillBySpline(time_s, spline);
  fillLinearly(time_s, line);
  EXPECT_LT(errorOf(spline, curve, 15, 6), 0.002);
  EXPECT_LT((line.p.row(0) - curve.p.row(0)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(errorOf(line, curve, 15, 6), 0.01);
}

TEST(SteadyTrack, MeasuresNoiseAndTakesItAway) {
  Random random(5);
  Eigen::Matrix3Xd truth(3, 600);
  std::vector<double> time_s;
  for (int t = 0; t < 600; ++t) {
    time_s.push_back(t / 30.0);
    truth.col(t) << 0.05 * std::sin(t / 30.0), 0.05 * std::cos(t / 20.0), 0;
  }
  Eigen::Matrix3Xd noisy = truth;
  for (double& x : noisy.reshaped()) x += 0.01 * random.normal();
  const SeenFrames seen = SeenFrames::Constant(600, true);
  const double noise_m = markerNoise(noisy, seen);
  EXPECT_NEAR(noise_m, 0.01, 0.001);
  const Eigen::Matrix3Xd steady = steadied(noisy, seen, time_s, {0.05, 1.0, noise_m});
  EXPECT_LT((steady - truth).norm(), 0.5 * (noisy - truth).norm());
}

}  // namespace
}  // namespace depthmocap
