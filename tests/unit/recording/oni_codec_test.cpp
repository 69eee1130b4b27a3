#include "libtracker/recording/oni_codec.h"

#include <string>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

using Pixels = std::vector<std::uint16_t>;

constexpr std::array<char, 4> kDifferences = {'1', '6', 'z', 'P'};
constexpr std::array<char, 4> kTable = {'1', '6', 'z', 'T'};
constexpr std::array<char, 4> kPlain = {'N', 'O', 'N', 'E'};

std::string bytes(std::initializer_list<int> list) {
  std::string text;
  for (const int value : list) text += static_cast<char>(value);
  return text;
}

// What comes out of `packed`, empty if it is not `count` pixels.
Pixels unpacked(const std::array<char, 4>& codec, const std::string& packed, std::size_t count) {
  Pixels pixels(count);
  return unpackOniPicture(codec, packed, pixels) ? pixels : Pixels{};
}

TEST(OniCodec, ReadsSmallDifferencesTwoAByte) {
  // 1000, then the value before minus: -6, 6, 0, 1
  EXPECT_EQ(unpacked(kDifferences, bytes({0xE8, 0x03, 0x0C, 0x67}), 5), (Pixels{1000, 1006, 1000, 1000, 999}));
}

TEST(OniCodec, ReadsRunsPaddingAndEscapes) {
  EXPECT_EQ(unpacked(kDifferences, bytes({5, 0, 0xE2}), 5), (Pixels{5, 5, 5, 5, 5}));
  EXPECT_EQ(unpacked(kDifferences, bytes({5, 0, 0x7D}), 2), (Pixels{5, 4}));
  EXPECT_EQ(unpacked(kDifferences, bytes({5, 0, 0xFF, 0x12, 0x34}), 2), (Pixels{5, 0x1234}));
  EXPECT_EQ(unpacked(kDifferences, bytes({100, 0, 0xFF, 192 + 63}), 2), (Pixels{100, 37}));
  EXPECT_EQ(unpacked(kDifferences, bytes({100, 0, 0x6F, 192 - 63}), 3), (Pixels{100, 100, 163}));
}

TEST(OniCodec, LooksUpTheTable) {
  // A table of 0, 1500, 2000; then the indices 1, 1, 2, 0.
  EXPECT_EQ(unpacked(kTable, bytes({3, 0, 0, 0, 0xDC, 5, 0xD0, 7, 1, 0, 0x65, 0x8D}), 4),
            (Pixels{1500, 1500, 2000, 0}));
  EXPECT_EQ(unpacked(kTable, bytes({1, 0, 0xDC, 5, 1, 0}), 1), Pixels{}) << "an index beyond the table";
  EXPECT_EQ(unpacked(kTable, bytes({200, 0, 0xDC, 5, 1, 0}), 1), Pixels{}) << "a table that is cut short";
}

TEST(OniCodec, CopiesPlainPictures) {
  EXPECT_EQ(unpacked(kPlain, bytes({1, 2, 3, 4}), 2), (Pixels{0x0201, 0x0403}));
  EXPECT_EQ(unpacked(kPlain, bytes({1, 2, 3}), 2), Pixels{});
}

TEST(OniCodec, RefusesWhatDoesNotFit) {
  EXPECT_EQ(unpacked(kDifferences, "", 2), Pixels{});
  EXPECT_EQ(unpacked(kDifferences, bytes({5, 0}), 2), Pixels{}) << "too few";
  EXPECT_EQ(unpacked(kDifferences, bytes({5, 0, 0xE2}), 4), Pixels{}) << "too many";
  EXPECT_EQ(unpacked(kDifferences, bytes({5, 0, 0xFF}), 2), Pixels{}) << "an escape at the end";
  EXPECT_EQ(unpacked(kDifferences, bytes({5, 0, 0xFF, 0x12}), 2), Pixels{}) << "half a value at the end";
  EXPECT_EQ(unpacked(kDifferences, bytes({5, 0, 0xF3}), 2), Pixels{}) << "no code";
  EXPECT_EQ(unpacked({'J', 'P', 'E', 'G'}, bytes({5, 0, 0x66}), 3), Pixels{});
}

// Whatever the bytes, nothing is read or written beyond them.
TEST(OniCodec, SurvivesAnyBytes) {
  std::uint32_t state = 1;
  for (int round = 0; round < 20000; ++round) {
    std::string packed;
    for (int i = 0; i < 12; ++i) {
      state = state * 1664525U + 1013904223U;
      packed += static_cast<char>(state >> 24U);
    }
    Pixels pixels(9);
    static_cast<void>(unpackOniPicture(round % 2 == 0 ? kDifferences : kTable, packed, pixels));
    EXPECT_EQ(pixels.size(), 9U);
  }
}

}  // namespace
}  // namespace depthmocap
