#pragma once
#include <filesystem>
#include <memory>
#include <optional>

#include "libtracker/recording/recording.h"

namespace depthmocap {

// The list of pictures by which a folder is one of the TUM RGB-D benchmark (Sturm et al. 2012): depth.txt with rows
// `time file`, or else associations.txt, whose rows have two of them. Nothing where there is none.
std::optional<std::filesystem::path> tumIndex(const std::filesystem::path& folder);

// The recording that such a list describes. Pictures of 640x480 and 5000 steps a metre are the benchmark's own; cameras
// of others write the same folders, with pictures of other sizes, in millimetres, with frame numbers in place of times.
// What follows from the first picture and the rows is taken so, and told in RecordingInfo::guesses, unless `correction`
// says it. Throws Error as openRecording does.
std::unique_ptr<RecordingReader> openTumFolder(const std::filesystem::path& folder, const std::filesystem::path& index,
                                               const RecordingCorrection& correction);

}  // namespace depthmocap
