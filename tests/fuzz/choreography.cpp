#include "libtracker/choreography/motion_reader.h"
#include "tests/fuzz/fuzz.h"

using namespace depthmocap;

static void read(std::string_view bytes) {
  (void)readMotionFile(bytes, "fuzz");
}
DEPTHMOCAP_FUZZ(read)
