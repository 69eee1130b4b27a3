#include "libtracker/motion/asf_amc.h"
#include "libtracker/motion/bvh.h"
#include "tests/fuzz/fuzz.h"

using namespace depthmocap;

// A BVH; or an ASF, and from a line "AMC" on the motion of it.
static void read(std::string_view bytes) {
  constexpr std::string_view kMotion = "\nAMC\n";
  const std::size_t split = bytes.find(kMotion);
  const MemoryFile first(bytes.substr(0, split));
  each([&] { (void)readBvh(first.path()); },
       [&] {
         const AsfSkeleton skeleton = readAsf(first.path());
         if (split == std::string_view::npos) return;
         const MemoryFile second(bytes.substr(split + kMotion.size()));
         (void)readAmc(second.path(), skeleton, 120.0);
       });
}
DEPTHMOCAP_FUZZ(read)
