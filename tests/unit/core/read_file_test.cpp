#include "libtracker/core/read_file.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

TEST(ReadFile, ReadsTheWholeFileAndNoMore) {
  const TemporaryFolder folder;
  const std::string bytes(100, 'x');
  writeBytes(folder / "f", bytes);
  EXPECT_EQ(readFile(folder / "f", "the list", 100), bytes);
  const std::string message = errorOf([&] { readFile(folder / "f", "the list", 99); });
  EXPECT_NE(message.find("/f: cannot read the list: it is larger than any such file, 99 bytes"), std::string::npos);
  writeBytes(folder / "f", "");
  EXPECT_EQ(readFile(folder / "f", "the list", 99), "");
}

// Its size is said to be 0, as of pipes; it never ends.
TEST(ReadFile, RefusesADeviceThatNeverEnds) {
  EXPECT_NE(errorOf([] { readFile("/dev/zero", "the list", mebibytes(3)); }).find("larger"), std::string::npos);
  EXPECT_NE(errorOf([] { readFile("/dev/zero", "the list", mebibytes(512)); }).find("it is no file"),
            std::string::npos);
}

TEST(ReadFile, SaysWhyItCannot) {
  const TemporaryFolder folder;
  EXPECT_NE(errorOf([&] { readFile(folder / "none", "the list", 9); }).find("No such file"), std::string::npos);
  EXPECT_NE(errorOf([&] { readFile(folder.path(), "the list", 9); }).find("folder"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap
