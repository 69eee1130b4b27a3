#pragma once
#include <memory>

#include "depthmocap/camera_model.h"
#include "depthmocap/depth_frame.h"
#include "libtracker/classify/part_classifier.h"
#include "libtracker/markers/find_markers.h"
#include "libtracker/segment/segment.h"
#include "libtracker/tracker/evidence.h"
#include "libtracker/tracker/prediction.h"
#include "libtracker/tracker/tracker_config.h"

namespace depthmocap {

// From a person's pixels to evidence: (1) parts, (2) markers, samples of the surface.
class Observer {
 public:
  Observer(std::shared_ptr<const PartClassifier> classifier, const CameraModel& camera, const TrackerConfig& config);

  // (1) a body part for each pixel of the actor; the pose before helps to tell left from right.
  void label(const DepthFrame& frame, const PersonRegion& actor, const Prediction& prediction, Evidence& evidence);
  // (2) one marker for each part, and samples of the surface. Markers are expected where the prediction has them; null:
  // nothing is expected.
  void locate(const PartRadii& radii_m, const Prediction* prediction, const Eigen::Matrix3d& R_world_camera,
              Evidence& evidence);
  // The evidence as if the camera saw this side of the actor for certain; of the image that was labelled last.
  void assume(Facing facing, const Evidence& seen, const PartRadii& radii_m, const Eigen::Matrix3d& R_world_camera,
              Evidence& supposed);

  // Whether it makes a difference which side is supposed.
  [[nodiscard]] bool tellsFacings() const { return classifier_->tellsFacings(); }
  [[nodiscard]] const CameraModel& camera() const { return camera_; }

  // A measurement's own markers in place of the found ones (TrackerMeasurement); does nothing otherwise.
  void overrideMarkers(std::optional<MarkerSet> markers_camera) { known_markers_ = std::move(markers_camera); }

 private:
  const std::shared_ptr<const PartClassifier> classifier_;
  const CameraModel camera_;
  ClassifyConfig config_;
  const bool expect_sides_;
  std::unique_ptr<PartClassifier::Memory> memory_;
  MarkerFinder finder_;
  std::optional<MarkerSet> known_markers_;
};

}  // namespace depthmocap
