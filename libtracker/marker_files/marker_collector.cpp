#include "libtracker/marker_files/marker_collector.h"

#include <cmath>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/marker_files/marker_files.h"

namespace depthmocap {

MarkerCollector::MarkerCollector(std::filesystem::path path, std::vector<std::string> names)
    : path_(std::move(path)), names_(std::move(names)) {
  if (names_.empty()) throw Error("names no marker", path_.string());
}

void MarkerCollector::startFrame(std::int64_t frame, double time_s) {
  if (!frame_.empty() && (frame <= frame_.back() || time_s <= time_s_.back())) {
    throw Error(fmt::format("frame {} at {} s: numbers and times must grow", frame, time_s), path_.string());
  }
  if (samples_.size() + names_.size() > kMaxMarkerSamples) {
    throw Error(fmt::format("holds more than {} markers times frames", kMaxMarkerSamples), path_.string(),
                "cut it into parts");
  }
  frame_.push_back(frame);
  time_s_.push_back(time_s);
  samples_.resize(samples_.size() + names_.size(), Eigen::Vector3d::Zero());
  seen_.resize(samples_.size(), false);
}

void MarkerCollector::add(std::size_t marker, const Eigen::Vector3d& p) {
  if (!p.allFinite() || p.isZero(0)) return;
  const std::size_t at = samples_.size() - names_.size() + marker;
  samples_[at] = p;
  seen_[at] = true;
}

MarkerSequence MarkerCollector::finish(double named_fps) {
  MarkerSequence markers;
  markers.frame = std::move(frame_);
  markers.time_s = std::move(time_s_);
  markers.addTracks(names_);
  const std::size_t count = markers.frames();
  if (named_fps > 0) markers.fps = named_fps;
  if (!(named_fps > 0) && count > 1) {
    const double fps = static_cast<double>(count - 1) / (markers.time_s.back() - markers.time_s.front());
    markers.fps = std::round(fps * 1000.0) / 1000.0;  // times in a file are rounded, too
  }
  for (std::size_t m = 0; m < names_.size(); ++m) {
    for (std::size_t t = 0; t < count; ++t) {
      const auto column = static_cast<Eigen::Index>(t);
      markers.tracks[m].p.col(column) = samples_[t * names_.size() + m];
      markers.tracks[m].seen[column] = seen_[t * names_.size() + m];
    }
  }
  return markers;
}

}  // namespace depthmocap
