#include "libtracker/ik/ik_files.h"
#include "libtracker/recording/track_files.h"
#include "libtracker/recording/tum_index.h"
#include "tests/fuzz/fuzz.h"

using namespace depthmocap;

static void read(std::string_view bytes) {
  const MemoryFile file(bytes);
  each([&] { (void)readJointsFile(file.path()); }, [&] { (void)readPoseFile(file.path()); },
       [&] { (void)readTargetsFile(file.path()); }, [&] { (void)readTumIndex("/nowhere", file.path()); });
}
DEPTHMOCAP_FUZZ(read)
