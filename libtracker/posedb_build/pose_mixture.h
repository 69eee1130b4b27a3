#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "depthmocap/pose.h"
namespace depthmocap {

// A learned model of natural poses: a mixture of local linear Gaussians over the DoFs that do not depend on where the
// actor stands (mixtures of factor analysers in spirit: Ghahramani and Hinton 1996; fitted by k-means and a PCA per
// cluster, forest/pose_model). It keeps statistics of many poses per component, no pose itself. Samples of it fill the
// pose database that ships.
struct PoseMixture {
  static constexpr int kDims = 10;  // principal directions a component
  struct Component {
    float weight = 0;                                                                               // sums to 1
    Eigen::Matrix<float, kDofCount, 1> mean = Eigen::Matrix<float, kDofCount, 1>::Zero();           // [rad]
    Eigen::Matrix<float, kDofCount, kDims> basis = Eigen::Matrix<float, kDofCount, kDims>::Zero();  // orthonormal
    Eigen::Matrix<float, kDims, 1> deviation = Eigen::Matrix<float, kDims, 1>::Zero();              // [rad]
    float residual = 0;  // [rad] deviation in each other direction of kShapeDofs; of a fit only, no file keeps it
  };
  std::vector<Component> components;
  std::string origin;  // one line: data and command
};

// `count` poses within joint limits and within two deviations of their component, components drawn by the square root
// of their weight so that rare poses are not crowded out by walking.
std::vector<Eigen::Matrix<float, kDofCount, 1>> samplePoses(const PoseMixture& mixture, std::size_t count,
                                                            std::uint64_t seed);

// Stored with 16 bits a number. Throw Error (missing, not a pose mixture, truncated).
PoseMixture loadPoseMixture(const std::filesystem::path& path);
void savePoseMixture(const PoseMixture& mixture, const std::filesystem::path& path);

}  // namespace depthmocap
