#include "libtracker/posedb/pose_database.h"

#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "depthmocap/error.h"
#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

class PoseDatabaseFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("pose_database_test_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static PoseDatabase sample(std::size_t poses) {
    PoseDatabase database;
    database.origin = "two motions, made by a test";
    Random random(3);
    database.poses.resize(poses);
    for (auto& pose : database.poses) {
      for (int i = 0; i < kDofCount; ++i) pose[i] = static_cast<float>(random.normal());
    }
    const auto half = static_cast<std::uint32_t>(poses / 2);
    database.sources = {{"walk", 0, half}, {"run", half, static_cast<std::uint32_t>(poses) - half}};
    return database;
  }

  [[nodiscard]] fs::path file(const std::string& name = "poses.db") const { return folder_ / name; }

  static std::string bytesOf(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  fs::path write(const std::string& bytes) const {
    std::ofstream(file("damaged.db"), std::ios::binary) << bytes;
    return file("damaged.db");
  }

  // The message of the Error that loading gives; empty if it loads.
  static std::string errorOf(const fs::path& path) {
    try {
      loadPoseDatabase(path);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }

  fs::path folder_;
};

TEST_F(PoseDatabaseFile, KeepsEverything) {
  const PoseDatabase saved = sample(11);
  savePoseDatabase(saved, file());
  const PoseDatabase loaded = loadPoseDatabase(file());
  EXPECT_EQ(loaded.origin, saved.origin);
  ASSERT_EQ(loaded.size(), saved.size());
  for (std::size_t i = 0; i < saved.size(); ++i) EXPECT_EQ(loaded.poses[i], saved.poses[i]);
  ASSERT_EQ(loaded.sources.size(), 2U);
  EXPECT_EQ(loaded.sources[1].name, "run");
  EXPECT_EQ(loaded.sources[1].first, 5U);
  EXPECT_EQ(loaded.sources[1].count, 6U);
  savePoseDatabase(loaded, file("again.db"));
  EXPECT_EQ(bytesOf(file()), bytesOf(file("again.db")));
}

TEST_F(PoseDatabaseFile, AnEmptyOneIsValid) {
  savePoseDatabase({}, file());
  EXPECT_EQ(loadPoseDatabase(file()).size(), 0U);
}

TEST_F(PoseDatabaseFile, EveryTruncationIsAnError) {
  savePoseDatabase(sample(1), file());
  const std::string bytes = bytesOf(file());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_NE(errorOf(write(bytes.substr(0, size))), "") << "cut to " << size << " bytes";
  }
  EXPECT_NE(errorOf(write(bytes + '\0')), "");
}

TEST_F(PoseDatabaseFile, EveryFlippedByteIsAnError) {
  savePoseDatabase(sample(1), file());
  const std::string bytes = bytesOf(file());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x41);
    EXPECT_NE(errorOf(write(damaged)), "") << "byte " << i;
  }
}

TEST_F(PoseDatabaseFile, HugeCountsDoNotAllocate) {
  savePoseDatabase(sample(1), file());
  const std::string bytes = bytesOf(file());
  for (const std::size_t offset : {std::size_t{16}, std::size_t{24}, std::size_t{28}}) {
    std::string damaged = bytes;
    const std::uint32_t huge = std::numeric_limits<std::uint32_t>::max();
    std::memcpy(damaged.data() + offset, &huge, sizeof(huge));
    EXPECT_NE(errorOf(write(damaged)).find("truncated"), std::string::npos) << offset;
  }
}

TEST_F(PoseDatabaseFile, ErrorsSayWhatAndWhere) {
  EXPECT_NE(errorOf(file("missing.db")).find("missing.db"), std::string::npos);
  EXPECT_NE(errorOf(folder_).find("cannot read"), std::string::npos);
  EXPECT_NE(errorOf(write("HIERARCHY\nROOT Hips\n{ and so on, this is text }\n")).find("not a pose database"),
            std::string::npos);
  savePoseDatabase(sample(2), file());
  std::string newer = bytesOf(file());
  newer[8] = 2;
  EXPECT_NE(errorOf(write(newer)).find("version 2"), std::string::npos);
  EXPECT_THROW(savePoseDatabase({}, folder_ / "no_such_folder" / "x.db"), Error);
}

TEST_F(PoseDatabaseFile, APoseThatIsNoNumberIsAnError) {
  PoseDatabase database = sample(2);
  database.poses[1][7] = std::numeric_limits<float>::quiet_NaN();
  savePoseDatabase(database, file());
  EXPECT_NE(errorOf(file()).find("no number"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap
