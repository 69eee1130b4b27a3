#pragma once
#include <memory>
#include <optional>

#include "depthmocap/camera_model.h"
#include "depthmocap/depth_frame.h"
#include "depthmocap/models.h"
#include "libtracker/classify/room_classifier.h"
#include "libtracker/segment/segment.h"
#include "libtracker/tracker/tracker_config.h"
#include "libtracker/tracker/upright_world.h"

namespace depthmocap {

// What is the same for all people in an image: (0) who is where, the floor, and how the world stands.
class SceneObserver {
 public:
  SceneObserver(const Models& models, const CameraModel& camera, const TrackerConfig& config);

  // (0) everybody's pixels and the floor. Valid until the next call.
  const Segmentation& segment(const DepthFrame& frame, const ExpectedPeople& expected);

  [[nodiscard]] const CameraModel& camera() const { return camera_; }

  UprightWorld world;

 private:
  const std::shared_ptr<const RoomClassifier> room_;
  const CameraModel camera_;
  const SegmentConfig range_;
  const int threads_;
  RoomClassifier::Memory room_memory_;
  RoomMap map_;
  Segmenter segmenter_;
  Segmentation segmentation_;
};

}  // namespace depthmocap
