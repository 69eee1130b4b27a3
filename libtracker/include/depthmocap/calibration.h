#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "depthmocap/actor.h"
#include "depthmocap/camera_model.h"
#include "depthmocap/depth_frame.h"
#include "depthmocap/export.h"
#include "depthmocap/models.h"

namespace depthmocap {

struct CalibrationOptions {
  int frames = 10;                    // (>= 1) good frames that are needed and used
  std::optional<double> stature_m{};  // [m] (1.0 .. 2.3) of the actor, if known: fixes the scale
  std::string camera_name{};          // kept in the actor file; may be empty
  int threads = 2;                    // (>= 1); the result does not depend on it
};

// What the last frame was worth.
struct CalibrationAdvice {
  bool good = false;    // a T-pose, kept
  std::string text;     // what the actor should change, one sentence without a full stop; empty for a good frame
  int good_frames = 0;  // so far
};

// Measures an actor who stands in a T-pose (docs/guide/calibration.md): hand it frames of one camera and tell the actor
// its advice until it has enough, then solve. Not thread-safe; deterministic.
class DEPTHMOCAP_API Calibration {
 public:
  // Calls its argument with each of some frames, in order.
  using Frames = std::function<void(const std::function<void(const DepthFrame&)>&)>;

  // `models`: those that the actor will be tracked with. Throws Error for an invalid option and where a file of the
  // library is missing.
  Calibration(const Models& models, const CameraModel& camera, const CalibrationOptions& options = {});
  ~Calibration();
  Calibration(Calibration&& other) noexcept;
  Calibration& operator=(Calibration&& other) noexcept;

  // Judges a frame (depth [m], the camera's size) and keeps it if it is a good one.
  CalibrationAdvice add(const DepthFrame& frame);
  // Whether there are as many good frames as needed.
  [[nodiscard]] bool enough() const;

  // The measured actor; takes about a second. Throws Error saying what to change: too few good frames, two people, no
  // body that fits.
  Actor solve();
  // The same, and more exact where joints are bent in `others`: up to 300 frames of the same actor in any poses, which
  // are tracked first.
  Actor solve(const Frames& others);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
