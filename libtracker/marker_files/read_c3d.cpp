#include <cmath>

#include <fmt/format.h>

#include "libtracker/marker_files/c3d_bytes.h"
#include "libtracker/marker_files/c3d_parameters.h"
#include "libtracker/marker_files/length_unit.h"
#include "libtracker/marker_files/marker_collector.h"
#include "libtracker/marker_files/marker_files.h"

// C3D, https://www.c3d.org: a header of 512 bytes, parameters, then for each frame its points as four numbers each (x,
// y, z, residual; negative: not seen) and its analogue samples. Numbers are 16-bit integers times a scale, or 32-bit
// floating point where the scale is negative.
namespace depthmocap {
namespace {

constexpr std::size_t kBlock = 512;  // [bytes]

struct Layout {
  std::size_t points = 0;
  std::size_t frames = 0;
  std::size_t first_frame = 1;
  std::size_t data_at = 0;      // [bytes] from the start of the file
  std::size_t frame_bytes = 0;  // [bytes]
  double fps = 0;
  double scale = 0;  // file units a step; negative: floating point
  bool is_real = false;
  double metres_per_unit = 0.001;
};

std::size_t frameCount(const C3dBytes& bytes, const C3dParameters& parameters) {
  // Words cannot count beyond 65535 frames; longer takes have their first and last frame in two words each.
  const auto first = parameters.words("TRIAL:ACTUAL_START_FIELD");
  const auto last = parameters.words("TRIAL:ACTUAL_END_FIELD");
  if (first.size() == 2 && last.size() == 2) {
    const std::size_t from = first[0] + (std::size_t{first[1]} << 16U);
    const std::size_t to = last[0] + (std::size_t{last[1]} << 16U);
    if (to >= from) return to - from + 1;
  }
  if (bytes.word(8) < bytes.word(6)) bytes.fail("says that its last frame comes before its first");
  return std::size_t{bytes.word(8)} - bytes.word(6) + 1;
}

Layout layoutOf(const C3dBytes& bytes, const C3dParameters& parameters, const std::string& where) {
  Layout l;
  l.points = bytes.word(2);
  l.first_frame = bytes.word(6);
  l.frames = frameCount(bytes, parameters);
  l.scale = parameters.number("POINT:SCALE").value_or(bytes.number(12));
  l.is_real = l.scale < 0;
  l.fps = parameters.number("POINT:RATE").value_or(bytes.number(20));
  const auto units = parameters.texts("POINT:UNITS");
  if (!units.empty() && !units.front().empty()) l.metres_per_unit = metresPerUnit(units.front(), where);
  const std::size_t first_block = bytes.word(16);
  if (l.points == 0) bytes.fail("holds no point");
  if (first_block == 0) bytes.fail("does not say where its data begin");
  if (!(l.fps > 0) || !std::isfinite(l.fps)) bytes.fail("has a frame rate that is not above 0");
  if (!std::isfinite(l.scale) || l.scale == 0) bytes.fail("has no scale of its points");
  l.data_at = (first_block - 1) * kBlock;
  l.frame_bytes = (4 * l.points + bytes.word(4)) * (l.is_real ? 4 : 2);
  if (l.data_at > bytes.size() || (bytes.size() - l.data_at) / l.frame_bytes < l.frames) {
    bytes.fail(fmt::format("is cut short: {} frames of {} points do not fit", l.frames, l.points));
  }
  return l;
}

std::vector<std::string> labels(const C3dParameters& parameters, std::size_t points) {
  std::vector<std::string> names = parameters.texts("POINT:LABELS");
  for (int more = 2; names.size() < points; ++more) {
    const auto further = parameters.texts(fmt::format("POINT:LABELS{}", more));
    if (further.empty()) break;
    names.insert(names.end(), further.begin(), further.end());
  }
  names.resize(points);
  for (std::size_t i = 0; i < points; ++i) {
    if (names[i].empty()) names[i] = fmt::format("point{}", i + 1);
  }
  return names;
}

}  // namespace

MarkerSequence readC3d(const std::filesystem::path& path) {
  C3dBytes bytes(path);
  const C3dParameters parameters(bytes);
  const Layout l = layoutOf(bytes, parameters, path.string());
  MarkerCollector collector(path, labels(parameters, l.points));
  const std::size_t size = l.is_real ? 4 : 2;
  const double metres = l.is_real ? l.metres_per_unit : l.scale * l.metres_per_unit;
  for (std::size_t t = 0; t < l.frames; ++t) {
    collector.startFrame(static_cast<std::int64_t>(l.first_frame + t), static_cast<double>(t) / l.fps);
    for (std::size_t m = 0; m < l.points; ++m) {
      const std::size_t at = l.data_at + t * l.frame_bytes + 4 * m * size;
      const auto value = [&](std::size_t i) {
        return l.is_real ? bytes.number(at + i * size) : static_cast<double>(bytes.signedWord(at + i * size));
      };
      if (value(3) < 0) continue;
      collector.add(m, metres * Eigen::Vector3d(value(0), value(1), value(2)));
    }
  }
  return collector.finish(l.fps);
}

}  // namespace depthmocap
