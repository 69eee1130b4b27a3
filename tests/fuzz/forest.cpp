#include <cstring>

#include <zlib.h>

#include "libtracker/classify/forest_file.h"
#include "libtracker/classify/forest_layout.h"
#include "tests/fuzz/fuzz.h"

using namespace depthmocap;

template <typename T>
static void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// The bytes as a file, and as what a file with a right checksum holds unpacked: facings, nodes of one tree, its data.
static void read(std::string_view bytes) {
  each([&] { (void)loadForest(MemoryFile(bytes).path()); });
  if (bytes.size() < 3) return;
  std::uint16_t nodes = 0;
  std::memcpy(&nodes, bytes.data() + 1, sizeof nodes);
  const std::string_view raw = bytes.substr(3);
  std::string packed(compressBound(raw.size()), '\0');
  uLongf packed_bytes = packed.size();
  compress2(reinterpret_cast<Bytef*>(packed.data()), &packed_bytes, reinterpret_cast<const Bytef*>(raw.data()),
            raw.size(), 1);
  std::string body;
  put(body, std::uint32_t{nodes});
  body.append(packed, 0, packed_bytes);
  std::string file(kForestMagic.data(), kForestMagic.size());
  put(file, kForestVersion);
  put(file, std::uint32_t{1});
  put(file, static_cast<std::uint32_t>((bytes[0] & 1) != 0 ? 4 : 1));
  put(file, std::uint32_t{0});
  put(file, std::uint64_t{packed_bytes});
  put(file, std::uint64_t{raw.size()});
  put(file, static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(body.data()), body.size())));
  (void)loadForest(MemoryFile(file + body).path());
}
DEPTHMOCAP_FUZZ(read)
