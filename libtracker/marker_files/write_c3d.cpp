#include <algorithm>
#include <bit>
#include <initializer_list>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/marker_files/marker_files.h"

// Intel byte order, floating point, millimetres; layout as in read_c3d.cpp.
namespace depthmocap {
namespace {

constexpr std::size_t kBlock = 512;            // [bytes]
constexpr std::size_t kMostLabels = 255;       // of one value: its dimensions are bytes
constexpr std::size_t kMostPoints = 65535;     // a word counts them
constexpr std::size_t kLongestLabel = 255;     // likewise
constexpr std::size_t kLastWordFrame = 65535;  // what a word can count to

class Bytes {
 public:
  void byte(int value) { text_.push_back(static_cast<char>(value)); }
  void word(std::size_t value) {
    byte(static_cast<int>(value & 0xFFU));
    byte(static_cast<int>(value >> 8U & 0xFFU));
  }
  void number(double value) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    word(bits & 0xFFFFU);
    word(bits >> 16U);
  }
  void text(std::string_view value) { text_ += value; }
  void padTo(std::size_t size) { text_.resize(size, '\0'); }
  [[nodiscard]] const std::string& bytes() const { return text_; }

 private:
  std::string text_;
};

enum Group : int { kPoint = 1, kAnalog = 2, kTrial = 3 };

void group(Bytes& out, int id, std::string_view name) {
  out.byte(static_cast<int>(name.size()));
  out.byte(-id);
  out.text(name);
  out.word(3);  // to the next record, behind the empty description
  out.byte(0);
}

void value(Bytes& out, int group_id, std::string_view name, int type, std::initializer_list<std::size_t> dimensions,
           const Bytes& data) {
  out.byte(static_cast<int>(name.size()));
  out.byte(group_id);
  out.text(name);
  out.word(2 + 2 + dimensions.size() + data.bytes().size() + 1);
  out.byte(type);
  out.byte(static_cast<int>(dimensions.size()));
  for (const std::size_t dimension : dimensions) out.byte(static_cast<int>(dimension));
  out.text(data.bytes());
  out.byte(0);
}

void wordValue(Bytes& out, int group_id, std::string_view name, std::size_t number) {
  Bytes data;
  data.word(number);
  value(out, group_id, name, 2, {}, data);
}

void longValue(Bytes& out, int group_id, std::string_view name, std::size_t number) {
  Bytes data;
  data.word(number & 0xFFFFU);
  data.word(number >> 16U);
  value(out, group_id, name, 2, {2}, data);
}

void realValue(Bytes& out, int group_id, std::string_view name, double number) {
  Bytes data;
  data.number(number);
  value(out, group_id, name, 4, {}, data);
}

void labelValues(Bytes& out, const MarkerSequence& markers) {
  std::size_t length = 1;
  for (const MarkerTrack& track : markers.tracks) length = std::max(length, track.name.size());
  length = std::min(length, kLongestLabel);
  // A record is at most 64 KiB long, so long labels come in fewer a record.
  const std::size_t most = std::min(kMostLabels, std::size_t{60000} / length);
  std::size_t part = 1;
  for (std::size_t first = 0; first < markers.tracks.size(); first += most, ++part) {
    const std::size_t count = std::min(most, markers.tracks.size() - first);
    Bytes data;
    for (std::size_t i = first; i < first + count; ++i) {
      std::string name = markers.tracks[i].name.substr(0, length);
      name.resize(length, ' ');
      data.text(name);
    }
    value(out, kPoint, part == 1 ? "LABELS" : fmt::format("LABELS{}", part), -1, {length, count}, data);
  }
}

Bytes parameterSection(const MarkerSequence& markers, std::size_t first, std::size_t last, std::size_t data_block) {
  Bytes records;
  group(records, kPoint, "POINT");
  group(records, kAnalog, "ANALOG");
  group(records, kTrial, "TRIAL");
  wordValue(records, kPoint, "USED", markers.tracks.size());
  wordValue(records, kPoint, "FRAMES", std::min(markers.frames(), kLastWordFrame));
  realValue(records, kPoint, "SCALE", -1.0);
  realValue(records, kPoint, "RATE", markers.fps);
  wordValue(records, kPoint, "DATA_START", data_block);
  Bytes unit;
  unit.text("mm");
  value(records, kPoint, "UNITS", -1, {2}, unit);
  labelValues(records, markers);
  wordValue(records, kAnalog, "USED", 0);
  realValue(records, kAnalog, "RATE", 0.0);
  longValue(records, kTrial, "ACTUAL_START_FIELD", first);
  longValue(records, kTrial, "ACTUAL_END_FIELD", last);
  Bytes section;
  const std::size_t size = 4 + records.bytes().size() + 2;
  section.byte(1);
  section.byte(0x50);
  section.byte(static_cast<int>((size + kBlock - 1) / kBlock));
  section.byte(84);  // Intel
  section.text(records.bytes());
  section.padTo((size + kBlock - 1) / kBlock * kBlock);
  return section;
}

Bytes header(const MarkerSequence& markers, std::size_t first, std::size_t last, std::size_t data_block) {
  Bytes out;
  out.byte(2);  // the block in which parameters begin
  out.byte(0x50);
  out.word(markers.tracks.size());
  out.word(0);  // analogue samples a frame
  out.word(std::min(first, kLastWordFrame));
  out.word(std::min(last, kLastWordFrame));
  out.word(0);  // longest gap that was filled
  out.number(-1.0);
  out.word(data_block);
  out.word(0);
  out.number(markers.fps);
  out.padTo(kBlock);
  return out;
}

}  // namespace

void writeC3d(const MarkerSequence& markers, const std::filesystem::path& path) {
  if (markers.tracks.size() > kMostPoints) throw Error("C3D holds at most 65535 points", path.string());
  // Frames count from 1 in C3D.
  const auto first = static_cast<std::size_t>(std::max<std::int64_t>(1, markers.frame.front()));
  const std::size_t last = first + markers.frames() - 1;
  const std::size_t blocks = parameterSection(markers, first, last, 0).bytes().size() / kBlock;
  if (blocks > 255) throw Error("has too many markers for a C3D file", path.string());
  const std::size_t data_block = 2 + blocks;
  AtomicFile file(path);
  file.write(header(markers, first, last, data_block).bytes());
  file.write(parameterSection(markers, first, last, data_block).bytes());
  std::size_t data_bytes = 0;
  for (std::size_t t = 0; t < markers.frames(); ++t) {
    Bytes row;
    const auto column = static_cast<Eigen::Index>(t);
    for (const MarkerTrack& track : markers.tracks) {
      const bool seen = track.seen[column];
      for (int axis = 0; axis < 3; ++axis) row.number(seen ? 1000.0 * track.p(axis, column) : 0.0);
      row.number(seen ? 0.0 : -1.0);
    }
    file.write(row.bytes());
    data_bytes += row.bytes().size();
  }
  file.write(std::string((kBlock - data_bytes % kBlock) % kBlock, '\0'));
  file.commit();
}

}  // namespace depthmocap
