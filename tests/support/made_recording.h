#pragma once
#include <cmath>
#include <filesystem>
#include <vector>

#include "libtracker/recording/recording.h"

namespace depthmocap {

// A small camera for tests.
inline RecordingInfo smallCamera(int width = 8, int height = 6) {
  RecordingInfo info;
  info.camera.width = width;
  info.camera.height = height;
  info.camera.fx = info.camera.fy = width;
  info.camera.cx = (width - 1) / 2.0;
  info.camera.cy = (height - 1) / 2.0;
  info.camera_name = "test";
  return info;
}

// A picture that tells its number: pixel i is 1 m plus a pattern of `number`, in whole millimetres.
inline DepthImage patternDepth(const CameraModel& camera, int number) {
  DepthImage depth(camera.width, camera.height);
  for (std::size_t i = 0; i < depth.data.size(); ++i) {
    const auto mm = 1000 + (static_cast<int>(i) * 7 + number * 13) % 3000;
    depth.data[i] = static_cast<float>(mm * 0.001);
  }
  return depth;
}

inline DepthFrame patternFrame(const CameraModel& camera, int number, double fps) {
  DepthFrame frame;
  frame.frame = number;
  frame.time_s = number / fps;
  frame.depth = patternDepth(camera, number);
  return frame;
}

// A recording of pattern frames with these numbers.
inline void makeRecording(const std::filesystem::path& folder, const RecordingInfo& info,
                          const std::vector<int>& numbers) {
  RecordingWriter writer(folder, info);
  for (const int number : numbers) writer.write(patternFrame(info.camera, number, info.fps));
}

// Frames 0 ... count - 1.
inline void makeRecording(const std::filesystem::path& folder, const RecordingInfo& info, int count) {
  std::vector<int> numbers;
  for (int i = 0; i < count; ++i) numbers.push_back(i);
  makeRecording(folder, info, numbers);
}

}  // namespace depthmocap
