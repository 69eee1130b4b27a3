#include "libtracker/core/byte_reader.h"

#include <gtest/gtest.h>

#include "libtracker/core/atomic_file.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

TEST(ByteReader, TakesBytesFromTheFront) {
  const TemporaryFolder folder;
  writeFileAtomically(folder / "f", std::string("\x03\0\0\0abc", 7));
  ByteReader reader(folder / "f", "the list");
  std::string text(reader.count(3), ' ');
  reader.raw(text.data(), text.size());
  EXPECT_EQ(text, "abc");
  EXPECT_EQ(errorOf([&] { reader.end(); }), "");
}

TEST(ByteReader, SaysWhatIsWrongWithTheFile) {
  const TemporaryFolder folder;
  writeFileAtomically(folder / "f", std::string("\x03\0\0\0abc", 7));
  const auto error = [&](const auto& action) {
    ByteReader reader(folder / "f", "the list");
    return errorOf([&] { action(reader); });
  };
  EXPECT_NE(error([](ByteReader& r) { r.count(2); }).find("the list is damaged"), std::string::npos);
  EXPECT_NE(error([](const ByteReader& r) { r.end(); }).find("the list is damaged"), std::string::npos);
  EXPECT_NE(error([](const ByteReader& r) { r.require(8); }).find("the list is cut short"), std::string::npos);
  EXPECT_NE(errorOf([&] { ByteReader(folder / "none", "the list"); }).find("cannot read the list"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap
