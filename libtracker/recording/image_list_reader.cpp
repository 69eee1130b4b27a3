#include "libtracker/recording/image_list_reader.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"
#include "libtracker/core/csv.h"
#include "libtracker/recording/png_file.h"
#include "libtracker/recording/recording_header.h"
#include "libtracker/recording/undistort.h"

namespace depthmocap {

namespace fs = std::filesystem;

namespace {

constexpr double kLatest_s = 1e11;  // after the year 5000, counted from 1970 as some recordings do

std::vector<IndexEntry> readIndex(const fs::path& folder) {
  const fs::path file = folder / "frames.csv";
  CsvReader csv(file);
  csv.readHeader({"frame", "time_s", "file"});
  std::vector<IndexEntry> index;
  while (csv.next()) {
    IndexEntry entry{csv.integer(0), csv.number(1), pathInside(folder, csv.field(2), file.string())};
    if (entry.frame < 0) csv.fail("the frame number is negative");
    if (!index.empty() && entry.frame <= index.back().frame) csv.fail("frame numbers must grow from row to row");
    if (!index.empty() && entry.time_s <= index.back().time_s) csv.fail("times must grow from row to row");
    index.push_back(std::move(entry));
  }
  if (index.empty()) throw Error("the recording has no frame", file.string());
  return index;
}

}  // namespace

ImageListReader::ImageListReader(RecordingInfo info, std::vector<IndexEntry> index)
    : info_(std::move(info)), index_(std::move(index)) {
  for (const IndexEntry& entry : index_) {
    if (std::abs(entry.time_s) <= kLatest_s) continue;
    throw Error(fmt::format("the time {:g} s lies outside +-{:g} s", entry.time_s, kLatest_s), entry.file.string());
  }
  takeDistortionOut();
}

void ImageListReader::believe(const CameraModel& camera, double depth_unit_m) {
  info_.camera = camera;
  info_.depth_unit_m = depth_unit_m;
  takeDistortionOut();
}

void ImageListReader::takeDistortionOut() {
  undistortion_.clear();
  if (info_.camera.hasDistortion()) undistortion_ = undistortionMap(info_.camera);
}

void ImageListReader::read(std::size_t i, DepthFrame& frame) {
  DMC_CHECK(i < index_.size());
  const IndexEntry& entry = index_[i];
  readPng16(entry.file, info_.camera.width, info_.camera.height, raw_);
  frame.frame = entry.frame;
  frame.time_s = entry.time_s;
  toMetres(raw_, info_.depth_unit_m, undistortion_, frame.depth);
}

std::vector<fs::path> ImageListReader::files() const {
  std::vector<fs::path> files;
  for (const IndexEntry& entry : index_) files.push_back(entry.file);
  return files;
}

fs::path pathInside(const fs::path& folder, std::string_view name, const std::string& where) {
  const fs::path relative(name);
  const bool escapes = std::find(relative.begin(), relative.end(), fs::path("..")) != relative.end();
  if (relative.empty() || relative.is_absolute() || escapes) {
    throw Error("names the file '" + relative.string() + "', which is not inside the recording", where);
  }
  return folder / relative;
}

std::unique_ptr<RecordingReader> openRecordingFolder(const fs::path& folder) {
  RecordingInfo info = readRecordingHeader(folder / "recording.json");
  return std::make_unique<ImageListReader>(std::move(info), readIndex(folder));
}

}  // namespace depthmocap
