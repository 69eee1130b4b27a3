#include "libtracker/choreography/motion_library.h"

#include <array>
#include <string>
#include <string_view>

#include "libtracker/choreography/motion_reader.h"

namespace depthmocap {

// Made by depthmocap_embed() in libtracker/CMakeLists.txt.
std::string_view embeddedSharedMotions();
std::string_view embeddedLocomotionMotions();
std::string_view embeddedJumpMotions();
std::string_view embeddedFightingMotions();
std::string_view embeddedGestureMotions();
std::string_view embeddedDrawingMotions();
std::string_view embeddedSportsMotions();
std::string_view embeddedEverydayMotions();
std::string_view embeddedSittingMotions();
std::string_view embeddedFloorMotions();
std::string_view embeddedExerciseMotions();
std::string_view embeddedStanceMotions();
std::string_view embeddedDanceMotions();

namespace {

struct EmbeddedFile {
  std::string_view name;
  std::string_view (*text)();
};

constexpr std::array kFiles = {
    EmbeddedFile{"motions/locomotion.json", &embeddedLocomotionMotions},
    EmbeddedFile{"motions/jumps.json", &embeddedJumpMotions},
    EmbeddedFile{"motions/fighting.json", &embeddedFightingMotions},
    EmbeddedFile{"motions/gestures.json", &embeddedGestureMotions},
    EmbeddedFile{"motions/drawing.json", &embeddedDrawingMotions},
    EmbeddedFile{"motions/sports.json", &embeddedSportsMotions},
    EmbeddedFile{"motions/everyday.json", &embeddedEverydayMotions},
    EmbeddedFile{"motions/sitting.json", &embeddedSittingMotions},
    EmbeddedFile{"motions/floor.json", &embeddedFloorMotions},
    EmbeddedFile{"motions/exercise.json", &embeddedExerciseMotions},
    EmbeddedFile{"motions/stances.json", &embeddedStanceMotions},
    EmbeddedFile{"motions/dance.json", &embeddedDanceMotions},
};

std::vector<MotionFile> readLibrary() {
  const MotionFile shared = readMotionFile(embeddedSharedMotions(), "motions/shared.json");
  std::vector<MotionFile> files;
  files.reserve(kFiles.size());
  for (const EmbeddedFile& file : kFiles) files.push_back(readMotionFile(file.text(), std::string(file.name), shared));
  return files;
}

}  // namespace

const std::vector<MotionFile>& motionLibrary() {
  static const std::vector<MotionFile> files = readLibrary();
  return files;
}

}  // namespace depthmocap
