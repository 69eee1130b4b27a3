#include "libtracker/sensor/open_source.h"
#include "tests/fuzz/fuzz.h"

using namespace depthmocap;

// A stream from its header to its end.
static void receive(std::string_view bytes) {
  const MemoryFile file(bytes);
  const auto source = openSource("pipe:" + file.path().string(), {});
  SensorFrame frame;
  while (source->next(frame, std::chrono::milliseconds(100)) != SourceState::Ended) continue;
}
DEPTHMOCAP_FUZZ(receive)
