#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "depthmocap/pose.h"

namespace depthmocap {

// The heterogeneous pose database Q (Su, Chai, Xia 2016, section 2.3): poses free of body size, place and heading
// (root_tx = root_ty = root_tz = root_ry = 0). One file, loaded whole.
struct PoseDatabase {
  struct Source {
    std::string name;         // motion
    std::uint32_t first = 0;  // index of its first pose
    std::uint32_t count = 0;  // poses kept
  };
  std::vector<Eigen::Matrix<float, kDofCount, 1>> poses;
  std::vector<Source> sources;
  std::string origin;  // one line: how it was made

  [[nodiscard]] std::size_t size() const { return poses.size(); }
  [[nodiscard]] Pose pose(std::size_t i) const { return poses[i].cast<double>(); }
};

// Both throw Error (missing, not a database, truncated, checksum, version).
PoseDatabase loadPoseDatabase(const std::filesystem::path& path);
void savePoseDatabase(const PoseDatabase& database, const std::filesystem::path& path);

}  // namespace depthmocap
