#pragma once
#include <filesystem>
#include <vector>

#include "apps/track/recording_run.h"

namespace depthmocap {

// Tracks every recording below the folder options.recording, several at the same time (track.threads), into folders of
// the same names below `out`: joints.csv, pose.csv, angles.csv, motion.bvh and, last, stats.json. Recordings that have
// a stats.json are done and left alone. Writes out/summary.csv and prints it in short on standard output. Error where
// the folder holds no recording, where `out` was made with other options, and, after all the others are done, where a
// recording failed.
void replayFolder(const ReplayOptions& options, const std::filesystem::path& out);

// The recordings below a folder, as paths relative to it, sorted.
std::vector<std::filesystem::path> recordingsBelow(const std::filesystem::path& folder);

}  // namespace depthmocap
