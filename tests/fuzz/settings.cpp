#include "depthmocap/actor.h"
#include "libtracker/tracker/config_file.h"
#include "tests/fuzz/fuzz.h"

using namespace depthmocap;

static void read(std::string_view bytes) {
  const MemoryFile file(bytes);
  TrackerConfig config;
  each([&] { (void)readActorFile(file.path()); }, [&] { readConfigFile(file.path(), config); });
}
DEPTHMOCAP_FUZZ(read)
