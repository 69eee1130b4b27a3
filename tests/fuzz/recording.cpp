#include "libtracker/recording/recording_header.h"
#include "tests/fuzz/fuzz.h"

using namespace depthmocap;

static void read(std::string_view bytes) {
  const MemoryFile file(bytes);
  const RecordingInfo info = readRecordingHeader(file.path());
  writeRecordingHeader("/dev/null", info);  // what is read can be written
}
DEPTHMOCAP_FUZZ(read)
