#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "forest/render/scene_kind.h"
#include "forest/render/sensor_model.h"
#include "forest/render/staging.h"

namespace depthmocap {

// Somebody else in the view.
struct Bystander {
  MotionClip clip;  // played once from the first frame on; the last pose stays
  BodySurface body;
  StagingConfig staging;
  // Person 2 of the truth: labels are part + 16, and truth/joints-2.csv and truth/pose-2.csv are written.
  bool in_truth = false;
  // [m] moved aside until the pelvises stay this far apart, 0 = not moved.
  double apart_m = 0;
};

// How a motion becomes a recording.
struct SynthesisConfig {
  SensorKind sensor = SensorKind::Kinect1;
  CameraModel camera = sensorCamera(SensorKind::Kinect1);
  bool noise = true;
  SceneKind scene = SceneKind::None;
  StagingConfig staging;
  double camera_tilt = 0;  // [rad] down
  std::optional<Bystander> bystander;
  std::uint64_t seed = 1;  // of noise and scene
  int threads = 1;         // (>= 1) the result does not depend on it
  std::string note;        // for recording.json
};

// Renders a clip as a recording with truth: depth/, truth/joints.csv (confidence 1 where the joint lies inside the
// image, else 0), truth/pose.csv (the upright world, the camera at its origin), truth/labels/%06d.png (parts of what
// each pixel measured). SceneKind::Empty: nobody is there, joints are lost, pose.csv has no rows. Frames count from 0.
// `progress` is called with the number of finished frames. Throws Error where the folder exists or cannot be written.
void synthesizeRecording(const MotionClip& clip, const BodySurface& body, const SynthesisConfig& config,
                         const std::filesystem::path& folder, const std::function<void(std::size_t)>& progress = {});

}  // namespace depthmocap
