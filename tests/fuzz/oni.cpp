#include "libtracker/recording/oni_reader.h"
#include "tests/fuzz/fuzz.h"

using namespace depthmocap;

static void read(std::string_view bytes) {
  const MemoryFile file(bytes);
  const auto reader = openOniRecording(file.path());
  DepthFrame frame;
  for (std::size_t i = 0; i < reader->frameCount() && i < 4; ++i) {
    each([&] { reader->read(i, frame); });
  }
}
DEPTHMOCAP_FUZZ(read)
