#include "libtracker/marker_files/marker_files.h"

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/marker_files/c3d_bytes.h"
#include "libtracker/recording/track_files.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

MarkerSequence someMarkers(std::size_t markers, std::size_t frames) {
  MarkerSequence sequence;
  sequence.fps = 120;
  for (std::size_t t = 0; t < frames; ++t) {
    sequence.frame.push_back(static_cast<std::int64_t>(t + 5));
    sequence.time_s.push_back(static_cast<double>(t) / 120.0);
  }
  std::vector<std::string> names;
  for (std::size_t m = 0; m < markers; ++m) names.push_back("marker" + std::to_string(m));
  sequence.addTracks(names);
  for (std::size_t m = 0; m < markers; ++m) {
    for (std::size_t t = 0; t < frames; ++t) {
      const auto column = static_cast<Eigen::Index>(t);
      sequence.tracks[m].seen[column] = (m + t) % 5 != 0;
      if (sequence.tracks[m].seen[column]) {
        sequence.tracks[m].p.col(column) << 0.1 * static_cast<double>(m + 1), 0.01 * static_cast<double>(t), -1.5;
      }
    }
  }
  return sequence;
}

void expectEqual(const MarkerSequence& a, const MarkerSequence& b) {
  ASSERT_EQ(a.tracks.size(), b.tracks.size());
  ASSERT_EQ(a.frame, b.frame);
  EXPECT_NEAR(a.fps, b.fps, 1e-4);
  for (std::size_t m = 0; m < a.tracks.size(); ++m) {
    EXPECT_EQ(a.tracks[m].name, b.tracks[m].name);
    EXPECT_TRUE((a.tracks[m].seen == b.tracks[m].seen).all()) << a.tracks[m].name;
    EXPECT_LT((a.tracks[m].p - b.tracks[m].p).cwiseAbs().maxCoeff(), 1e-6) << a.tracks[m].name;
  }
}

std::string errorOf(const std::filesystem::path& path) {
  try {
    readMarkers(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(MarkerFiles, TrcAndC3dKeepMarkersAndGaps) {
  const TemporaryFolder folder;
  const MarkerSequence markers = someMarkers(7, 40);
  writeTrc(markers, folder / "a.trc");
  writeC3d(markers, folder / "a.c3d");
  expectEqual(readMarkers(folder / "a.trc"), markers);
  expectEqual(readMarkers(folder / "a.c3d"), markers);
}

TEST(MarkerFiles, C3dHoldsMoreLabelsThanOneValueCan) {
  const TemporaryFolder folder;
  const MarkerSequence markers = someMarkers(600, 3);
  writeC3d(markers, folder / "many.c3d");
  expectEqual(readMarkers(folder / "many.c3d"), markers);
}

TEST(MarkerFiles, C3dHoldsMoreFramesThanAWordCounts) {
  const TemporaryFolder folder;
  const MarkerSequence markers = someMarkers(1, 70000);
  writeC3d(markers, folder / "long.c3d");
  expectEqual(readMarkers(folder / "long.c3d"), markers);
}

TEST(MarkerFiles, JointsFileHasGapsWhereNothingWasObserved) {
  const TemporaryFolder folder;
  JointsRow row;
  row.state = TrackState::Tracking;
  row.p_camera.setConstant(1.5);
  row.confidence.setOnes();
  row.confidence[3] = 0;
  std::string text = jointsHeader() + jointsLine(row);
  row.frame = 1;
  row.time_s = 1.0 / 30.0;
  row.state = TrackState::Lost;
  text += jointsLine(row);
  writeFileAtomically(folder / "j.csv", text);
  const MarkerSequence markers = readMarkers(folder / "j.csv");
  ASSERT_EQ(markers.frames(), 2U);
  for (std::size_t m = 0; m < markers.tracks.size(); ++m) {
    EXPECT_EQ(markers.tracks[m].seen[0], m != 3);
    EXPECT_FALSE(markers.tracks[m].seen[1]);
  }
}

TEST(MarkerFiles, DamageIsAnErrorWithTheFilesName) {
  const TemporaryFolder folder;
  writeC3d(someMarkers(7, 40), folder / "a.c3d");
  const std::string whole = readBytes(folder / "a.c3d");
  for (std::size_t size = 0; size + 600 < whole.size(); size += 97) {
    writeFileAtomically(folder / "cut.c3d", whole.substr(0, size));
    EXPECT_NE(errorOf(folder / "cut.c3d").find("cut.c3d"), std::string::npos) << size;
  }
  writeFileAtomically(folder / "a.trc", "PathFileType\t4\nDataRate\tUnits\n30\tfurlong\n");
  EXPECT_NE(errorOf(folder / "a.trc").find("furlong"), std::string::npos);
  EXPECT_NE(errorOf(folder / "a.txt").find(".c3d"), std::string::npos);
}

TEST(MarkerFiles, EveryByteOfAC3dHeaderMayBeWrong) {
  const TemporaryFolder folder;
  writeC3d(someMarkers(3, 10), folder / "a.c3d");
  const std::string whole = readBytes(folder / "a.c3d");
  for (std::size_t at = 0; at < 900; ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(~damaged[at]);
    writeFileAtomically(folder / "b.c3d", damaged);
    const std::string error = errorOf(folder / "b.c3d");  // read or refused, never a crash
    EXPECT_TRUE(error == "none" || error.find("b.c3d") != std::string::npos) << error;
  }
}

TEST(C3dBytes, NumbersOfThreeProcessors) {
  const TemporaryFolder folder;
  // 1.0 as Intel, DEC and MIPS write it.
  writeFileAtomically(folder / "n", std::string("\x00\x00\x80\x3f\x80\x40\x00\x00\x3f\x80\x00\x00", 12));
  C3dBytes bytes(folder / "n");
  EXPECT_EQ(bytes.number(0), 1.0);
  bytes.processor = C3dBytes::Processor::Dec;
  EXPECT_EQ(bytes.number(4), 1.0);
  bytes.processor = C3dBytes::Processor::Mips;
  EXPECT_EQ(bytes.number(8), 1.0);
  EXPECT_THROW((void)bytes.number(9), Error);
}

}  // namespace
}  // namespace depthmocap
