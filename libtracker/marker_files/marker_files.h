#pragma once
#include <filesystem>

#include "libtracker/marker_files/marker_sequence.h"

namespace depthmocap {

// Kinds of files that hold markers, by the end of their name.
enum class MarkerFileKind { JointsCsv, Trc, C3d };

// Error where the name ends otherwise than in .csv, .trc or .c3d.
MarkerFileKind markerFileKind(const std::filesystem::path& path);
// Which way is up in files of this kind unless their markers say otherwise: joints files are in a camera's frame (y
// down), TRC files of OpenSim have y up, C3D files of most laboratories z.
UpAxis usualUpAxis(MarkerFileKind kind);

// Reads joints files (person 1 of several), TRC and C3D files. A marker counts as not seen where its coordinates are
// missing, not finite or all 0; where a joint's confidence is 0; where a C3D point's residual is negative. At most
// kMaxMarkerSamples markers times frames. Error naming the file, and the line or the field, where it is damaged or
// holds no marker.
MarkerSequence readMarkers(const std::filesystem::path& path);

inline constexpr std::size_t kMaxMarkerSamples = 20'000'000;  // [markers x frames] 500 MB

// Writes TRC (mm) and C3D files (mm, floating point). What is not seen is left empty (TRC) or marked as invalid (C3D).
// Whole or not at all.
void writeTrc(const MarkerSequence& markers, const std::filesystem::path& path);
void writeC3d(const MarkerSequence& markers, const std::filesystem::path& path);

// The readers of one kind each.
MarkerSequence readJointMarkers(const std::filesystem::path& path);
MarkerSequence readTrc(const std::filesystem::path& path);
MarkerSequence readC3d(const std::filesystem::path& path);

}  // namespace depthmocap
