#include "libtracker/ik/pose_sequence.h"

#include <cmath>

#include <gtest/gtest.h>

#include "libtracker/core/random.h"
#include "libtracker/ik/target_term.h"
#include "libtracker/skeleton/block_band.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

Pose somePose(Random& random) {
  Pose q;
  for (double& x : q) x = random.normal();
  return q;
}

TEST(BlockBand, SolvesAsADenseMatrixDoes) {
  constexpr int kFrames = 5;
  Random random(1);
  BlockBand A(kFrames);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(kFrames * kDofCount, kFrames * kDofCount);
  std::vector<Pose> b(kFrames);
  for (int t = 0; t < kFrames; ++t) {
    const auto i = static_cast<std::size_t>(t);
    PoseMatrix root;
    for (double& x : root.reshaped()) x = random.normal();
    A.diagonal[i] = root * root.transpose() + 20.0 * PoseMatrix::Identity();
    A.back1[i] = somePose(random);
    A.back2[i] = somePose(random);
    b[i] = somePose(random);
    dense.block<kDofCount, kDofCount>(t * kDofCount, t * kDofCount) = A.diagonal[i];
    const auto couple = [&](int other, const Pose& diagonal) {
      if (other < 0) return;
      dense.block<kDofCount, kDofCount>(t * kDofCount, other * kDofCount) = diagonal.asDiagonal();
      dense.block<kDofCount, kDofCount>(other * kDofCount, t * kDofCount) = diagonal.asDiagonal();
    };
    couple(t - 1, A.back1[i]);
    couple(t - 2, A.back2[i]);
  }
  const std::vector<Pose> x = A.solve(b);
  const std::vector<Pose> back = A.times(x);
  Eigen::VectorXd all(kFrames * kDofCount);
  for (int t = 0; t < kFrames; ++t) {
    all.segment<kDofCount>(t * kDofCount) = x[static_cast<std::size_t>(t)];
    EXPECT_LT((back[static_cast<std::size_t>(t)] - b[static_cast<std::size_t>(t)]).norm(), 1e-9);
  }
  Eigen::VectorXd right(kFrames * kDofCount);
  for (int t = 0; t < kFrames; ++t) right.segment<kDofCount>(t * kDofCount) = b[static_cast<std::size_t>(t)];
  EXPECT_LT((dense * all - right).norm(), 1e-9);
}

// A nodding head and a bending elbow, seen in some frames only.
Pose moving(double time_s) {
  Pose q = Pose::Zero();
  q.head<3>() << 0.2 * time_s, 1, 0;
  q[kLradiusRy] = -1.0 - 0.5 * std::sin(2.0 * time_s);
  return q;
}

std::vector<SequenceFrame> seenFrames(const Skeleton& skeleton, std::size_t count, std::size_t gap_from,
                                      std::size_t gap_to) {
  std::vector<SequenceFrame> frames(count);
  for (std::size_t t = 0; t < count; ++t) {
    frames[t].time_s = static_cast<double>(t) / 30.0;
    if (t >= gap_from && t < gap_to) continue;
    PointTargets targets;
    ForwardKinematics fk;
    fk.update(skeleton, moving(frames[t].time_s));
    for (const BonePoint& point : jointPoints(skeleton)) targets.targets.push_back({point, fk.position(point), 1000.0});
    frames[t].measured = std::make_unique<TargetTerm>(skeleton, targets);
  }
  return frames;
}

TEST(PoseSequence, GoesOnSmoothlyThroughAGapAndOverWindows) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  for (const std::size_t count : {std::size_t{60}, kSequenceWindow + 100}) {
    std::vector<SequenceFrame> frames = seenFrames(skeleton, count, 30, 36);
    const std::vector<Pose> poses = solveSequence(frames, nullptr, {}, std::vector<Pose>(count, moving(0)));
    ASSERT_EQ(poses.size(), count);
    for (std::size_t t = 0; t < count; ++t) {
      const Pose truth = moving(frames[t].time_s);
      EXPECT_NEAR(poses[t][kLradiusRy], truth[kLradiusRy], 0.01) << t;
      EXPECT_NEAR(poses[t][kRootTx], truth[kRootTx], 0.003) << t;
    }
  }
}

TEST(PoseSequence, StaysWithinJointLimits) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  std::vector<SequenceFrame> frames = seenFrames(skeleton, 20, 0, 0);
  for (SequenceFrame& frame : frames) {
    PointTargets targets;  // the elbow bent the wrong way
    ForwardKinematics fk;
    Pose q = Pose::Zero();
    q[kLradiusRy] = 0.8;
    fk.update(skeleton, q);
    for (const BonePoint& point : jointPoints(skeleton)) targets.targets.push_back({point, fk.position(point), 100.0});
    frame.measured = std::make_unique<TargetTerm>(skeleton, targets);
  }
  const std::vector<Pose> poses = solveSequence(frames, nullptr, {}, std::vector<Pose>(20, Pose::Zero()));
  for (const Pose& q : poses) EXPECT_LE((q - clampedToLimits(q)).norm(), 1e-12);
}

}  // namespace
}  // namespace depthmocap
