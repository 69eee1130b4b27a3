#include "libtracker/classify/room_network.h"

#include <fstream>
#include <functional>
#include <sstream>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/classify/room_classifier.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

const std::string kShipped = std::string(DEPTHMOCAP_SOURCE_DIR) + "/forest/models/rooms.network";

std::string bytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  return std::move(content).str();
}

void expectRefused(const std::string& bytes, const std::string& word) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "damaged.network";
  std::ofstream(path, std::ios::binary) << bytes;
  try {
    loadRoomNetwork(path);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("damaged.network"), std::string::npos) << error.what();
  }
}

TEST(RoomNetwork, DamagedFilesAreRefused) {
  const std::string good = bytesOf(kShipped);
  ASSERT_GT(good.size(), 1000U);
  const auto with = [&](std::size_t at, char value) {
    std::string bytes = good;
    bytes[at] = value;
    return bytes;
  };
  expectRefused("", "cut short");
  expectRefused(good.substr(0, good.size() - 1), "cut short");
  expectRefused(good + "x", "damaged");
  expectRefused(with(0, 'X'), "damaged");    // magic
  expectRefused(with(4, 9), "damaged");      // version
  expectRefused(with(8, 3), "damaged");      // number of layers
  expectRefused(with(12, 5), "damaged");     // inputs of the first
  expectRefused(with(20, 4), "damaged");     // an even kernel
  expectRefused(with(35, 0x7F), "damaged");  // a weight that is no number
}

TEST(RoomNetwork, MissingFileIsAnError) {
  EXPECT_THROW(loadRoomNetwork("no/such.network"), Error);
}

// Sizes, borders and threads; whether people are found is for tests/unit/tracker and scripts/measure-rooms.
TEST(RoomClassifier, AnswersForEverySizeAndNumberOfThreads) {
  const RoomClassifier classifier(loadRoomNetwork(kShipped));
  for (const auto& [width, height] : {std::pair{640, 480}, {512, 424}, {480, 640}, {211, 157}, {1280, 720}, {40, 30}}) {
    CameraModel camera{width, height, 0.9 * width, 0.9 * width, 0.5 * (width - 1), 0.5 * (height - 1)};
    DepthImage depth(width, height, 3.0F);
    for (int y = 0; y < height / 2; ++y) depth.at(y % width, y) = 0;
    RoomClassifier::Memory memory;
    RoomMap map;
    classifier.classify(depth, camera, 0.4, 6.0, 1, memory, map);
    EXPECT_LE((map.width - 1) * map.stride + map.offset, width - 1);
    EXPECT_GE(map.width * map.stride + map.offset, width - 1);
    EXPECT_GE(map.height * map.stride + map.offset, height - 1);
    RoomMap other;
    RoomClassifier::Memory fresh;
    classifier.classify(depth, camera, 0.4, 6.0, 3, fresh, other);
    EXPECT_EQ(map.person, other.person);
    EXPECT_EQ(map.shell, other.shell);
    classifier.classify(depth, camera, 0.4, 6.0, 2, memory, other);  // memory that was used before
    EXPECT_EQ(map.person, other.person);
  }
}

TEST(RoomClassifier, WhatIsNotMeasuredSaysNothing) {
  const RoomClassifier classifier(loadRoomNetwork(kShipped));
  CameraModel camera{320, 240, 260, 260, 159.5, 119.5};
  DepthImage depth(320, 240, 9.0F);  // too far
  RoomClassifier::Memory memory;
  RoomMap map;
  classifier.classify(depth, camera, 0.4, 6.0, 1, memory, map);
  for (std::size_t i = 0; i < map.person.size(); ++i) {
    EXPECT_EQ(map.measured[i], 0);
    EXPECT_EQ(map.person[i], 0.0F);
  }
}

}  // namespace
}  // namespace depthmocap
