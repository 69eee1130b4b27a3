#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>

#include "depthmocap/camera_model.h"
#include "depthmocap/depth_frame.h"
#include "depthmocap/image.h"
#include "depthmocap/marker_set.h"
#include "depthmocap/tracked_frame.h"
#include "libtracker/classify/forest.h"
#include "libtracker/posedb/pose_database.h"
#include "libtracker/skeleton/surface_model.h"
#include "libtracker/tracker/actor_model.h"
#include "libtracker/tracker/tracker_config.h"

namespace depthmocap {

// What the tracker has learned beforehand. Constant; may be shared by trackers on several threads.
struct TrackerModels {
  Forest forest;
  PoseDatabase database;
  SurfaceModel surface;  // of an average body; without points the dense term is off
};

// What a measurement knows of a frame and gives instead of what is found in it, so that errors can be told apart by the
// stage that makes them; null: found as ever.
struct KnownEvidence {
  const PartImage* labels = nullptr;          // the part of each pixel, the size of the depth image
  const MarkerSet* markers_camera = nullptr;  // [m]
};

// Tracks one actor through the frames of one camera (Su, Chai, Xia 2016; method section A).
// Deterministic: the same frames give the same results for any number of threads. Not thread-safe.
class Tracker {
 public:
  // `actor`: a calibrated body; without one tracking starts from an average body and adapts its size by itself.
  Tracker(std::shared_ptr<const TrackerModels> models, const CameraModel& camera, const TrackerConfig& config,
          const std::optional<ActorModel>& actor = std::nullopt);
  ~Tracker();

  // The pose of one frame; times must increase. The result is valid until the next call. What is `known` must outlive
  // the call.
  const TrackedFrame& process(const DepthFrame& frame, const KnownEvidence& known = {});

  // Between frames: forgets the actor; the next frame looks for somebody anew. An uncalibrated actor's size starts at
  // the average again.
  void reset();
  // The same, and the next frame looks for the person nearest to this point [m], camera frame.
  void lockOn(const Eigen::Vector3d& p_camera);
  // The same with another body, say of a calibration that has just ended; `models` with its surface.
  void use(std::shared_ptr<const TrackerModels> models, const ActorModel& actor);

  // The body in use.
  [[nodiscard]] const ActorModel& actor() const;

 private:
  struct Stages;
  std::unique_ptr<Stages> stages_;
  std::unique_ptr<Stages> next_stages_;  // of use(), from the next frame on
};

}  // namespace depthmocap
