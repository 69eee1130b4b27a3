#include "libtracker/recording/png_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "depthmocap/error.h"
#include "libtracker/core/random.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

template <typename Value>
Image<Value> randomImage(int width, int height) {
  Random random(7);
  Image<Value> image(width, height);
  for (Value& value : image.data) value = static_cast<Value>(random.next());
  return image;
}

TEST(PngFile, GivesBackTheSame16BitPicture) {
  const TemporaryFolder folder;
  const auto image = randomImage<std::uint16_t>(37, 5);
  writePng16(folder / "a.png", image);
  Image<std::uint16_t> read;
  readPng16(folder / "a.png", 37, 5, read);
  EXPECT_EQ(read.data, image.data);
}

TEST(PngFile, GivesBackTheSame8BitPicture) {
  const TemporaryFolder folder;
  const auto image = randomImage<std::uint8_t>(5, 37);
  writePng8(folder / "a.png", image);
  Image<std::uint8_t> read;
  readPng8(folder / "a.png", 5, 37, read);
  EXPECT_EQ(read.data, image.data);
}

TEST(PngFile, RefusesEveryShorterFile) {
  const TemporaryFolder folder;
  writePng16(folder / "a.png", randomImage<std::uint16_t>(9, 7));
  const std::string whole = readBytes(folder / "a.png");
  Image<std::uint16_t> read;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    writeBytes(folder / "short.png", whole.substr(0, size));
    EXPECT_THROW(readPng16(folder / "short.png", 9, 7, read), Error) << size << " of " << whole.size() << " bytes";
  }
}

TEST(PngFile, RefusesEveryFlippedBit) {
  const TemporaryFolder folder;
  const auto image = randomImage<std::uint16_t>(9, 7);
  writePng16(folder / "a.png", image);
  const std::string whole = readBytes(folder / "a.png");
  Image<std::uint16_t> read;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x20);
    writeBytes(folder / "flipped.png", flipped);
    // The bit that says whether a chunk is optional turns IEND into a chunk to skip; then the end is missing.
    EXPECT_THROW(readPng16(folder / "flipped.png", 9, 7, read), Error) << "byte " << at;
  }
}

// libpng would make room for what a chunk of text announces, here 2 GB, before it sees that the file ends.
TEST(PngFile, TakesNoMemoryForAnAnnouncedText) {
  const TemporaryFolder folder;
  const auto image = randomImage<std::uint16_t>(9, 7);
  writePng16(folder / "a.png", image);
  const std::string whole = readBytes(folder / "a.png");
  const std::size_t after_header = 8 + 25;
  writeBytes(folder / "long.png", whole.substr(0, after_header) + "\x7f\xff\xff\xffzTXt" + std::string(100, 'x'));
  rusage before{};
  rusage after{};
  getrusage(RUSAGE_SELF, &before);
  Image<std::uint16_t> read;
  EXPECT_THROW(readPng16(folder / "long.png", 9, 7, read), Error);
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 100'000);  // [KiB]
}

}  // namespace
}  // namespace depthmocap
