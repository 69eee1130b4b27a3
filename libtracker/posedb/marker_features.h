#pragma once
#include <Eigen/Core>

#include "depthmocap/marker_set.h"
#include "libtracker/posedb/marker_table.h"

namespace depthmocap {

inline constexpr int kMaxMarkerFeatures = 30;
using MarkerFeatures = Eigen::Matrix<float, Eigen::Dynamic, 1, 0, kMaxMarkerFeatures, 1>;  // [m]

// Principal components of the shape of the database's markers, and how to tell them from a part of the markers.
//
// A shape is the 15 markers about their mean, turned by the best rotation onto the mean shape (any rotation, or about
// the vertical only), so that the Euclidean distance of two shapes is close to the aligned distance of equation (3).
//
// Model of a seen marker: R p_i = mean_i + W_i z + t + noise, z ~ N(0, diag(variance)), R and t unknown, and noise the
// part of the database's variance that the components leave out, plus a measuring error. A query's features are the
// posterior mean of z; so what is not seen is filled in by regression on what is.
class MarkerFeatureSpace {
 public:
  // count: components, 1 .. kMaxMarkerFeatures; upright: shapes are turned about the vertical only.
  MarkerFeatureSpace(const MarkerTable& table, int count, bool upright);

  struct Estimate {
    MarkerFeatures z;
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  // from the markers' frame to the shape's
    double energy = 0;                                // robust misfit plus z's distance from the mean; less is better
  };

  [[nodiscard]] int count() const { return count_; }
  // Components of database pose n.
  [[nodiscard]] MarkerFeatures project(const MarkerTable& table, std::size_t n) const;
  // The rotation of the seen markers onto the mean shape: where estimate() can start without further knowledge.
  [[nodiscard]] Eigen::Matrix3d roughRotation(const MarkerSet& markers) const;
  // z and R for the seen markers [m] of an actor of the database's size, any place and direction, by turns from
  // R_start; the Lorentzian's influence keeps stray markers from counting. Without markers z = 0.
  void estimate(const MarkerSet& markers, const Eigen::Matrix3d& R_start, Estimate& result) const;

 private:
  using Shape = Eigen::Matrix<double, 3, kPartCount>;
  using Coordinates = Eigen::Matrix<double, 3 * kPartCount, 1>;  // a shape, column by column
  using PartWeights = Eigen::Matrix<double, kPartCount, 1>;

  [[nodiscard]] Eigen::Matrix3d rotationOnto(const Shape& target, const Shape& markers,
                                             const PartWeights& weights) const;
  [[nodiscard]] Shape alignedShape(const MarkerTable& table, std::size_t n) const;
  void learn(const MarkerTable& table);
  [[nodiscard]] Shape fitted(const Shape& markers, const PartWeights& weights, MarkerFeatures& z) const;

  int count_;
  bool upright_;
  Shape mean_ = Shape::Zero();
  Coordinates noise_variance_;  // [m^2]
  Eigen::Matrix<double, 3 * kPartCount, Eigen::Dynamic, 0, 3 * kPartCount, kMaxMarkerFeatures> components_;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxMarkerFeatures, 1> variance_;  // [m^2]
};

}  // namespace depthmocap
