#include <functional>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/core/random.h"
#include "libtracker/ik/ik_files.h"
#include "libtracker/recording/recording.h"
#include "libtracker/recording/track_files.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

constexpr int kMutations = 500;

// Replaces, removes or doubles a few bytes.
std::string mutated(std::string bytes, Random& random) {
  const std::uint32_t changes = 1 + random.below(4);
  for (std::uint32_t i = 0; i < changes && !bytes.empty(); ++i) {
    const std::size_t at = random.below(static_cast<std::uint32_t>(bytes.size()));
    switch (random.below(4)) {
      case 0:
        bytes[at] = static_cast<char>(random.below(256));
        break;
      case 1:
        bytes[at] = "0123456789-+.,eE\"{}[]\n#"[random.below(23)];
        break;
      case 2:
        bytes.erase(at, 1 + random.below(20));
        break;
      default:
        bytes.insert(at, bytes.substr(at, 1 + random.below(20)));
    }
  }
  return bytes;
}

// `read` may throw Error, and nothing else, on any mutation of `file`. Some must be refused, and not each one.
void expectOnlyErrors(const std::filesystem::path& file, const std::string& good, const std::function<void()>& read) {
  Random random(2024);
  int refused = 0;
  for (int i = 0; i < kMutations; ++i) {
    writeBytes(file, mutated(good, random));
    try {
      read();
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_LT(refused, kMutations);
}

class MutatedRecording : public testing::TestWithParam<const char*> {};

TEST_P(MutatedRecording, IsReadOrRefusedWithAnError) {
  const TemporaryFolder folder;
  std::filesystem::copy(testData("recordings/good"), folder.path(), std::filesystem::copy_options::recursive);
  const std::filesystem::path file = folder / GetParam();
  expectOnlyErrors(file, readBytes(file), [&] {
    const auto recording = openRecording(folder.path());
    DepthFrame frame;
    for (std::size_t i = 0; i < recording->frameCount(); ++i) {
      recording->read(i, frame);
      for (const float depth : frame.depth.data) ASSERT_TRUE(depth >= 0);
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Files, MutatedRecording, testing::Values("recording.json", "frames.csv"),
                         [](const auto& test) { return std::string(test.param, std::string(test.param).find('.')); });

TEST(MutatedJointsFile, IsReadOrRefusedWithAnError) {
  const TemporaryFolder folder;
  expectOnlyErrors(folder / "joints.csv", readBytes(testData("tracks/joints_good.csv")), [&] {
    for (const JointsRow& row : readJointsFile(folder / "joints.csv")) ASSERT_TRUE(row.p_camera.allFinite());
  });
}

TEST(MutatedPoseFile, IsReadOrRefusedWithAnError) {
  const TemporaryFolder folder;
  expectOnlyErrors(folder / "pose.csv", readBytes(testData("tracks/pose_good.csv")), [&] {
    for (const PoseRow& row : readPoseFile(folder / "pose.csv")) ASSERT_TRUE(row.q.allFinite());
  });
}

TEST(MutatedTargetsFile, IsReadOrRefusedWithAnError) {
  const TemporaryFolder folder;
  expectOnlyErrors(folder / "targets.csv", readBytes(testData("ik/targets_good.csv")), [&] {
    for (const PoseTargets& pose : readTargetsFile(folder / "targets.csv")) {
      ASSERT_GT(pose.targets.count(), 0);
      ASSERT_TRUE(pose.targets.p_world.allFinite());
    }
  });
}

}  // namespace
}  // namespace depthmocap
