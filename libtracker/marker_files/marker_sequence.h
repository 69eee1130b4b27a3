#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace depthmocap {

// Where one marker is over time.
struct MarkerTrack {
  std::string name;
  Eigen::Matrix3Xd p;                          // [m] a column a frame, in the frame of the file; 0 where not seen
  Eigen::Array<bool, Eigen::Dynamic, 1> seen;  // of each frame
};

// Markers or joints over time, as a file holds them.
struct MarkerSequence {
  double fps = 30.0;                // [1/s] (> 0)
  std::vector<std::int64_t> frame;  // number of each frame, growing
  std::vector<double> time_s;       // of each frame, growing
  std::vector<MarkerTrack> tracks;

  [[nodiscard]] std::size_t frames() const { return time_s.size(); }
  // The track of this name; nullptr if there is none.
  [[nodiscard]] const MarkerTrack* find(std::string_view name) const;
  // Adds tracks of these names over all frames, without anything seen.
  void addTracks(const std::vector<std::string>& names);
};

// What a kind of file takes for up, where its markers do not say.
enum class UpAxis { PlusX, MinusX, PlusY, MinusY, PlusZ, MinusZ };

}  // namespace depthmocap
