#pragma once
#include <filesystem>
#include <memory>

#include "libtracker/recording/recording.h"

namespace depthmocap {

// An OpenNI recording: each depth picture once, in order, the same at every reading. Numbers and times count from the
// first picture; left and right are as the camera saw them, also where the recording is mirrored. Error as
// openRecording.
std::unique_ptr<RecordingReader> openOniRecording(const std::filesystem::path& file);

}  // namespace depthmocap
