#include "libtracker/motion/asf_amc.h"
#include "libtracker/motion/bone_roles.h"
#include "libtracker/motion/bvh.h"
#include "libtracker/motion/mirrored_sides.h"
#include "tests/fuzz/fuzz.h"

using namespace depthmocap;

static void look(const SourceMotion& motion) {
  const NamedBones named = namedBones(motion.bones, {}, "motion");
  (void)findBoneRoles(meanBones(motion), named, "motion");
  if (!motion.frames.empty()) (void)sidesAreMirrored(motion, named);
}

// A BVH; or an ASF, and from a line "AMC" on the motion of it.
static void read(std::string_view bytes) {
  constexpr std::string_view kMotion = "\nAMC\n";
  const std::size_t split = bytes.find(kMotion);
  const MemoryFile first(bytes.substr(0, split));
  each([&] { look(readBvh(first.path())); },
       [&] {
         const AsfSkeleton skeleton = readAsf(first.path());
         if (split == std::string_view::npos) return;
         const MemoryFile second(bytes.substr(split + kMotion.size()));
         look(readAmc(second.path(), skeleton, 120.0));
       });
}
DEPTHMOCAP_FUZZ(read)
