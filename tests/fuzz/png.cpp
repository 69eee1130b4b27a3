#include "libtracker/recording/png_file.h"
#include "tests/fuzz/fuzz.h"

using namespace depthmocap;

static void read(std::string_view bytes) {
  const MemoryFile file(bytes);
  Image<std::uint16_t> depth;
  Image<std::uint8_t> labels;
  each([&] { readPng16(file.path(), 8, 6, depth); }, [&] { readPng8(file.path(), 8, 6, labels); });
}
DEPTHMOCAP_FUZZ(read)
