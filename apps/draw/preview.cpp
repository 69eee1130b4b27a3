#include "apps/draw/preview.h"

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/draw/painter.h"
#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"

namespace depthmocap {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSheetPictures = 12;
constexpr int kSheetColumns = 3;
constexpr int kSheetGap = 6;  // [px]
const cv::Scalar kSheetGapColor(90, 82, 76);

// Beside the target, so that the rename stays on one file system; the ending tells OpenCV the container.
fs::path temporaryBeside(const fs::path& path) {
  return path.parent_path() / fmt::format(".{}.part.mp4", path.filename().string());
}

void openVideo(const fs::path& path, double fps, cv::VideoWriter& video) {
  const cv::Size size(kPreviewWidth, kPreviewHeight);
  for (const char* codec : {"avc1", "mp4v"}) {
    const int fourcc = cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]);
    if (video.open(path.string(), cv::CAP_FFMPEG, fourcc, fps, size)) return;
  }
}

}  // namespace

struct PreviewWriter::Impl {
  fs::path path;
  fs::path temporary;
  PreviewPainter painter;
  cv::VideoWriter video;
  std::size_t frames = 0;

  void discard() {
    std::error_code ignored;
    video.release();
    fs::remove(temporary, ignored);
  }
};

PreviewWriter::PreviewWriter(const fs::path& path, const CameraModel& camera, double fps)
    : impl_(new Impl{path, temporaryBeside(path), PreviewPainter(camera), {}, 0}) {
  std::error_code ignored;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored))
    throw Error("its folder does not exist", path.string(), "make the folder first");
  if (fs::is_directory(path, ignored)) throw Error("is a folder", path.string(), "name a file");
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // failures are ours to report
  openVideo(impl_->temporary, fps, impl_->video);
  if (!impl_->video.isOpened()) {
    impl_->discard();
    throw Error("cannot write an MP4 film", path.string(), "is the folder writable, and was OpenCV built with FFmpeg?");
  }
}

PreviewWriter::PreviewWriter(PreviewWriter&&) noexcept = default;

PreviewWriter::~PreviewWriter() {
  if (!impl_ || !impl_->video.isOpened()) return;
  try {
    if (impl_->frames > 0) finish();
  } catch (const Error&) {  // a destructor cannot report; the temporary file goes away below
  }
  impl_->discard();
}

void PreviewWriter::write(const PreviewFrame& frame) {
  impl_->video.write(impl_->painter.draw(frame));
  ++impl_->frames;
}

void PreviewWriter::finish() {
  impl_->video.release();
  std::error_code failure;
  if (fs::file_size(impl_->temporary, failure) == 0 || failure) {
    impl_->discard();
    throw Error("the film could not be written", impl_->path.string(), "is the disk full?");
  }
  fs::rename(impl_->temporary, impl_->path, failure);
  if (!failure) return;
  impl_->discard();
  throw Error("cannot move the film into place: " + failure.message(), impl_->path.string());
}

// Keeps every stride-th picture; when too many have gathered, every second goes and the stride doubles.
struct ContactSheet::Impl {
  fs::path path;
  PreviewPainter painter;
  std::vector<cv::Mat> pictures;
  std::size_t stride = 1;
  std::size_t added = 0;
  bool done = false;

  void thinOut() {
    for (std::size_t k = 0; 2 * k < pictures.size(); ++k) std::swap(pictures[k], pictures[2 * k]);
    pictures.resize((pictures.size() + 1) / 2);
    stride *= 2;
  }
  [[nodiscard]] cv::Mat compose() const;
};

ContactSheet::ContactSheet(const fs::path& path, const CameraModel& camera)
    : impl_(new Impl{path, PreviewPainter(camera), {}}) {}
ContactSheet::ContactSheet(ContactSheet&&) noexcept = default;

ContactSheet::~ContactSheet() {
  if (!impl_ || impl_->done || impl_->added == 0) return;
  try {
    finish();
  } catch (const Error&) {  // a destructor cannot report
  }
}

void ContactSheet::add(const PreviewFrame& frame) {
  if (impl_->added++ % impl_->stride != 0) return;
  if (impl_->pictures.size() == 2 * kSheetPictures) {
    impl_->thinOut();
    if ((impl_->added - 1) % impl_->stride != 0) return;
  }
  cv::Mat small;
  cv::resize(impl_->painter.draw(frame), small, {}, 0.5, 0.5, cv::INTER_AREA);
  impl_->pictures.push_back(small);
}

cv::Mat ContactSheet::Impl::compose() const {
  const std::size_t shown = std::min(kSheetPictures, pictures.size());
  const int rows = (static_cast<int>(shown) + kSheetColumns - 1) / kSheetColumns;
  const int columns = std::min(kSheetColumns, static_cast<int>(shown));
  const cv::Size cell = pictures.front().size();
  const cv::Size step(cell.width + kSheetGap, cell.height + kSheetGap);
  cv::Mat sheet(rows * step.height - kSheetGap, columns * step.width - kSheetGap, CV_8UC3, kSheetGapColor);
  for (std::size_t k = 0; k < shown; ++k) {
    const std::size_t which = shown == 1 ? 0 : k * (pictures.size() - 1) / (shown - 1);
    const int n = static_cast<int>(k);
    const cv::Point corner(n % kSheetColumns * step.width, n / kSheetColumns * step.height);
    pictures[which].copyTo(sheet(cv::Rect(corner, cell)));
  }
  return sheet;
}

void ContactSheet::finish() {
  impl_->done = true;
  if (impl_->pictures.empty()) throw Error("no frame to show", impl_->path.string());
  std::vector<std::uint8_t> png;
  cv::imencode(".png", impl_->compose(), png);
  writeFileAtomically(impl_->path, {reinterpret_cast<const char*>(png.data()), png.size()});
}

}  // namespace depthmocap
