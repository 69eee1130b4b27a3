#pragma once
#include <vector>

#include <ceres/cost_function.h>

#include "calibration/joint_solve.h"
#include "calibration/pose_observation.h"
#include "libtracker/actor/body_template.h"

namespace depthmocap {

inline constexpr int kOffsetCount = 3 * kPartCount;
using OffsetVector = Eigen::Matrix<double, kOffsetCount, 1>;  // marker offsets v, in the order of the parts

// A measured point and the template's point that it was matched with.
struct CloudMatch {
  const BodyTemplate::Point* model = nullptr;
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d n_world = Eigen::Vector3d::Zero();  // unit
  double weight = 0;
};
// An outermost point of the template that should lie in a plane.
struct EndMatch {
  BodyTemplate::Point model;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  double offset = 0;
};

// What one observation is compared with, held fixed during one round.
struct Matches {
  std::vector<CloudMatch> cloud;
  std::vector<EndMatch> ends;
};

// All residuals of one observation; parameters: shape (kShapeCount), marker offsets (kOffsetCount), q (kDofCount).
// The references must outlive it.
class PoseCost : public ceres::CostFunction {
 public:
  PoseCost(const BodyTemplate& body, const PoseObservation& observation, const Matches& matches,
           const std::array<Bone, kPartCount>& marker_bones, const JointSolveConfig& config);
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  struct Evaluation;
  void evaluateMarkers(Evaluation& e) const;
  void evaluateCloud(Evaluation& e) const;
  void evaluateBoundaries(Evaluation& e) const;
  void evaluateEnds(Evaluation& e) const;
  void evaluatePose(Evaluation& e) const;

  const BodyTemplate& body_;
  const PoseObservation& observation_;
  const Matches& matches_;
  const std::array<Bone, kPartCount>& marker_bones_;
  const JointSolveConfig& config_;
};

}  // namespace depthmocap
