#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "libtracker/skeleton/length_vector.h"

namespace depthmocap {

// The skeleton shape space of method section A (6): s = H tau + s_mean, a PCA model over bone lengths.
struct ShapeSpace {
  LengthVector mean = LengthVector::Zero();                   // [m]
  Eigen::Matrix<double, kBoneLengthCount, Eigen::Dynamic> H;  // orthonormal columns, most important first
  Eigen::VectorXd deviation;                                  // [m] standard deviation along each column (> 0)
  std::string origin;                                         // one line: data

  // (I - H H^T) (s - mean): what of s lies outside the space [m].
  [[nodiscard]] LengthVector offSpace(const LengthVector& s) const;
};

// Combines the adults that a family of bodies describes with the proportions of measured people. A dozen skeletons are
// too few to say how size varies, and their joints are defined otherwise than ours; a family of typical bodies knows
// size and sex, and no proportions. So the covariance is the sum of
//   that of the family: both sexes, statures normal about 1.69 m with 0.10 m (typicalBoneLengths);
//   that of what is left of each measured skeleton when the family's mean member of its stature is taken away, as a
//   share of the stature, about the mean of these rests (which holds the difference of the joints' definitions).
// `share` (0 .. 1): columns of the PCA are kept until they hold this much of the variance. Needs >= 2 skeletons.
ShapeSpace makeShapeSpace(const std::vector<BoneLengths>& measured, double share, const std::string& origin);

// JSON. Error naming the file where it is missing, damaged or no shape space.
ShapeSpace loadShapeSpace(const std::filesystem::path& path);
void saveShapeSpace(const std::filesystem::path& path, const ShapeSpace& space);

}  // namespace depthmocap
