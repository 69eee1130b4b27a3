#include "calibration/joint_solve.h"

#include <gtest/gtest.h>

#include "calibration/pose_cost.h"
#include "libtracker/body/make_template_surface.h"
#include "libtracker/core/random.h"
#include "libtracker/skeleton/typical_bone_lengths.h"
#include "tests/gradient_check.h"

namespace depthmocap {
namespace {

ShapeSpace someSpace() {
  Random random(2);
  std::vector<BoneLengths> people;
  for (int i = 0; i < 12; ++i) {
    BoneLengths lengths = typicalBoneLengths(i % 2 == 0 ? Sex::Male : Sex::Female, random.uniform(1.5, 1.9));
    for (const auto field : kBoneLengthFields) lengths.*field *= random.uniform(0.95, 1.05);
    people.push_back(lengths);
  }
  return makeShapeSpace(people, 0.99, "test");
}

Pose bentPose(int i) {
  Pose q = Pose::Zero();
  q[kRootTy] = 0.1;
  q[kRootTz] = -2.5;
  q[kLradiusRy] = q[kRradiusRy] = 0.0;
  q[kLhumerusRz] = 0.1 * i;
  q[kLradiusRy] = -0.3 * i;
  q[kRradiusRy] = 0.2 * i;
  q[kRfemurRx] = -0.3 * i;
  q[kRtibiaRx] = 0.35 * i;
  q[kLfemurRx] = 0.1 * i;
  q[kLtibiaRx] = 0.2 * i;
  return q;
}

// What a body of this shape shows without any noise: the points of its surface that face the camera, with their parts,
// and the average markers.
PoseObservation observationOf(const BodyTemplate& body, const ShapeVector& shape, const Pose& q) {
  const Skeleton skeleton = makeSkeleton(boneLengths(shape));
  ForwardKinematics fk;
  fk.update(skeleton, q);
  PoseObservation observation;
  for (const auto& point : body.points()) {
    const Eigen::Vector3d p = fk.position({point.bone, body.place(point, shape)});
    if (p.dot(fk.R_world_bone(point.bone) * body.normal(point, shape)) >= 0) continue;
    CloudPoint seen;
    seen.p_world = p.cast<float>();
    seen.probability[static_cast<std::size_t>(partIndex(point.part))] = 1.0F;
    observation.cloud.push_back(seen);
  }
  const MarkerModel markers = averageMarkerModel(skeleton);
  for (int i = 0; i < kPartCount; ++i) {
    observation.markers_world.position.col(i) = fk.position(markers[static_cast<std::size_t>(i)]);
    observation.markers_world.confidence[i] = 1;
  }
  observation.q = q;
  observation.deviation.setConstant(0.1);
  observation.deviation.head<kFirstBodyDof>().setZero();
  observation.weight = 0.25;
  return observation;
}

TEST(PoseCost, JacobianMatchesDifferences) {
  const BodyTemplate body(makeTemplateSurface(Sex::Male, 60));
  const ShapeVector shape = 1.05 * body.templateShape();
  PoseObservation observation = observationOf(body, shape, bentPose(1));
  for (int place = 0; place <= static_cast<int>(PartBoundary::Place::Waist); ++place) {
    observation.boundaries.push_back(
        {static_cast<PartBoundary::Place>(place), Eigen::Vector3d(1, 0.3 * place, 0.2).normalized(), 0.1});
  }
  Matches matches;
  for (const auto& point : body.points()) {
    matches.cloud.push_back({&point, {0.1, 0.2, -2.0}, Eigen::Vector3d(0.2, 0.1, 1).normalized(), 0.7});
  }
  matches.ends.push_back({body.ends().crown, Eigen::Vector3d::UnitY(), 0.8});
  matches.ends.push_back({body.ends().left_sole, -Eigen::Vector3d::UnitY(), 0.9});
  std::array<Bone, kPartCount> bones{};
  const MarkerModel average = averageMarkerModel(makeSkeleton(boneLengths(shape)));
  Eigen::VectorXd x(kShapeCount + kOffsetCount + kDofCount);
  x.head<kShapeCount>() = shape;
  for (int i = 0; i < kPartCount; ++i) {
    bones[static_cast<std::size_t>(i)] = average[static_cast<std::size_t>(i)].bone;
    x.segment<3>(kShapeCount + 3 * i) = average[static_cast<std::size_t>(i)].p_bone;
  }
  x.tail<kDofCount>() = bentPose(2);
  const JointSolveConfig config;
  const PoseCost cost(body, observation, matches, bones, config);
  const auto evaluate = [&](const Eigen::VectorXd& at, Eigen::MatrixXd* J) {
    const double* parameters[] = {at.data(), at.data() + kShapeCount, at.data() + kShapeCount + kOffsetCount};
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::VectorXd r(cost.num_residuals());
    RowMajor a(r.size(), kShapeCount), b(r.size(), kOffsetCount), c(r.size(), kDofCount);
    double* jacobians[] = {a.data(), b.data(), c.data()};
    cost.Evaluate(parameters, r.data(), J != nullptr ? jacobians : nullptr);
    if (J != nullptr) {
      J->resize(r.size(), at.size());
      *J << a, b, c;
    }
    return r;
  };
  expectJacobianMatches(
      x, [&](const Eigen::VectorXd& at) { return evaluate(at, nullptr); },
      [&](const Eigen::VectorXd& at) {
        Eigen::MatrixXd J;
        evaluate(at, &J);
        return J;
      },
      1e-7);
}

// From noise-free bent poses, lengths and girths come back although the start is a smaller, other body.
TEST(SolveJointly, FindsTheBodyThatMadeTheCloud) {
  const BodyTemplate body(makeTemplateSurface(Sex::Male, 350));
  ShapeVector truth = 1.04 * body.templateShape();
  truth[1] *= 1.05;
  truth[3] *= 0.96;
  truth[kBoneLengthCount + static_cast<int>(Girth::UpperLeg)] *= 1.12;
  std::vector<PoseObservation> observations;
  for (int i = 0; i < 4; ++i) observations.push_back(observationOf(body, truth, bentPose(i)));
  const JointSolution solution =
      solveJointly(body, someSpace(), observations, ShapeVector(0.98 * body.templateShape()), {});
  EXPECT_LT((solution.shape - truth).head<4>().cwiseAbs().maxCoeff(), 0.018) << (solution.shape - truth).transpose();
  EXPECT_NEAR(solution.shape[kBoneLengthCount + static_cast<int>(Girth::UpperLeg)],
              truth[kBoneLengthCount + static_cast<int>(Girth::UpperLeg)], 0.04);
  EXPECT_LT(solution.rms_surface_m, 0.002);
  EXPECT_GT(solution.matched_share, 0.99);
}

TEST(SolveJointly, WithoutACloudOnlyMarkersAndTheShapeSpaceDecide) {
  const BodyTemplate body(makeTemplateSurface(Sex::Male, 300));
  const ShapeVector truth = 1.05 * body.templateShape();
  std::vector<PoseObservation> observations;
  for (int i = 0; i < 4; ++i) observations.push_back(observationOf(body, truth, bentPose(i)));
  JointSolveConfig config;
  config.surface_points = 0;
  const JointSolution solution = solveJointly(body, someSpace(), observations, body.templateShape(), config);
  EXPECT_NEAR(statureOf(boneLengths(solution.shape)), statureOf(boneLengths(truth)), 0.015);
  EXPECT_LT(solution.rms_marker_m, 0.005);
}

}  // namespace
}  // namespace depthmocap
