#include "libtracker/marker_files/marker_sequence.h"

#include <algorithm>

namespace depthmocap {

const MarkerTrack* MarkerSequence::find(std::string_view name) const {
  const auto found = std::find_if(tracks.begin(), tracks.end(), [&](const MarkerTrack& t) { return t.name == name; });
  return found == tracks.end() ? nullptr : &*found;
}

void MarkerSequence::addTracks(const std::vector<std::string>& names) {
  const auto count = static_cast<Eigen::Index>(frames());
  for (const std::string& name : names) {
    MarkerTrack track{name, Eigen::Matrix3Xd::Zero(3, count), {}};
    track.seen.setConstant(count, false);
    tracks.push_back(std::move(track));
  }
}

}  // namespace depthmocap
