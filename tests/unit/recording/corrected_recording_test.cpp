#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/recording/recording.h"
#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

class CorrectedRecording : public ::testing::Test {
 protected:
  CorrectedRecording() {
    info_ = smallCamera(8, 6);
    info_.depth_unit_m = 0.001;
    RecordingWriter writer(path_, info_);
    writer.write(frame_ = patternFrame(info_.camera, 0, info_.fps));
  }
  DepthFrame readWith(const RecordingCorrection& correction) const {
    DepthFrame frame;
    openRecording(path_, correction)->read(0, frame);
    return frame;
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "rec";
  RecordingInfo info_;
  DepthFrame frame_;
};

TEST_F(CorrectedRecording, DepthStepsAreAsLongAsGiven) {
  const DepthFrame as_it_is = readWith({});
  const DepthFrame corrected = readWith({std::nullopt, 0.0002, 0});
  for (std::size_t i = 0; i < as_it_is.depth.data.size(); ++i) {
    EXPECT_NEAR(corrected.depth.data[i], 0.2F * as_it_is.depth.data[i], 1e-6F);
  }
}

TEST_F(CorrectedRecording, CameraIsAsGivenAndItsUnitToo) {
  RecordingInfo given = info_;
  given.camera.fx = 11;
  given.depth_unit_m = 0.002;
  const auto reader = openRecording(path_, {given, std::nullopt, 0});
  EXPECT_EQ(reader->info().camera.fx, 11);
  EXPECT_EQ(reader->info().depth_unit_m, 0.002);
  EXPECT_EQ(openRecording(path_, {given, 0.001, 0})->info().depth_unit_m, 0.001);
  EXPECT_EQ(openRecording(path_, {given, std::nullopt, 90})->info().camera.fy, 11);
}

TEST_F(CorrectedRecording, DistortionThatIsGivenIsTakenOut) {
  RecordingInfo given = info_;
  given.camera.distortion = {0.8, 0, 0, 0, 0};
  EXPECT_NE(readWith({given, std::nullopt, 0}).depth.data, readWith({}).depth.data);
}

TEST_F(CorrectedRecording, CameraOfOtherPicturesIsRefused) {
  RecordingInfo given = smallCamera(16, 12);
  try {
    openRecording(path_, {given, std::nullopt, 0});
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "--camera: describes pictures of 16x12, the recording's are 8x6");
  }
}

}  // namespace
}  // namespace depthmocap
