#include "libtracker/repair/marker_body.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "libtracker/core/check.h"
#include "libtracker/skeleton/joint_limits.h"
#include "libtracker/skeleton/length_vector.h"

namespace depthmocap {
namespace {

// [m] what a marker is off by in a view: noise, soft tissue, and what a skeleton of rigid bones cannot show.
constexpr double kMarkerNoise_m = 0.02;
// Deviation of a bone's length from that of a scaled average body, as a share of it (proportions of adults vary by 3 to
// 6 %; Drillis and Contini 1966).
constexpr double kProportionDeviation = 0.05;
// Deviation of the scale: people are 1.1 to 2.1 m tall.
constexpr double kScaleDeviation = 0.2;
constexpr int kIterations = 20;
constexpr double kGainTolerance = 1e-4;
// A body's length and its change for derivatives, which are exact because joints are linear in bone lengths.
constexpr double kLengthStep = 0.1;

// Unknowns of the body: 12 lengths over those of the average body, the scale, three of an offset for each marker.
constexpr int kLengths = kBoneLengthCount;
constexpr int kScale = kLengths;
constexpr int kFirstOffset = kLengths + 1;

using Eigen::MatrixXd;
using Eigen::VectorXd;

class BodyFit {
 public:
  BodyFit(const MarkerBody& body, const std::vector<MarkerView>& views, const PosePrior* prior)
      : views_(views), prior_(prior), body_(body), b_(kFirstOffset + 3 * static_cast<int>(body.markers.size())) {
    average_ = lengthVector(BoneLengths{});
    b_.head<kLengths>() = lengthVector(body.skeleton.lengths).cwiseQuotient(average_);
    b_[kScale] = b_.head<kLengths>().mean();
    for (std::size_t m = 0; m < body.markers.size(); ++m) offset(b_, m) = body.markers[m].offset;
  }

  void solve(std::vector<Pose>& poses) {
    double energy = energyOf(b_, poses);
    double mu = 1e-3;
    for (int i = 0; i < kIterations; ++i) {
      VectorXd b = b_;
      std::vector<Pose> q = poses;
      step(mu, b, q);
      const double next = energyOf(b, q);
      if (!(next < energy)) {
        mu *= 10.0;
        continue;
      }
      const bool is_done = energy - next < kGainTolerance * energy;
      b_ = b;
      poses = q;
      energy = next;
      mu = std::max(1e-6, 0.3 * mu);
      if (is_done) break;
    }
  }
  [[nodiscard]] MarkerBody body() const { return bodyOf(b_); }

 private:
  static Eigen::Ref<Eigen::Vector3d> offset(VectorXd& b, std::size_t m) {
    return b.segment<3>(kFirstOffset + 3 * static_cast<int>(m));
  }
  [[nodiscard]] MarkerBody bodyOf(const VectorXd& b) const {
    MarkerBody body = body_;
    body.skeleton = makeSkeleton(boneLengths(average_.cwiseProduct(b.head<kLengths>())));
    for (std::size_t m = 0; m < body.markers.size(); ++m) {
      body.markers[m].offset = b.segment<3>(kFirstOffset + 3 * static_cast<int>(m));
    }
    return body;
  }
  double energyOf(const VectorXd& b, const std::vector<Pose>& poses) const {
    const MarkerBody body = bodyOf(b);
    double energy =
        (b.head<kLengths>().array() - b[kScale]).square().sum() / (kProportionDeviation * kProportionDeviation) +
        (b[kScale] - 1.0) * (b[kScale] - 1.0) / (kScaleDeviation * kScaleDeviation);
    for (std::size_t m = 0; m < body.markers.size(); ++m) {
      energy += body.markers[m].offset.squaredNorm() / std::pow(body.markers[m].site.deviation_m, 2);
    }
    ForwardKinematics fk;
    VectorXd r(prior_ == nullptr ? 0 : prior_->rows());
    for (std::size_t v = 0; v < views_.size(); ++v) {
      fk.update(body.skeleton, poses[v]);
      for (std::size_t i = 0; i < views_[v].markers.size(); ++i) {
        energy += (fk.position(body.point(views_[v].markers[i])) - views_[v].p[i]).squaredNorm() /
                  (kMarkerNoise_m * kMarkerNoise_m);
      }
      if (prior_ == nullptr) continue;
      prior_->evaluate(shapeOf(poses[v]), r, nullptr);
      energy += r.squaredNorm();
    }
    return energy;
  }
  // The normal equations of one view; the body's part in the columns of b.
  struct ViewEquations {
    Eigen::Matrix<double, kDofCount, kDofCount> A;
    MatrixXd A_body;  // kDofCount x b
    Pose g;
  };
  // Adds a view's rows to the body's equations and gives its own.
  ViewEquations equations(const MarkerBody& body, const std::vector<Skeleton>& longer, std::size_t v, const Pose& q,
                          MatrixXd& A, VectorXd& g) const;
  void addPrior(const Pose& q, ViewEquations& view) const;
  void step(double mu, VectorXd& b, std::vector<Pose>& poses) const;

  const std::vector<MarkerView>& views_;
  const PosePrior* prior_;
  MarkerBody body_;
  LengthVector average_;
  VectorXd b_;
};

void BodyFit::addPrior(const Pose& q, ViewEquations& view) const {
  VectorXd r(prior_->rows());
  MatrixXd J;
  prior_->evaluate(shapeOf(q), r, &J);
  MatrixXd J_pose = MatrixXd::Zero(r.size(), kDofCount);
  for (int i = 0; i < kShapeDofCount; ++i) J_pose.col(kShapeDofs[static_cast<std::size_t>(i)]) = J.col(i);
  view.A.noalias() += J_pose.transpose() * J_pose;
  view.g.noalias() += J_pose.transpose() * r;
}

BodyFit::ViewEquations BodyFit::equations(const MarkerBody& body, const std::vector<Skeleton>& longer, std::size_t v,
                                          const Pose& q, MatrixXd& A, VectorXd& g) const {
  const MarkerView& seen = views_[v];
  const auto rows = static_cast<Eigen::Index>(3 * seen.markers.size());
  MatrixXd J = MatrixXd::Zero(rows, kDofCount);
  MatrixXd J_body = MatrixXd::Zero(rows, b_.size());
  VectorXd r(rows);
  ForwardKinematics fk;
  fk.update(body.skeleton, q);
  PointJacobian point_jacobian;
  for (std::size_t i = 0; i < seen.markers.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(3 * i);
    const std::size_t m = seen.markers[i];
    const BonePoint point = body.point(m);
    r.segment<3>(row) = fk.position(point) - seen.p[i];
    fk.jacobian(point, point_jacobian);
    J.middleRows<3>(row) = point_jacobian;
    J_body.block<3, 3>(row, kFirstOffset + 3 * static_cast<Eigen::Index>(m)) = fk.R_world_bone(point.bone);
  }
  MarkerBody changed = body;
  for (int k = 0; k < kLengths; ++k) {
    changed.skeleton = longer[static_cast<std::size_t>(k)];
    ForwardKinematics fk_longer;
    fk_longer.update(changed.skeleton, q);
    for (std::size_t i = 0; i < seen.markers.size(); ++i) {
      const std::size_t m = seen.markers[i];
      J_body.block<3, 1>(static_cast<Eigen::Index>(3 * i), k) =
          (fk_longer.position(changed.point(m)) - fk.position(body.point(m))) / kLengthStep;
    }
  }
  const double information = 1.0 / (kMarkerNoise_m * kMarkerNoise_m);
  A.noalias() += information * J_body.transpose() * J_body;
  g.noalias() += information * J_body.transpose() * r;
  ViewEquations view{information * J.transpose() * J, information * J.transpose() * J_body,
                     information * J.transpose() * r};
  if (prior_ != nullptr) addPrior(q, view);
  return view;
}

// One damped step; poses are eliminated from the equations (Schur complement).
void BodyFit::step(double mu, VectorXd& b, std::vector<Pose>& poses) const {
  const MarkerBody body = bodyOf(b);
  std::vector<Skeleton> longer;
  for (int k = 0; k < kLengths; ++k) {
    VectorXd b_longer = b;
    b_longer[k] += kLengthStep;
    longer.push_back(bodyOf(b_longer).skeleton);
  }
  MatrixXd A = MatrixXd::Zero(b.size(), b.size());
  VectorXd g = VectorXd::Zero(b.size());
  const double proportion = 1.0 / (kProportionDeviation * kProportionDeviation);
  for (int k = 0; k < kLengths; ++k) {
    const double excess = b[k] - b[kScale];
    A(k, k) += proportion;
    A(kScale, kScale) += proportion;
    A(k, kScale) -= proportion;
    A(kScale, k) -= proportion;
    g[k] += proportion * excess;
    g[kScale] -= proportion * excess;
  }
  A(kScale, kScale) += 1.0 / (kScaleDeviation * kScaleDeviation);
  g[kScale] += (b[kScale] - 1.0) / (kScaleDeviation * kScaleDeviation);
  for (std::size_t m = 0; m < body.markers.size(); ++m) {
    const double information = std::pow(body.markers[m].site.deviation_m, -2);
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = kFirstOffset + 3 * static_cast<Eigen::Index>(m) + axis;
      A(i, i) += information;
      g[i] += information * b[i];
    }
  }
  std::vector<ViewEquations> views;
  for (std::size_t v = 0; v < views_.size(); ++v) views.push_back(equations(body, longer, v, poses[v], A, g));
  std::vector<Eigen::LLT<Eigen::Matrix<double, kDofCount, kDofCount>>> factors;
  for (ViewEquations& view : views) {
    view.A.diagonal() *= 1.0 + mu;
    view.A.diagonal().array() += 1e-6 + mu;
    factors.emplace_back(view.A);
    const MatrixXd solved = factors.back().solve(view.A_body);
    A.noalias() -= view.A_body.transpose() * solved;
    g.noalias() -= solved.transpose() * view.g;
  }
  A.diagonal() *= 1.0 + mu;
  const VectorXd db = -A.ldlt().solve(g);
  for (std::size_t v = 0; v < views.size(); ++v) {
    poses[v] = clampedToLimits(poses[v] - factors[v].solve(views[v].g + views[v].A_body * db));
  }
  b += db;
  b.head<kLengths>() = b.head<kLengths>().cwiseMax(0.1);  // a bone has some length
}

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool areNeighbours(Bone a, Bone b) {
  const auto parent = [](Bone bone) { return kBoneParents[static_cast<std::size_t>(bone)]; };
  return a == b || parent(a) == static_cast<int>(b) || parent(b) == static_cast<int>(a);
}

}  // namespace

BonePoint MarkerBody::point(std::size_t marker) const {
  BonePoint point = sitePoint(markers[marker].site, skeleton);
  point.p_bone += markers[marker].offset;
  return point;
}

PointTargets viewTargets(const MarkerBody& body, const MarkerView& view) {
  PointTargets targets;
  for (std::size_t i = 0; i < view.markers.size(); ++i) {
    targets.targets.push_back({body.point(view.markers[i]), view.p[i], 1.0});
  }
  return targets;
}

double roughScale(const MarkerBody& body, const std::vector<MarkerView>& views) {
  ForwardKinematics fk;
  fk.update(body.skeleton, Pose::Zero());
  std::vector<double> ratios;
  for (const MarkerView& view : views) {
    for (std::size_t i = 0; i < view.markers.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const BonePoint a = body.point(view.markers[i]);
        const BonePoint b = body.point(view.markers[k]);
        const double nominal_m = (fk.position(a) - fk.position(b)).norm();
        // Shorter distances tell more about markers' offsets than about the body.
        if (nominal_m < 0.12 || !areNeighbours(a.bone, b.bone)) continue;
        ratios.push_back((view.p[i] - view.p[k]).norm() / nominal_m);
      }
    }
  }
  return ratios.empty() ? 1.0 : medianOf(std::move(ratios));
}

void fitMarkerBody(MarkerBody& body, const std::vector<MarkerView>& views, const PosePrior* prior,
                   std::vector<Pose>& poses) {
  DMC_CHECK(views.size() == poses.size() && !views.empty());
  BodyFit fit(body, views, prior);
  fit.solve(poses);
  body = fit.body();
}

}  // namespace depthmocap
