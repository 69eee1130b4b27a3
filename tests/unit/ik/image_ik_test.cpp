#include "libtracker/ik/image_ik.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/ik/ik_files.h"
#include "libtracker/ik/pose_problem.h"
#include "libtracker/skeleton/joint_limits.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/ik/problem_gradient.h"

namespace depthmocap {
namespace {

constexpr double kPixelsPerMetre = 180.0;

// Steps forward with a bent arm, turned by `yaw_rad`.
Pose stepping(double yaw_rad) {
  Pose q = Pose::Zero();
  q.head<3>() << 0.3, 0.1, -3.0;
  q[kRootRy] = yaw_rad;
  q[kLhumerusRz] = -1.1;
  q[kRhumerusRz] = 1.1;
  q[kLradiusRy] = -0.8;
  q[kRradiusRy] = 0.5;
  q[kLfemurRx] = -0.5;
  q[kLtibiaRx] = 0.3;
  q[kRtibiaRx] = 0.4;
  return q;
}

class ImageIk : public testing::TestWithParam<Projection> {
 protected:
  ImageIk() {
    projection_.kind = GetParam();
    IkConfig config;
    config.prior = IkPrior::Gmm;
    solver_ = std::make_unique<IkSolver>(
        skeleton_, config,
        std::make_shared<const LearnedPoses>(
            loadLearnedPoses(std::filesystem::path(DEPTHMOCAP_SOURCE_DIR) / "forest/models/pose_priors.bin")));
  }
  [[nodiscard]] ImageTargets seen(const Pose& q) const {
    const JointPositions joints = jointPositions(skeleton_, q);
    ImageTargets targets;
    for (int joint = 0; joint < kJointCount; ++joint) {
      const Eigen::Vector3d p = joints.col(joint);
      const Eigen::Vector2d uv = projection_.kind == Projection::Orthographic
                                     ? Eigen::Vector2d(kPixelsPerMetre * p.head<2>())
                                     : projection_.camera.project({p.x(), -p.y(), -p.z()});
      targets.targets.push_back({static_cast<Joint>(joint), uv, 1.0});
    }
    return targets;
  }
  // Mean distance of joints [m], without the depth of the root, which orthographic pictures do not have.
  [[nodiscard]] double errorOf(Pose found, Pose truth) const {
    if (projection_.kind == Projection::Orthographic) found[kRootTz] = truth[kRootTz];
    return (jointPositions(skeleton_, found) - jointPositions(skeleton_, truth)).colwise().norm().mean();
  }
  ImageProjection projection_;
  Skeleton skeleton_ = makeSkeleton(BoneLengths{});
  std::unique_ptr<IkSolver> solver_;
};

TEST_P(ImageIk, GradientOfTheTerm) {
  const Pose truth = stepping(0.4);
  ImageTerm term(skeleton_, projection_, seen(truth), 150.0, 0.5);
  PoseProblem problem(term);
  Pose q = clampedToLimits(truth + 0.05 * Pose::Ones());
  if (projection_.kind == Projection::Orthographic) q[kRootTz] = 0.2;
  expectGradient(problem, q, 1e-5, 1e-5);
}

TEST_P(ImageIk, FindsThePoseFromAPicture) {
  const Pose truth = stepping(0.4);
  const IkResult result = solveImage(*solver_, projection_, seen(truth));
  EXPECT_LT(result.residual_m, 0.01);
  EXPECT_LT(errorOf(result.q, truth), 0.08);
}

TEST_P(ImageIk, SolvesASequenceSmoothly) {
  std::vector<ImageTargets> targets;
  std::vector<double> time_s;
  for (int t = 0; t < 12; ++t) {
    targets.push_back(seen(stepping(0.4 + 0.03 * t)));
    time_s.push_back(t / 30.0);
  }
  const std::vector<IkResult> results = solveImageSequence(*solver_, projection_, targets, time_s, {});
  ASSERT_EQ(results.size(), 12U);
  for (std::size_t t = 0; t < results.size(); ++t) {
    EXPECT_LT(errorOf(results[t].q, stepping(0.4 + 0.03 * static_cast<double>(t))), 0.1) << t;
    EXPECT_LT(results[t].residual_m, 0.02);
  }
}

TEST_P(ImageIk, TooFewJointsAreAnError) {
  ImageTargets targets = seen(stepping(0));
  targets.targets.resize(kLeastImageTargets - 1);
  EXPECT_THROW((void)solveImage(*solver_, projection_, targets), Error);
}

INSTANTIATE_TEST_SUITE_P(Both, ImageIk, testing::Values(Projection::Orthographic, Projection::Pinhole));

std::string rows(const std::string& text) {
  return "pose_id,joint,u,v,weight\n" + text;
}

TEST(ImageTargetsFile, SeesWhichWayVGrows) {
  const TemporaryFolder folder;
  for (const bool is_down : {false, true}) {
    const std::string sign = is_down ? "" : "-";
    writeFileAtomically(folder / "t.csv", rows("a,head,5," + sign + "10,1\na,pelvis,5," + sign +
                                               "60,0.5\na,left_ankle,5," + sign + "110,\na,left_wrist,1,1,0\n"));
    const auto poses = readImageTargetsFile(folder / "t.csv", Projection::Orthographic, VAxis::Auto);
    ASSERT_EQ(poses.size(), 1U);
    const auto& targets = poses[0].targets.targets;
    ASSERT_EQ(targets.size(), 3U);  // without the one of weight 0
    EXPECT_EQ(targets[0].uv.y(), -10);
    EXPECT_EQ(targets[1].weight, 0.5);
    EXPECT_EQ(targets[2].weight, 1);
  }
}

TEST(ImageTargetsFile, DamageIsAnErrorWithTheLine) {
  const TemporaryFolder folder;
  const auto errorOf = [&](const std::string& text) -> std::string {
    writeFileAtomically(folder / "t.csv", rows(text));
    try {
      readImageTargetsFile(folder / "t.csv", Projection::Pinhole, VAxis::Auto);
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_NE(errorOf("a,nose,1,1,1\n").find("line 2: there is no such joint"), std::string::npos);
  EXPECT_NE(errorOf("a,head,1,x,1\n").find("line 2: v must be a number"), std::string::npos);
  EXPECT_NE(errorOf("a,head,1,1,-1\n").find("line 2: weight"), std::string::npos);
  EXPECT_NE(errorOf("a,head,1,1,1\na,head,1,1,1\n").find("line 3: joint 'head' is given twice"), std::string::npos);
  EXPECT_NE(errorOf("a,head,1,1,1\n").find("'a' has 1 joints"), std::string::npos);
  EXPECT_NE(errorOf("").find("holds no target"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap
