#include "libtracker/ik/learned_poses.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/unit/ik/some_learned_poses.h"

namespace depthmocap {
namespace {

TEST(LearnedPosesFile, KeepsWhatWasSaved) {
  const TemporaryFolder folder;
  const LearnedPoses poses = someLearnedPoses();
  saveLearnedPoses(poses, folder / "a.bin");
  const LearnedPoses loaded = loadLearnedPoses(folder / "a.bin");
  EXPECT_EQ(loaded.origin, "random numbers");
  ASSERT_EQ(loaded.mixture.size(), 2U);
  EXPECT_EQ(loaded.mixture[1].weight, 0.75);
  EXPECT_LT((loaded.mixture[1].mean - poses.mixture[1].mean).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT((loaded.autoencoder.encoder.layers[1].W - poses.autoencoder.encoder.layers[1].W).cwiseAbs().maxCoeff(),
            1e-3F);
  EXPECT_EQ(loaded.variational.decoder.inputs(), 5);
  saveLearnedPoses(loaded, folder / "b.bin");
  EXPECT_EQ(readBytes(folder / "a.bin"), readBytes(folder / "b.bin"));
}

TEST(LearnedPosesFile, RefusesDamage) {
  const TemporaryFolder folder;
  saveLearnedPoses(someLearnedPoses(), folder / "good.bin");
  const std::string good = readBytes(folder / "good.bin");
  const auto errorOfBytes = [&](const std::string& bytes) {
    writeBytes(folder / "bad.bin", bytes);
    return errorOf([&] { loadLearnedPoses(folder / "bad.bin"); });
  };
  EXPECT_EQ(errorOfBytes(good), "");
  EXPECT_NE(errorOf([&] { loadLearnedPoses(folder / "none.bin"); }).find("none.bin"), std::string::npos);
  for (std::size_t size = 0; size < good.size(); size += size < 100 ? 1 : 97) {
    EXPECT_NE(errorOfBytes(good.substr(0, size)).find("bad.bin"), std::string::npos) << size;
  }
  EXPECT_NE(errorOfBytes("x" + good), "");
  EXPECT_NE(errorOfBytes(good + "x"), "");
  const std::size_t first_matrix = 8 + 4 + std::string("random numbers").size();
  std::string rows = good;
  rows.replace(first_matrix, 4, "\xff\xff\xff\xff");
  EXPECT_NE(errorOfBytes(rows).find("damaged"), std::string::npos);
  std::string weight = good;
  weight.replace(first_matrix + 8, 2, std::string("\x00\x7e", 2));  // not a number
  EXPECT_NE(errorOfBytes(weight).find("damaged"), std::string::npos);
}

TEST(LearnedPosesFile, RefusesABasisOfOtherRows) {
  const TemporaryFolder folder;
  LearnedPoses poses = someLearnedPoses();
  saveLearnedPoses(poses, folder / "good.bin");
  std::string bytes = readBytes(folder / "good.bin");
  // After the head the weight (1 x 1) and the mean (32 x 1), then the basis: as many numbers in half as many rows.
  const std::size_t basis = 8 + 4 + poses.origin.size() + (8 + 2) + (8 + 2 * kShapeDofCount);
  const auto rows = static_cast<std::uint32_t>(kShapeDofCount / 2);
  const auto cols = static_cast<std::uint32_t>(2 * poses.ppca.basis.cols());
  bytes.replace(basis, 4, reinterpret_cast<const char*>(&rows), 4);
  bytes.replace(basis + 4, 4, reinterpret_cast<const char*>(&cols), 4);
  writeBytes(folder / "bad.bin", bytes);
  EXPECT_NE(
      errorOf([&] { loadLearnedPoses(folder / "bad.bin"); }).find("bad.bin: the file of learned poses is damaged"),
      std::string::npos);
}

}  // namespace
}  // namespace depthmocap
