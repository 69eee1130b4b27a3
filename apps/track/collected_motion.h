#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "depthmocap/tracked_frame.h"
#include "libtracker/clinical/opensim.h"
#include "libtracker/output/motion_track.h"

namespace depthmocap {

// The whole motion of everybody in a run, for files that need it at once: a body's bone lengths and the height of the
// floor are known only at its end.
struct CollectedMotion {
  // One frame of one person for marker files and OpenSim.
  struct Sample {
    std::int64_t frame = 0;
    double time_s = 0;
    bool seen = false;                                            // else only frame and time
    JointPositions joints_world = JointPositions::Zero();         // [m]
    OpenSimCoordinates coordinates = OpenSimCoordinates::Zero();  // with pelvis_tx ty tz from the world's origin
  };
  struct Person {
    int number = 1;
    BoneLengths lengths;  // at the end
    MotionTrackBuilder motion;
    std::vector<Sample> samples;
    OpenSimReader open_sim;
  };

  // Everybody in the next frame; the same number of people at every call. Samples are kept only where asked for.
  void add(std::span<const TrackedFrame* const> people, bool with_samples);
  // The file of one person: the path itself, or M-2.bvh for M.bvh where people are several.
  [[nodiscard]] std::filesystem::path pathOf(const std::filesystem::path& path, const Person& person) const;

  std::vector<Person> people;
};

}  // namespace depthmocap
