#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "libtracker/recording/recording.h"

namespace depthmocap {

// One row of a recording's index.
struct IndexEntry {
  std::int64_t frame = 0;
  double time_s = 0;
  std::filesystem::path file;  // 16-bit PNG
};

// A recording whose index is known: reads the depth pictures that the index names.
class ImageListReader : public RecordingReader {
 public:
  ImageListReader(RecordingInfo info, std::vector<IndexEntry> index);
  [[nodiscard]] const RecordingInfo& info() const override { return info_; }
  [[nodiscard]] std::size_t frameCount() const override { return index_.size(); }
  void read(std::size_t i, DepthFrame& frame) override;
  [[nodiscard]] std::int64_t frameNumber(std::size_t i) const override { return index_[i].frame; }
  [[nodiscard]] double time(std::size_t i) const override { return index_[i].time_s; }
  void believe(const CameraModel& camera, double depth_unit_m) override;
  [[nodiscard]] std::vector<std::filesystem::path> files() const override;

 private:
  void takeDistortionOut();

  RecordingInfo info_;
  std::vector<IndexEntry> index_;
  std::vector<std::int32_t> undistortion_;  // empty: the camera has none
  Image<std::uint16_t> raw_;
};

// Throws Error as openRecording does.
std::unique_ptr<RecordingReader> openRecordingFolder(const std::filesystem::path& folder);

// `folder`/`name` for a name found in an index; Error unless it is a relative path that stays inside the folder.
std::filesystem::path pathInside(const std::filesystem::path& folder, std::string_view name, const std::string& where);

}  // namespace depthmocap
