#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "libtracker/marker_files/marker_sequence.h"

namespace depthmocap {

// Gathers a sequence frame by frame while a file is read.
class MarkerCollector {
 public:
  MarkerCollector(std::filesystem::path path, std::vector<std::string> names);

  // Error naming the file where numbers or times do not grow, or where there are too many samples.
  void startFrame(std::int64_t frame, double time_s);
  // The marker's place [m] in the frame that was started; not finite or all 0: not seen.
  void add(std::size_t marker, const Eigen::Vector3d& p);
  // named_fps: what the file says, or 0: from the times.
  [[nodiscard]] MarkerSequence finish(double named_fps);

 private:
  std::filesystem::path path_;
  std::vector<std::string> names_;
  std::vector<std::int64_t> frame_;
  std::vector<double> time_s_;
  std::vector<Eigen::Vector3d> samples_;  // frame by frame
  std::vector<bool> seen_;
};

}  // namespace depthmocap
