#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/core/random.h"
#include "libtracker/recording/recording.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

template <typename T>
std::string bytesOf(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

std::string named(const std::string& name) {
  return bytesOf(static_cast<std::uint32_t>(name.size() + 1)) + name + '\0';
}

// Writes .oni files record by record, with the headers of OpenNI 2 (28 bytes) or 1 (24).
class OniBuilder {
 public:
  explicit OniBuilder(int header_bytes = 28) : undo_(static_cast<std::size_t>(header_bytes) - 20, '\0') {
    bytes_ = "NI10" + std::string(20, '\0');
  }
  OniBuilder& record(std::uint32_t type, std::uint32_t node, const std::string& fields,
                     const std::string& payload = {}) {
    const auto size = static_cast<std::uint32_t>(20 + undo_.size() + fields.size());
    bytes_ += bytesOf<std::uint32_t>(0x0052494E) + bytesOf(type) + bytesOf(node) + bytesOf(size) +
              bytesOf(static_cast<std::uint32_t>(payload.size())) + undo_ + fields + payload;
    return *this;
  }
  OniBuilder& node(std::uint32_t number, std::uint32_t type, const std::string& codec) {
    return record(0x0C, number, named("Node") + bytesOf(type) + codec + std::string(20, '\0'));
  }
  OniBuilder& integer(const std::string& name, std::uint64_t value) {
    return record(0x03, 1, named(name) + bytesOf<std::uint32_t>(8) + bytesOf(value));
  }
  OniBuilder& general(const std::string& name, const std::string& value) {
    return record(0x06, 1, named(name) + bytesOf(static_cast<std::uint32_t>(value.size())) + value);
  }
  OniBuilder& mode(std::uint32_t width, std::uint32_t height, std::uint32_t fps) {
    return general("xnMapOutputMode", bytesOf(width) + bytesOf(height) + bytesOf(fps));
  }
  OniBuilder& picture(std::uint32_t node_number, std::uint64_t time_us, std::uint32_t frame,
                      const std::vector<std::uint16_t>& pixels) {
    std::string payload;
    for (const std::uint16_t pixel : pixels) payload += bytesOf(pixel);
    return record(0x0A, node_number, bytesOf(time_us) + bytesOf(frame), payload);
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string undo_;
  std::string bytes_;
};

class OniReader : public testing::Test {
 protected:
  std::unique_ptr<RecordingReader> open(const std::string& bytes) {
    writeBytes(folder_ / "a.oni", bytes);
    return openRecording(folder_ / "a.oni");
  }
  std::string openError(const std::string& bytes) {
    return errorOf([&] { open(bytes); });
  }
  TemporaryFolder folder_;
  DepthFrame frame_;
};

TEST_F(OniReader, ReadsFilesOfBothOpenNis) {
  for (const int header : {28, 24}) {
    OniBuilder file(header);
    file.node(1, 2, "NONE").mode(2, 1, 25).general("xnFOV", bytesOf(1.0) + bytesOf(0.8));
    file.picture(1, 5000000, 7, {1000, 2000}).picture(1, 5040000, 9, {3000, 0});
    const auto reader = open(file.bytes());
    ASSERT_EQ(reader->frameCount(), 2U) << header;
    EXPECT_EQ(reader->info().fps, 25);
    EXPECT_NEAR(reader->info().camera.fx, 1 / std::tan(0.5), 1e-9);
    EXPECT_NEAR(reader->info().camera.fy, 0.5 / std::tan(0.4), 1e-9);
    reader->read(1, frame_);
    EXPECT_EQ(frame_.frame, 2) << "numbers count from the first picture, gaps stay";
    EXPECT_NEAR(frame_.time_s, 0.04, 1e-9);
    EXPECT_EQ(frame_.depth.data, (std::vector<float>{3.0F, 0.0F}));
  }
}

TEST_F(OniReader, LeavesOtherStreamsOut) {
  OniBuilder file;
  file.node(3, 3, "JPEG").node(1, 2, "NONE").mode(1, 1, 30).node(4, 2, "NONE");
  file.picture(3, 0, 1, {7, 7, 7}).picture(1, 10, 1, {1500}).picture(4, 20, 1, {9}).picture(1, 30, 2, {1600});
  const auto reader = open(file.bytes());
  ASSERT_EQ(reader->frameCount(), 2U);
  reader->read(1, frame_);
  EXPECT_FLOAT_EQ(frame_.depth.data[0], 1.6F);
}

TEST_F(OniReader, TurnsMirroredPicturesAndKnowsTenthsOfMillimetres) {
  OniBuilder file;
  file.node(1, 2, "NONE").mode(3, 1, 30).integer("xnMirror", 1).integer("oniPixelFormat", 101);
  file.picture(1, 0, 1, {1000, 2000, 3000});
  const auto reader = open(file.bytes());
  EXPECT_EQ(reader->info().depth_unit_m, 0.0001);
  reader->read(0, frame_);
  EXPECT_FLOAT_EQ(frame_.depth.data[0], 0.3F);
  EXPECT_FLOAT_EQ(frame_.depth.data[2], 0.1F);
}

TEST_F(OniReader, MakesNumbersAndTimesGrow) {
  OniBuilder file;
  file.node(1, 2, "NONE").mode(1, 1, 30);
  for (int i = 0; i < 3; ++i) file.picture(1, 100, 5, {1});
  const auto reader = open(file.bytes());
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_EQ(reader->frameNumber(i), static_cast<std::int64_t>(i));
    EXPECT_GT(reader->time(i), reader->time(i - 1));
  }
}

TEST_F(OniReader, ReadsOverADamagedPicture) {
  OniBuilder file;
  file.node(1, 2, "16zT").mode(2, 1, 30);
  file.picture(1, 0, 1, {0xFFFF, 0}).picture(1, 33333, 2, {2, 100, 200, 0, 0x5DE0});
  const auto reader = open(file.bytes());
  EXPECT_NE(errorOf([&] { reader->read(0, frame_); }).find("picture 0 is damaged"), std::string::npos);
  reader->read(1, frame_);
  EXPECT_EQ(frame_.depth.data, (std::vector<float>{0.1F, 0.2F}));
}

TEST_F(OniReader, RefusesFilesWithoutDepthOrSize) {
  EXPECT_NE(openError(OniBuilder().bytes()).find("no depth picture"), std::string::npos);
  EXPECT_NE(openError(OniBuilder().node(1, 2, "NONE").picture(1, 0, 1, {1}).bytes()).find("width and height"),
            std::string::npos);
}

// tests/data/recordings/*.oni come from the OpenNI 2 runtime's own recorder: nothing in the first four columns, then
// (1000 + 100 n + (x y mod 7)) mm. The second was recorded mirrored.
TEST_F(OniReader, ReadsFilesOfTheRuntime) {
  for (const char* name : {"recordings/openni2.oni", "recordings/openni2_mirrored.oni"}) {
    const auto reader = openRecording(testData(name));
    ASSERT_GE(reader->frameCount(), 4U) << name;
    EXPECT_NEAR(reader->info().camera.fx, 16, 1e-4);
    for (std::size_t i = 0; i < reader->frameCount(); ++i) {
      reader->read(i, frame_);
      const int n = static_cast<int>(std::lround((frame_.depth.at(4, 0) - 1.0F) * 10));
      for (int y = 0; y < 12; ++y) {
        for (int x = 0; x < 16; ++x) {
          const int mm = x < 4 ? 0 : 1000 + 100 * n + x * y % 7;
          ASSERT_EQ(frame_.depth.at(x, y), static_cast<float>(mm * 0.001)) << name << ' ' << i << ' ' << x << ' ' << y;
        }
      }
    }
  }
}

TEST_F(OniReader, ReadsOrRefusesAnyFile) {
  const std::string good = readBytes(testData("recordings/openni2.oni"));
  Random random(7);
  int refused = 0;
  for (int round = 0; round < 500; ++round) {
    std::string bytes = good;
    for (std::uint32_t i = random.below(4) + 1; i > 0; --i) {
      const std::size_t at = random.below(static_cast<std::uint32_t>(random.below(2) == 0 ? 1200 : bytes.size()));
      if (random.below(3) == 0) {
        bytes.erase(at, 1 + random.below(20));
      } else {
        bytes[at] = static_cast<char>(random.below(256));
      }
    }
    try {
      const auto reader = open(bytes);
      for (std::size_t i = 0; i < reader->frameCount(); ++i) reader->read(i, frame_);
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_LT(refused, 500);
}

}  // namespace
}  // namespace depthmocap
