#include "apps/draw/preview.h"

#include <array>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/draw/painter.h"
#include "apps/draw/png_of.h"
#include "apps/film/film.h"
#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/check.h"
#include "libtracker/core/read_file.h"

namespace depthmocap {

namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".mp4";                   // tells OpenCV the container
constexpr std::size_t kMostPipedBytes = mebibytes(1024);  // of a film for a device or a pipe; that of an hour has less
constexpr std::size_t kSheetPictures = 12;
constexpr int kSheetColumns = 3;
constexpr int kSheetGap = 6;  // [px]
const cv::Scalar kSheetGapColor(90, 82, 76);

// Whether a film is all there: OpenCV does not tell of a full disk. An MP4 file is a row of boxes, each 32 bits of size
// (1: 64 more bits hold it) and 4 characters of name; "moov", which says where the pictures are, is written last.
bool isWholeFilm(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::error_code failure;
  const std::uintmax_t end = fs::file_size(path, failure);
  const auto number = [&file](int bytes) {
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value = value << 8U | static_cast<std::uint8_t>(file.get());
    return value;
  };
  bool has_index = false;
  for (std::uint64_t at = 0; !failure && at != end;) {
    file.seekg(static_cast<std::streamoff>(at));
    std::uint64_t size = number(4);
    std::array<char, 4> name{};
    file.read(name.data(), name.size());
    if (size == 1) size = number(8);
    constexpr std::uint64_t kHead = 8;
    if (!file || size < kHead || size > end - at) return false;
    has_index = has_index || std::string_view(name.data(), name.size()) == "moov";
    at += size;
  }
  return has_index;
}

}  // namespace

struct PreviewWriter::Impl {
  Impl(const fs::path& wanted, const CameraModel& camera) : path(wanted), pending(wanted, kEnding), painter(camera) {
    // OpenCV seeks in the film, so that it cannot be written to a pipe; a whole one can be copied there.
    if (pending.isDirect()) scratch.emplace(fs::temp_directory_path() / "depthmocap-preview", kEnding);
  }
  [[nodiscard]] const fs::path& film() const { return scratch ? scratch->writtenTo() : pending.writtenTo(); }

  fs::path path;
  PendingFile pending;
  std::optional<PendingFile> scratch;
  PreviewPainter painter;
  std::unique_ptr<Film> video;  // null once it is complete
  std::size_t frames = 0;
};

PreviewWriter::PreviewWriter(const fs::path& path, const CameraModel& camera, double fps)
    : impl_(new Impl{path, camera}) {
  impl_->video = openFilm(impl_->film(), fps, kPreviewWidth, kPreviewHeight, path);
}

PreviewWriter::PreviewWriter(PreviewWriter&&) noexcept = default;

PreviewWriter::~PreviewWriter() {
  if (!impl_ || !impl_->video || impl_->frames == 0) return;
  try {
    finish();
  } catch (const Error&) {  // a destructor cannot report
  }
}

void PreviewWriter::write(const PreviewFrame& frame) {
  const cv::Mat picture = impl_->painter.draw(frame);
  DMC_CHECK(picture.isContinuous() && picture.cols == kPreviewWidth && picture.rows == kPreviewHeight);
  impl_->video->write(picture.data);
  ++impl_->frames;
}

void PreviewWriter::finish() {
  impl_->video->close();
  impl_->video.reset();
  if (!isWholeFilm(impl_->film()))
    throw Error("the film could not be written", impl_->path.string(), "is the disk full?");
  if (impl_->scratch) {
    writeFileAtomically(impl_->path, readFile(impl_->film(), "the film", kMostPipedBytes));
  } else {
    impl_->pending.commit();
  }
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
  writeFileAtomically(impl_->path, pngOf(impl_->compose()));
}

}  // namespace depthmocap
