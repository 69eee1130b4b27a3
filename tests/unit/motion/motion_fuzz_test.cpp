// Damaged motion files end in an Error or are read; they never crash, hang or fill the memory.
#include "libtracker/motion/asf_amc.h"
#include "libtracker/motion/bvh.h"
#include "libtracker/motion/bvh_writer.h"
#include "libtracker/motion/motion_files.h"
#include "tests/unit/motion/motion_test_files.h"

namespace depthmocap {
namespace {

// One to three bytes flipped, deleted, inserted or a stretch repeated.
std::string mutated(std::string text, Random& random) {
  static constexpr std::string_view kInserted = "{}()#:-+.eE09 \n\t\r\0\xff";
  const std::uint32_t count = 1 + random.below(3);
  for (std::uint32_t i = 0; i < count && !text.empty(); ++i) {
    const std::size_t at = random.below(static_cast<std::uint32_t>(text.size()));
    switch (random.below(4)) {
      case 0:
        text[at] = static_cast<char>(random.below(256));
        break;
      case 1:
        text.erase(at, 1 + random.below(12));
        break;
      case 2:
        text.insert(at, 1, kInserted[random.below(static_cast<std::uint32_t>(kInserted.size()))]);
        break;
      default:
        text.insert(at, text.substr(at, random.below(40)));
    }
  }
  return text;
}

class MotionFuzz : public test::MotionFolder {
 protected:
  static constexpr int kRounds = 200;

  // Reads damaged copies of `good`; some must be found damaged and some still be read, or the test tests nothing.
  template <typename Read>
  void run(const std::string& good, const std::string& name, Read&& read) const {
    Random random(2024);
    int errors = 0;
    int successes = 0;
    for (int i = 0; i < kRounds; ++i) {
      const auto path = write(name, mutated(good, random));
      try {
        read(path);
        ++successes;
      } catch (const Error&) {
        ++errors;
      }
    }
    EXPECT_GT(errors, kRounds / 20);
    EXPECT_GT(successes, kRounds / 20);
  }
};

TEST_F(MotionFuzz, Asf) {
  run(test::kAsf, "f.asf", [](const auto& path) { readAsf(path); });
}

TEST_F(MotionFuzz, Amc) {
  const AsfSkeleton skeleton = readAsf(write("good.asf", test::kAsf));
  run(test::kAmc, "f.amc", [&](const auto& path) { readAmc(path, skeleton, 30.0); });
}

TEST_F(MotionFuzz, Bvh) {
  run(test::kBvh, "f.bvh", [](const auto& path) { readBvh(path); });
}

TEST_F(MotionFuzz, RetargetingOfDamagedBodies) {
  BvhWriter writer(file("body.bvh"), makeSkeleton(BoneLengths{}), 30.0);
  Random poses(1);
  for (int i = 0; i < 2; ++i) writer.write(test::randomPose(poses, 0.5));
  writer.finish();
  const std::string good = textOf(file("body.bvh"));
  Random random(7);
  int finite = 0;
  for (int i = 0; i < 100; ++i) {
    try {
      const MotionClip clip = loadMotion(write("f.bvh", mutated(good, random)));
      for (const Pose& q : clip.poses) EXPECT_TRUE(q.allFinite());
      ++finite;
    } catch (const Error&) {
    }
  }
  EXPECT_GT(finite, 5);
}

}  // namespace
}  // namespace depthmocap
