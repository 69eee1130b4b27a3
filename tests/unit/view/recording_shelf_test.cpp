#include "apps/view/recording_shelf.h"

#include <gtest/gtest.h>

#include "apps/view/export_folder.h"
#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

class Shelf : public testing::Test {
 protected:
  Shelf() {
    fs::create_directories(folder_ / "share/recordings");
    setenv("DEPTHMOCAP_SHARE", (folder_ / "share").c_str(), 1);
  }
  ~Shelf() override { unsetenv("DEPTHMOCAP_SHARE"); }
  TemporaryFolder folder_;
};

TEST_F(Shelf, ListsWhatIsInEachPlace) {
  makeRecording(folder_ / "mine/take-001", smallCamera(), 4);
  makeRecording(folder_ / "share/recordings/walk", smallCamera(), 3);
  makeRecording(folder_ / "elsewhere/given", smallCamera(16, 12), 5);
  fs::create_directories(folder_ / "mine/no recording");
  writeBytes(folder_ / "mine/notes.txt", "x");
  RecordingShelf shelf(folder_ / "mine", NamedRecording{folder_ / "elsewhere/given/", {}});
  const auto all = shelf.list();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].id, "command/given");
  EXPECT_EQ(all[0].width, 16);
  EXPECT_EQ(all[1].id, "folder/take-001");
  EXPECT_EQ(all[1].frames, 4U);
  EXPECT_NEAR(all[1].duration_s, 0.1, 1e-3);
  EXPECT_GT(all[1].bytes, 100U);
  EXPECT_GT(all[1].modified_s, 1'700'000'000);
  EXPECT_EQ(all[2].id, "bundled/walk");
}

TEST_F(Shelf, FindsOnlyWhatItLists) {
  makeRecording(folder_ / "mine/take-001", smallCamera(), 2);
  makeRecording(folder_ / "other/secret", smallCamera(), 2);
  fs::create_directory_symlink(folder_ / "other/secret", folder_ / "mine/link");
  RecordingShelf shelf(folder_ / "mine");
  EXPECT_TRUE(shelf.find("folder/take-001"));
  for (const char* id : {"", "take-001", "folder/", "folder/link", "folder/../other/secret", "folder/../mine/take-001",
                         "/etc", "command/take-001", "bundled/walk", "folder/take-001/", "folder/take-001\n"}) {
    EXPECT_FALSE(shelf.find(id)) << id;
  }
}

TEST_F(Shelf, SaysWhatIsWrongWithARecording) {
  makeRecording(folder_ / "mine/take", smallCamera(), 2);
  writeBytes(folder_ / "mine/take/recording.json", "{");
  RecordingShelf shelf(folder_ / "mine");
  ASSERT_EQ(shelf.list().size(), 1U);
  EXPECT_NE(shelf.list()[0].problem, "");
  EXPECT_TRUE(RecordingShelf(folder_ / "missing").list().empty());
}

TEST_F(Shelf, SeesThatARecordingHasGrown) {
  makeRecording(folder_ / "mine/take", smallCamera(), 2);
  RecordingShelf shelf(folder_ / "mine");
  EXPECT_EQ(shelf.list()[0].frames, 2U);
  fs::remove_all(folder_ / "mine/take");
  makeRecording(folder_ / "mine/take", smallCamera(), 6);
  fs::last_write_time(folder_ / "mine/take/frames.csv", fs::file_time_type::clock::now() + std::chrono::seconds(5));
  EXPECT_EQ(shelf.list()[0].frames, 6U);
}

TEST(ExportFolder, GoesWithItsFilesAndHasAPlainName) {
  fs::path path;
  {
    const ExportFolder folder("../a \"b\"\r\nc");
    path = folder.path();
    EXPECT_EQ(folder.name().find_first_not_of("abcdefghijklmnopqrstuvwxyz._-"), std::string::npos) << folder.name();
    EXPECT_NE(folder.name().front(), '.');
    EXPECT_EQ(fs::status(path).permissions() & fs::perms::others_all, fs::perms::none);
    writeBytes(path / (folder.name() + "-2.bvh"), "xx");
    writeBytes(path / (folder.name() + "-1.bvh"), "x");
    writeBytes(path / (folder.name() + ".joints.csv"), "x");
    const auto files = folder.list({{"joints", "", ".joints.csv"}, {"bvh", "", ".bvh"}, {"mot", "", ".mot"}});
    ASSERT_EQ(files.size(), 3U);
    EXPECT_EQ(files[0].format, "joints");
    EXPECT_EQ(files[1].name, folder.name() + "-1.bvh");
    EXPECT_EQ(files[2].bytes, 2U);
  }
  EXPECT_FALSE(fs::exists(path));
}

}  // namespace
}  // namespace depthmocap
