#include <cstring>

#include <zlib.h>

#include "libtracker/classify/room_network.h"
#include "libtracker/ik/learned_poses.h"
#include "libtracker/posedb/pose_database.h"
#include "libtracker/posedb_build/pose_mixture.h"
#include "tests/fuzz/fuzz.h"

using namespace depthmocap;

// The checksum of a pose database stands behind 32 bytes of the head; a wrong one would hide all that follows.
static std::string withChecksum(std::string_view bytes) {
  constexpr std::size_t kChecksumAt = 32;
  std::string file(bytes);
  if (file.size() < kChecksumAt + 4) return file;
  const auto* body = reinterpret_cast<const Bytef*>(file.data()) + kChecksumAt + 4;
  const auto checksum = static_cast<std::uint32_t>(crc32_z(0, body, file.size() - kChecksumAt - 4));
  std::memcpy(file.data() + kChecksumAt, &checksum, sizeof checksum);
  return file;
}

static void read(std::string_view bytes) {
  const MemoryFile file(bytes);
  each([&] { (void)loadLearnedPoses(file.path()); }, [&] { (void)loadPoseMixture(file.path()); },
       [&] { (void)loadRoomNetwork(file.path()); },
       [&] { (void)loadPoseDatabase(MemoryFile(withChecksum(bytes)).path()); });
}
DEPTHMOCAP_FUZZ(read)
