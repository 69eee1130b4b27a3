#include "libtracker/tracker/scene_observer.h"

#include <functional>

namespace depthmocap {

SceneObserver::SceneObserver(const Models& models, const CameraModel& camera, const TrackerConfig& config)
    : room_(models.room),
      camera_(camera),
      range_(config.segment),
      threads_(config.threads),
      segmenter_(config.segment) {}

const Segmentation& SceneObserver::segment(const DepthFrame& frame, const ExpectedPeople& expected) {
  const auto ask = [&](const DepthImage& depth) -> const RoomMap& {
    room_->classify(depth, camera_, range_.min_depth_m, range_.max_depth_m, threads_, room_memory_, map_);
    return map_;
  };
  const RoomLook look = std::ref(ask);  // no copy: nothing is allocated
  segmenter_.segment(frame.depth, camera_, look, expected, segmentation_);
  return segmentation_;
}

}  // namespace depthmocap
