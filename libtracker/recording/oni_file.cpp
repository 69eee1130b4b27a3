#include "libtracker/recording/oni_file.h"

#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>

#include "depthmocap/error.h"

namespace depthmocap {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are read as they lie in the file");

constexpr std::uint32_t kRecordMagic = 0x0052494E;  // "NIR\0"
constexpr std::uint32_t kIntegerProperty = 0x03;
constexpr std::uint32_t kGeneralProperty = 0x06;
constexpr std::uint32_t kNewData = 0x0A;
constexpr std::uint32_t kEnd = 0x0B;
constexpr std::uint32_t kNodeAdded = 0x0C;
constexpr std::uint32_t kNodeAddedWithSeekTable = 0x0D;
constexpr std::uint32_t kDepthNode = 2;
constexpr std::uint64_t kPixelFormat100um = 101;
constexpr std::uint32_t kLargest = 1U << 26U;  // [bytes] keeps a damaged file from asking for all memory
constexpr std::size_t kDataFields = 12;        // u64 time [us], u32 frame: the end of a data record's fields

// The start of every record. `fields` counts the header itself, which is 24 bytes long in old files, 28 in new ones.
struct RecordHeader {
  std::uint32_t magic = 0;
  std::uint32_t type = 0;
  std::uint32_t node = 0;
  std::uint32_t fields = 0;
  std::uint32_t payload = 0;
};

template <typename T>
T valueAt(std::string_view bytes, std::size_t offset) {
  T value{};
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

class RecordReader {
 public:
  explicit RecordReader(const std::filesystem::path& file) : stream_(file, std::ios::binary) {
    if (!stream_) throw Error(std::string("cannot be read: ") + std::strerror(errno), file.string());
    size_ = std::filesystem::file_size(file);
    std::array<char, 24> header{};
    if (!stream_.read(header.data(), header.size()) || std::memcmp(header.data(), "NI10", 4) != 0) {
      throw Error("is no OpenNI recording", file.string());
    }
    position_ = header.size();
  }
  // False at the end of the file, or of what is whole of it.
  bool next() {
    if (position_ + sizeof record_ > size_) return false;
    stream_.seekg(static_cast<std::streamoff>(position_));
    stream_.read(reinterpret_cast<char*>(&record_), sizeof record_);
    const std::uint64_t end = position_ + std::uint64_t{record_.fields} + record_.payload;
    if (!stream_ || record_.magic != kRecordMagic || record_.fields < sizeof record_ || record_.fields > kLargest ||
        record_.payload > kLargest || end > size_) {
      return false;
    }
    fields_.resize(record_.fields - sizeof record_);
    stream_.read(fields_.data(), static_cast<std::streamsize>(fields_.size()));
    payload_position_ = position_ + record_.fields;
    position_ = end;
    return static_cast<bool>(stream_);
  }
  [[nodiscard]] const RecordHeader& record() const { return record_; }
  // What follows the header's common part: 4 or 8 bytes of an undo position, then what the type says.
  [[nodiscard]] std::string_view fields() const { return fields_; }
  [[nodiscard]] std::uint64_t payloadPosition() const { return payload_position_; }

 private:
  std::ifstream stream_;
  std::uint64_t size_ = 0;
  std::uint64_t position_ = 0;
  std::uint64_t payload_position_ = 0;
  RecordHeader record_;
  std::string fields_;
};

struct NamedFields {
  std::string_view name;
  std::string_view rest;
};

// Fields that begin with a name: u32 length with its end zero, text. The length tells which header it is.
std::optional<NamedFields> namedFields(std::string_view fields) {
  for (const std::size_t start : {std::size_t{8}, std::size_t{4}}) {
    if (fields.size() < start + 4) continue;
    const std::size_t length = valueAt<std::uint32_t>(fields, start);
    const std::size_t end = start + 4 + length;
    if (length == 0 || length > fields.size() || end > fields.size() || fields[end - 1] != '\0') continue;
    return NamedFields{fields.substr(start + 4, length - 1), fields.substr(end)};
  }
  return std::nullopt;
}

bool usableAngle(double rad) {
  return std::isfinite(rad) && rad > 0.05 && rad < 3.0;
}

class DepthCollector {
 public:
  void take(const RecordReader& reader) {
    const RecordHeader& record = reader.record();
    if (record.type == kNodeAdded || record.type == kNodeAddedWithSeekTable) addNode(record, reader.fields());
    if (!node_ || record.node != *node_) return;
    if (record.type == kIntegerProperty) setInteger(reader.fields());
    if (record.type == kGeneralProperty) setGeneral(reader.fields());
    if (record.type == kNewData) addPicture(reader);
  }
  OniDepth depth;

 private:
  void addNode(const RecordHeader& record, std::string_view fields) {
    const auto named = namedFields(fields);
    if (node_ || !named || named->rest.size() < 8 || valueAt<std::uint32_t>(named->rest, 0) != kDepthNode) return;
    node_ = record.node;
    depth.codec = valueAt<std::array<char, 4>>(named->rest, 4);
  }
  // u32 size, then the value.
  void setInteger(std::string_view fields) {
    const auto named = namedFields(fields);
    if (!named || named->rest.size() < 12) return;
    const auto value = valueAt<std::uint64_t>(named->rest, 4);
    if (named->name == "xnMirror") depth.mirrored = value != 0;
    if (named->name == "oniPixelFormat") depth.depth_unit_m = value == kPixelFormat100um ? 0.0001 : 0.001;
  }
  void setGeneral(std::string_view fields) {
    const auto named = namedFields(fields);
    if (!named) return;
    const std::string_view rest = named->rest;
    if (named->name == "xnMapOutputMode" && rest.size() >= 16) {
      depth.width = valueAt<int>(rest, 4);
      depth.height = valueAt<int>(rest, 8);
      depth.fps = valueAt<std::uint32_t>(rest, 12);
    }
    if (named->name == "xnFOV" && rest.size() >= 20) {
      depth.fov_x = valueAt<double>(rest, 4);
      depth.fov_y = valueAt<double>(rest, 12);
      if (!usableAngle(depth.fov_x) || !usableAngle(depth.fov_y)) depth.fov_x = depth.fov_y = 0;
    }
  }
  void addPicture(const RecordReader& reader) {
    const std::string_view fields = reader.fields();
    if (fields.size() < kDataFields) return;
    OniPicture picture;
    const std::size_t start = fields.size() - kDataFields;
    picture.time_s = static_cast<double>(valueAt<std::uint64_t>(fields, start)) * 1e-6;
    picture.frame = valueAt<std::uint32_t>(fields, start + 8);
    picture.offset = reader.payloadPosition();
    picture.size = reader.record().payload;
    depth.pictures.push_back(picture);
  }

  std::optional<std::uint32_t> node_;  // of the first depth stream
};

}  // namespace

OniDepth readOniFile(const std::filesystem::path& file) {
  RecordReader reader(file);
  DepthCollector collector;
  while (reader.next() && reader.record().type != kEnd) collector.take(reader);
  if (collector.depth.pictures.empty()) throw Error("the recording has no depth picture", file.string());
  return std::move(collector.depth);
}

}  // namespace depthmocap
