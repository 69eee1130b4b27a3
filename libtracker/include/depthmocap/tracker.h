#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>

#include "depthmocap/actor.h"
#include "depthmocap/camera_model.h"
#include "depthmocap/depth_frame.h"
#include "depthmocap/export.h"
#include "depthmocap/models.h"
#include "depthmocap/tracked_frame.h"

namespace depthmocap {

struct TrackerConfig;

// Tracks one actor, or several people, through the frames of one camera (Su, Chai, Xia 2016; docs/architecture.md).
// People have numbers from 1 on that stay through crossing, touching and hiding. A number is free once its person has
// been lost for TrackPolicy::absent_s; who comes then gets that of the one he is like, else one that nobody had.
// Deterministic: the same frames give the same results for any number of threads. Not thread-safe.
class DEPTHMOCAP_API Tracker {
 public:
  // With the default configuration. Without an actor tracking starts from an average body and fits its size over the
  // first seconds; a given actor, who is the first person, keeps its size. Throws Error where a part of the models is
  // missing or the camera has no size or focal length.
  Tracker(const Models& models, const CameraModel& camera, const std::optional<Actor>& actor = std::nullopt);
  // Throws Error for an invalid configuration, too.
  Tracker(const Models& models, const CameraModel& camera, const TrackerConfig& config,
          const std::optional<Actor>& actor = std::nullopt);
  ~Tracker();
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  // The pose of one frame, whose depth has the camera's size [px] and is in metres, undistorted, 0 = no measurement;
  // times must increase. A frame without a person is no error: see TrackedFrame::state. The result is valid until the
  // next call. Throws Error for a frame of another size. Of several people the result is the first one's.
  const TrackedFrame& process(const DepthFrame& frame);
  // Everybody in the frame that was processed last, one entry per number in the order of the numbers; who is not there
  // is lost. Valid until the next call of process().
  [[nodiscard]] std::span<const TrackedFrame* const> people() const;

  // Between frames: forgets everybody; the next frame looks for somebody anew. The size of an actor who was not given
  // starts at the average again.
  void reset();
  // The same, and the next frame looks for the person nearest to this point [m], camera frame.
  // Throws Error where there is no such person.
  void lockOn(const Eigen::Vector3d& p_camera, int person = 1);
  // Between frames: the same person with another body, for example that of a calibration that has just ended. Tracking
  // goes on; nothing is loaded or searched for, so no frame waits. The body keeps its size, also after reset(). Poses
  // are still looked up with the proportions that the tracker began with, at the new body's size.
  // Throws Error where there is no such person.
  void use(const Actor& actor, int person = 1);

  // The body in use. Throws Error where there is no such person.
  [[nodiscard]] const Actor& actor(int person = 1) const;

 private:
  friend struct FittedBody;
  friend struct FrameEvidence;
  friend struct TrackerMeasurement;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
