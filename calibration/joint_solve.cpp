#include "calibration/joint_solve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <ceres/ceres.h>

#include "calibration/pose_cost.h"
#include "libtracker/core/check.h"
#include "libtracker/match/lorentzian_weight.h"
#include "libtracker/match/part_points.h"

namespace depthmocap {
namespace {

// Weight of the shape space term with residuals in centimetres (gamma of the method, section A (6)).
constexpr double kShapeSpaceWeight = 0.5;
// Deviation of marker offsets about those of the average body [m].
constexpr double kOffsetDeviation_m = 0.015;
// Deviation of girths about those of the stature, as a factor.
constexpr double kGirthDeviation = 0.15;

using Eigen::Vector3d;

constexpr double kCentimetre = 0.01;    // unit of the shape space's residuals
constexpr double kReach_m = 0.12;       // a point further from its surface has no match
constexpr double kPartDoubt = 0.05;     // least probability of a part: the classifier may be wrong
constexpr double kNearness_m = 0.05;    // how far the surface of the right part is expected
constexpr double kLorentzian_m = 0.02;  // weighs a match by its distance

std::array<Bone, kPartCount> bonesOf(const MarkerModel& markers) {
  std::array<Bone, kPartCount> bones{};
  for (std::size_t i = 0; i < kPartCount; ++i) bones[i] = markers[i].bone;
  return bones;
}

// d average marker offsets / d s: they are linear in the bone lengths.
Eigen::Matrix<double, kOffsetCount, kBoneLengthCount> averageOffsets() {
  Eigen::Matrix<double, kOffsetCount, kBoneLengthCount> J;
  for (std::size_t part = 0; part < kPartCount; ++part) {
    J.middleRows<3>(3 * static_cast<Eigen::Index>(part)) =
        linearInLengths([&](const BoneLengths& l) { return averageMarkerModel(makeSkeleton(l))[part].p_bone; });
  }
  return J;
}

// gamma || (I - H H^T)(s - mean) ||^2 and, within the space, each component over its deviation; girths about those that
// go with the stature.
class ShapeCost : public ceres::SizedCostFunction<2 * kBoneLengthCount + kGirthCount, kShapeCount> {
 public:
  ShapeCost(const BodyTemplate& body, const ShapeSpace& space) {
    J_.setZero();
    Eigen::Matrix<double, kBoneLengthCount, kBoneLengthCount> off;
    off.setIdentity();
    off -= space.H * space.H.transpose();
    J_.topLeftCorner<kBoneLengthCount, kBoneLengthCount>() = std::sqrt(kShapeSpaceWeight) / kCentimetre * off;
    for (Eigen::Index k = 0; k < space.deviation.size(); ++k) {
      J_.row(kBoneLengthCount + k).head<kBoneLengthCount>() = space.H.col(k).transpose() / space.deviation[k];
    }
    Eigen::Matrix<double, 1, kBoneLengthCount> girth;  // that goes with the stature, linear in s
    for (int k = 0; k < kBoneLengthCount; ++k) {
      girth[k] = body.girthOf(statureOf(boneLengths(LengthVector(LengthVector::Unit(k)))));
    }
    for (int g = 0; g < kGirthCount; ++g) {
      J_.row(2 * kBoneLengthCount + g).head<kBoneLengthCount>() = -girth / kGirthDeviation;
      J_(2 * kBoneLengthCount + g, kBoneLengthCount + g) = 1.0 / kGirthDeviation;
    }
    ShapeVector mean = ShapeVector::Zero();
    mean.head<kBoneLengthCount>() = space.mean;
    constant_ = J_ * mean;
    constant_.tail<kGirthCount>().setZero();
  }
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Eigen::Map<const ShapeVector> shape(parameters[0]);
    Eigen::Map<Rows>{residuals} = J_ * shape - constant_;
    if (jacobians != nullptr && jacobians[0] != nullptr) Eigen::Map<JacobianRows>{jacobians[0]} = J_;
    return true;
  }

 private:
  static constexpr int kRows = 2 * kBoneLengthCount + kGirthCount;
  using Rows = Eigen::Matrix<double, kRows, 1>;
  using JacobianRows = Eigen::Matrix<double, kRows, kShapeCount, Eigen::RowMajor>;
  JacobianRows J_;
  Rows constant_;
};

// Marker offsets about those of the average body of these lengths.
class OffsetCost : public ceres::SizedCostFunction<kOffsetCount, kShapeCount, kOffsetCount> {
 public:
  OffsetCost() : average_(averageOffsets() / kOffsetDeviation_m), scale_(1.0 / kOffsetDeviation_m) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Eigen::Map<const LengthVector> s(parameters[0]);
    const Eigen::Map<const OffsetVector> v(parameters[1]);
    Eigen::Map<OffsetVector>{residuals} = scale_ * v - average_ * s;
    if (jacobians == nullptr) return true;
    if (jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, kOffsetCount, kShapeCount, Eigen::RowMajor>> J(jacobians[0]);
      J.setZero();
      J.leftCols<kBoneLengthCount>() = -average_;
    }
    if (jacobians[1] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, kOffsetCount, kOffsetCount, Eigen::RowMajor>>{jacobians[1]} =
          scale_ * Eigen::Matrix<double, kOffsetCount, kOffsetCount>::Identity();
    }
    return true;
  }

 private:
  Eigen::Matrix<double, kOffsetCount, kBoneLengthCount> average_;
  double scale_;
};

struct PlacedPoint {
  const BodyTemplate::Point* model = nullptr;
  Eigen::Vector3f p_world = Eigen::Vector3f::Zero();
  Eigen::Vector3f n_world = Eigen::Vector3f::Zero();
};
struct PlacedTemplate {
  std::array<std::vector<PlacedPoint>, kPartCount> parts;
  PartPoints points;  // the same, for the search
};

// The template's points in one pose, those that face the camera.
PlacedTemplate place(const BodyTemplate& body, const ShapeVector& shape, const ForwardKinematics& fk) {
  PlacedTemplate placed;
  for (const BodyTemplate::Point& point : body.points()) {
    const Vector3d p = fk.position({point.bone, body.place(point, shape)});
    const Vector3d n = fk.R_world_bone(point.bone) * body.normal(point, shape);
    if (n.dot(p) >= 0) continue;
    const auto part = static_cast<std::size_t>(partIndex(point.part));
    placed.parts[part].push_back({&point, p.cast<float>(), n.cast<float>()});
    placed.points.add(part, p.cast<float>());
  }
  placed.points.finish();
  return placed;
}

void matchCloud(const PlacedTemplate& placed, const std::vector<CloudPoint>& cloud, std::vector<CloudMatch>& matches) {
  matches.clear();
  constexpr PointLikelihood kLikelihood{kNearness_m, kReach_m};
  for (const CloudPoint& sample : cloud) {
    const auto found = placed.points.find(sample.p_world, PartDoubts(sample.probability, kPartDoubt), kLikelihood);
    if (!found) continue;
    const PlacedPoint& best = placed.parts[found->part][found->index];
    const Vector3d n = best.n_world.cast<double>();
    const double off = n.dot((best.p_world - sample.p_world).cast<double>());
    matches.push_back({best.model, sample.p_world.cast<double>(), n, lorentzianWeight(off, kLorentzian_m)});
  }
}

// The outermost point of each end's part.
void matchEnds(const BodyTemplate& body, const ShapeVector& shape, const ForwardKinematics& fk,
               const std::vector<BodyEnd>& ends, std::vector<EndMatch>& matches) {
  matches.clear();
  const auto& e = body.ends();
  for (const BodyEnd& end : ends) {
    const BodyTemplate::Point* best = nullptr;
    double reach = std::numeric_limits<double>::lowest();
    const auto consider = [&](const BodyTemplate::Point& point) {
      if (point.part != end.part) return;
      const double r = end.direction.dot(fk.position({point.bone, body.place(point, shape)}));
      if (r <= reach) return;
      reach = r;
      best = &point;
    };
    for (const BodyTemplate::Point& point : body.points()) consider(point);
    for (const auto* point : {&e.crown, &e.left_tip, &e.right_tip, &e.left_sole, &e.right_sole}) consider(*point);
    if (best != nullptr) matches.push_back({*best, end.direction, end.offset});
  }
}

// The state of a solve: parameters, and what they are compared with.
class JointProblem {
 public:
  JointProblem(const BodyTemplate& body, const ShapeSpace& space, const std::vector<PoseObservation>& observations,
               const ShapeVector& shape, const JointSolveConfig& config)
      : body_(body), space_(space), observations_(observations), config_(config), shape_(shape) {
    const MarkerModel average = averageMarkerModel(makeSkeleton(boneLengths(shape)));
    bones_ = bonesOf(average);
    for (std::size_t i = 0; i < kPartCount; ++i)
      offsets_.segment<3>(3 * static_cast<Eigen::Index>(i)) = average[i].p_bone;
    for (const PoseObservation& observation : observations) poses_.push_back(observation.q);
    matches_.resize(observations.size());
  }

  void match() {
    for (std::size_t t = 0; t < observations_.size(); ++t) {
      fk_.update(makeSkeleton(boneLengths(shape_)), poses_[t]);
      const PlacedTemplate placed = place(body_, shape_, fk_);
      matchCloud(placed, observations_[t].cloud, matches_[t].cloud);
      matchEnds(body_, shape_, fk_, observations_[t].ends, matches_[t].ends);
    }
  }

  void solve() {
    ceres::Problem problem;
    for (std::size_t t = 0; t < observations_.size(); ++t) {
      problem.AddResidualBlock(new PoseCost(body_, observations_[t], matches_[t], bones_, config_), nullptr,
                               shape_.data(), offsets_.data(), poses_[t].data());
    }
    problem.AddResidualBlock(new ShapeCost(body_, space_), nullptr, shape_.data());
    problem.AddResidualBlock(new OffsetCost(), nullptr, shape_.data(), offsets_.data());
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.max_num_iterations = config_.iterations;
    options.num_threads = config_.threads;
    options.logging_type = ceres::SILENT;
    options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    for (Pose& q : poses_) options.linear_solver_ordering->AddElementToGroup(q.data(), 0);
    options.linear_solver_ordering->AddElementToGroup(shape_.data(), 1);
    options.linear_solver_ordering->AddElementToGroup(offsets_.data(), 1);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    cost_ = summary.final_cost;
  }

  [[nodiscard]] JointSolution solution() {
    match();
    JointSolution result;
    result.shape = shape_;
    result.cost = cost_;
    result.poses = poses_;
    for (std::size_t i = 0; i < kPartCount; ++i) {
      result.markers[i] = {bones_[i], offsets_.segment<3>(3 * static_cast<Eigen::Index>(i))};
    }
    measureFit(result);
    return result;
  }

 private:
  void measureFit(JointSolution& result) {
    double surface = 0, cloud = 0, matched = 0, marker = 0, seen = 0;
    for (std::size_t t = 0; t < observations_.size(); ++t) {
      fk_.update(makeSkeleton(boneLengths(shape_)), poses_[t]);
      cloud += static_cast<double>(observations_[t].cloud.size());
      matched += static_cast<double>(matches_[t].cloud.size());
      for (const CloudMatch& match : matches_[t].cloud) {
        const Vector3d p = fk_.position({match.model->bone, body_.place(*match.model, shape_)});
        surface += std::pow(match.n_world.dot(p - match.p_world), 2);
      }
      const MarkerSet& markers = observations_[t].markers_world;
      for (int i = 0; i < kPartCount; ++i) {
        const double c = markers.confidence[i];
        marker +=
            c * (fk_.position(result.markers[static_cast<std::size_t>(i)]) - markers.position.col(i)).squaredNorm();
        seen += c;
      }
    }
    result.rms_surface_m = matched > 0 ? std::sqrt(surface / matched) : 0;
    result.matched_share = cloud > 0 ? matched / cloud : 0;
    result.rms_marker_m = seen > 0 ? std::sqrt(marker / seen) : 0;
  }

  const BodyTemplate& body_;
  const ShapeSpace& space_;
  const std::vector<PoseObservation>& observations_;
  const JointSolveConfig& config_;
  ShapeVector shape_;
  OffsetVector offsets_;
  std::array<Bone, kPartCount> bones_{};
  std::vector<Pose> poses_;
  std::vector<Matches> matches_;
  ForwardKinematics fk_;
  double cost_ = 0;
};

}  // namespace

JointSolution solveJointly(const BodyTemplate& body, const ShapeSpace& space,
                           const std::vector<PoseObservation>& observations, const ShapeVector& shape,
                           const JointSolveConfig& config) {
  DMC_CHECK(!observations.empty());
  JointProblem problem(body, space, observations, shape, config);
  for (int round = 0; round < config.rounds; ++round) {
    problem.match();
    problem.solve();
  }
  return problem.solution();
}

}  // namespace depthmocap
