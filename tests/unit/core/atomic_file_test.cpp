#include "libtracker/core/atomic_file.h"

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

std::ptrdiff_t filesIn(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "a.txt");
  file.write("first ");
  file.write("second");
  EXPECT_FALSE(fs::exists(folder / "a.txt"));
  file.commit();
  EXPECT_EQ(readBytes(folder / "a.txt"), "first second");
  EXPECT_EQ(filesIn(folder.path()), 1);
}

TEST(AtomicFile, LeavesTheOldFileWhenItIsNotCommitted) {
  const TemporaryFolder folder;
  writeBytes(folder / "a.txt", "old");
  {
    AtomicFile file(folder / "a.txt");
    file.write("half of the n");
  }
  EXPECT_EQ(readBytes(folder / "a.txt"), "old");
  EXPECT_EQ(filesIn(folder.path()), 1);
}

TEST(AtomicFile, IsNotStoppedByATemporaryFileThatAKilledProcessLeft) {
  const TemporaryFolder folder;
  writeBytes(folder / "a.txt.tmp0", "left behind");
  writeFileAtomically(folder / "a.txt", "new");
  EXPECT_EQ(readBytes(folder / "a.txt"), "new");
  EXPECT_EQ(readBytes(folder / "a.txt.tmp0"), "left behind");
}

TEST(AtomicFile, WritesThroughASymbolicLink) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "elsewhere");
  writeBytes(folder / "elsewhere/real.txt", "old");
  fs::create_symlink(folder / "elsewhere/real.txt", folder / "link.txt");
  writeFileAtomically(folder / "link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(readBytes(folder / "elsewhere/real.txt"), "new");
}

TEST(AtomicFile, NamesThePathAndTheReasonWhenTheFolderIsMissing) {
  const TemporaryFolder folder;
  const std::string message = errorOf([&] { writeFileAtomically(folder / "no/such/a.txt", "x"); });
  EXPECT_NE(message.find("no/such/a.txt"), std::string::npos) << message;
  EXPECT_NE(message.find("create its folder"), std::string::npos) << message;
}

TEST(AtomicFile, RefusesAFolder) {
  const TemporaryFolder folder;
  EXPECT_THROW(writeFileAtomically(folder.path(), "x"), Error);
}

TEST(AtomicFile, ReportsAFullDiskAndKeepsTheDevice) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  const std::string message = errorOf([] { writeFileAtomically("/dev/full", "x"); });
  EXPECT_NE(message.find("No space left"), std::string::npos) << message;
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

}  // namespace
}  // namespace depthmocap
