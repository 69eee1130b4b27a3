#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include "libtracker/clinical/body_signals.h"
#include "libtracker/clinical/clinical_angles.h"
#include "libtracker/recording/track_files.h"

namespace depthmocap {

// One row of an angles file (docs/reference/angles.md). All zero where the actor is lost; empty in the file.
struct AnglesRow {
  std::int64_t frame = 0;
  double time_s = 0;
  TrackState state = TrackState::Lost;
  ClinicalAngles angles = ClinicalAngles::Zero();              // [deg]
  ClinicalConfidence confidence = ClinicalConfidence::Zero();  // [0, 1]
  BodySignals signals;
  int person = 1;  // number; in files of several people only
};

// What an angles file says of a tracked frame; the reader has read the frames of this person before.
AnglesRow anglesRow(const TrackedFrame& tracked, ClinicalAngleReader& reader);

// The rows of one person. Error with file and line where the file is damaged.
std::vector<AnglesRow> readAnglesFile(const std::filesystem::path& path, int person = 1);

// Row by row, as JointsWriter.
class AnglesWriter {
 public:
  explicit AnglesWriter(const std::filesystem::path& path, FileOf kind = FileOf::OneActor);
  ~AnglesWriter();
  void write(const AnglesRow& row);
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
