#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "depthmocap/camera_model.h"
#include "libtracker/core/classified_pixels.h"

namespace depthmocap {

// Weighted surface points of one part, camera frame [m], as one array a component.
struct PartVotes {
  std::vector<float> x, y, z;
  std::vector<float> weight;  // [m^2] probability * seen surface
  std::vector<float> area;    // [m^2] seen surface of the voting pixels
  [[nodiscard]] std::size_t size() const { return x.size(); }
  void clear();
};

// Classified pixels gathered into cubes of the camera frame, so that the cost of a mode search depends on the seen
// surface and not on the resolution. A cube stands at the mean of its pixels. Cubes are in the order of their first
// pixel.
class VoxelVotes {
 public:
  // A pixel covers (stride * z / f)^2 of surface and votes for each part of at least `min_probability`.
  void build(const ClassifiedPixels& pixels, const CameraModel& camera, double min_probability, double voxel_m);
  // The cubes with a vote for this part.
  void gather(int part, PartVotes& votes) const;

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t generation = 0;
    std::uint32_t voxel = 0;
  };
  struct Voxel {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    float pixels = 0;
    std::array<float, kPartCount + 1> weight{};  // one more than parts, for whole vector registers
    std::array<float, kPartCount + 1> area{};
  };

  Voxel& voxelAt(const Eigen::Vector3f& p_camera, float inverse_voxel);

  std::vector<Slot> slots_;  // open addressing; the size is a power of two
  std::uint32_t generation_ = 0;
  std::vector<Voxel> voxels_;
};

}  // namespace depthmocap
