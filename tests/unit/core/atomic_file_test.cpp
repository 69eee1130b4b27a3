#include "libtracker/core/atomic_file.h"

#include <array>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

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

TEST(AtomicFile, WritesToAFifoAndKeepsIt) {
  const TemporaryFolder folder;
  const fs::path fifo = folder / "fifo";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  std::string read;
  std::thread reader([&] { read = readBytes(fifo); });
  writeFileAtomically(fifo, "through the pipe");
  reader.join();
  EXPECT_EQ(read, "through the pipe");
  EXPECT_TRUE(fs::is_fifo(fifo));
  EXPECT_EQ(filesIn(folder.path()), 1);
}

// /dev/stdout is a link to one of these: a new file of the same name would not be what the process has open.
TEST(AtomicFile, WritesToAnOpenFileOfTheProcess) {
  const TemporaryFolder folder;
  const fs::path path = folder / "open.txt";
  const int file = open(path.c_str(), O_RDWR | O_CREAT, 0600);
  ASSERT_GE(file, 0);
  fs::create_symlink("/proc/self/fd/" + std::to_string(file), folder / "link");
  writeFileAtomically(folder / "link", "in place");
  std::array<char, 16> bytes{};
  EXPECT_EQ(pread(file, bytes.data(), bytes.size(), 0), 8);
  EXPECT_STREQ(bytes.data(), "in place");
  close(file);
}

TEST(AtomicFile, LeavesAFileThatMayNotBeWritten) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anything";
  const TemporaryFolder folder;
  writeBytes(folder / "a.txt", "old");
  fs::permissions(folder / "a.txt", fs::perms::owner_read);
  EXPECT_NE(errorOf([&] { writeFileAtomically(folder / "a.txt", "new"); }).find("may write to"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap
