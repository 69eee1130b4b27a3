#include "libtracker/actor/template_surface.h"

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/body/make_template_surface.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

// The committed file is what the body generator makes. After a change of the generator:
// build/depthmocap body-templates --out libtracker/actor/models/bodies.bin
TEST(ShippedBodies, AreWhatTheGeneratorMakes) {
  EXPECT_TRUE(shippedBodiesToBytes(makeShippedBodies()) ==
              readBytes(std::string(DEPTHMOCAP_SOURCE_DIR) + "/libtracker/actor/models/bodies.bin"));
}

TEST(ShippedBodies, ReadBackWhatWasWritten) {
  const std::string bytes = shippedBodiesToBytes(shippedBodies());
  EXPECT_TRUE(shippedBodiesToBytes(shippedBodiesFromBytes(bytes)) == bytes);
  EXPECT_NEAR(statureOf(shippedBodies().man.lengths), 1.75, 1e-9);
  EXPECT_NEAR(statureOf(shippedBodies().woman.lengths), 1.62, 1e-9);
}

TEST(ShippedBodies, RefuseDamage) {
  const std::string good = shippedBodiesToBytes(shippedBodies());
  EXPECT_THROW(shippedBodiesFromBytes("nothing"), Error);
  EXPECT_THROW(shippedBodiesFromBytes(good + "x"), Error);
  for (std::size_t length = 8; length < good.size(); length += 997) {
    EXPECT_THROW(shippedBodiesFromBytes(good.substr(0, length)), Error) << length;
  }
  std::string no_bone = good;
  no_bone[8 + 13 * 8 + 4] = '\xff';  // the bone of the first point
  EXPECT_THROW(shippedBodiesFromBytes(no_bone), Error);
}

}  // namespace
}  // namespace depthmocap
