#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "forest/render/other_person.h"
#include "forest/render/scene_kind.h"
#include "forest/render/sensor_model.h"
#include "forest/render/staging.h"

namespace depthmocap {

inline constexpr std::size_t kMostOthers = 5;  // labels of six people: as many as are tracked

// How a motion becomes a recording.
struct SynthesisConfig {
  SensorKind sensor = SensorKind::Kinect1;
  CameraModel camera = sensorCamera(SensorKind::Kinect1);
  bool noise = true;
  SceneKind scene = SceneKind::None;
  StagingConfig staging;
  double camera_tilt = 0;           // [rad] down
  std::vector<OtherPerson> others;  // at most kMostOthers
  std::uint64_t seed = 1;           // of noise and scene
  int threads = 1;                  // (>= 1) the result does not depend on it
  std::string note;                 // for recording.json
};

// Renders a clip as a recording with truth: depth/, truth/joints.csv (confidence 1 where the joint lies inside the
// image, else 0), truth/pose.csv (the upright world, the camera at its origin), truth/labels/%06d.png (parts of what
// each pixel measured). The files of the others end in -2, -3 and so on, their labels are part + 16 * (person - 1).
// SceneKind::Empty: the actor is not there, joints are lost, pose.csv has no rows. Frames count from 0. `progress` is
// called with the number of finished frames. Throws Error where the folder exists or cannot be written.
void synthesizeRecording(const MotionClip& clip, const BodySurface& body, const SynthesisConfig& config,
                         const std::filesystem::path& folder, const std::function<void(std::size_t)>& progress = {});

}  // namespace depthmocap
