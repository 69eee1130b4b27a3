// The pose database file, little-endian:
//
//   "DMCPOSES"  u32 version  u32 DoFs (36)  u64 poses  u32 sources  u32 origin bytes  u32 CRC-32 of all that follows
//   origin (UTF-8); of each source u32 name bytes, name (UTF-8), u32 first pose, u32 poses;
//   then the poses, 36 float32 each in the order of the Dof enumeration [m, rad].
//
// The sizes must add up to the size of the file, so that a damaged count is found before anything of that size is made.
#include "libtracker/posedb/pose_database.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>

#include <zlib.h>

#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/check.h"
#include "libtracker/core/read_file.h"

namespace depthmocap {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is copied byte by byte");

constexpr std::string_view kMagic = "DMCPOSES";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderBytes = 8 + 4 + 4 + 8 + 4 + 4 + 4;
constexpr std::size_t kMostBytes = mebibytes(512);  // 3.7 million poses, ten times those of the CMU library
constexpr std::size_t kPoseBytes = kDofCount * sizeof(float);

// The poses lie in memory as they lie in the file.
static_assert(sizeof(PoseDatabase{}.poses[0]) == kPoseBytes);

std::uint32_t checksum(const char* data, std::size_t size) {
  return static_cast<std::uint32_t>(crc32_z(crc32_z(0, nullptr, 0), reinterpret_cast<const Bytef*>(data), size));
}

template <typename T>
void put(std::string& bytes, T value) {
  const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  bytes.append(raw.data(), raw.size());
}

// Takes values off the front of the file's bytes; Error where they end.
class Reader {
 public:
  Reader(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path) {}

  template <typename T>
  T take() {
    T value;
    std::memcpy(&value, text(sizeof(T)).data(), sizeof(T));
    return value;
  }
  std::string_view text(std::size_t size) {
    if (size > bytes_.size()) throw Error("the pose database is truncated", path_, "make or copy it again");
    const std::string_view part = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return part;
  }
  [[nodiscard]] std::string_view rest() const { return bytes_; }

 private:
  std::string_view bytes_;
  const std::string& path_;
};

struct Counts {
  std::uint64_t poses = 0;
  std::uint32_t sources = 0;
  std::uint32_t origin_bytes = 0;
};

Counts readHeader(Reader& reader, const std::string& path) {
  const std::string_view magic = reader.rest().substr(0, kMagic.size());
  if (magic != kMagic) throw Error("this is not a pose database", path, "make one with: depthmocap posedb build");
  reader.text(kMagic.size());
  const auto version = reader.take<std::uint32_t>();
  if (version != kVersion) {
    throw Error("the pose database has version " + std::to_string(version) + ", this program reads version " +
                    std::to_string(kVersion),
                path, "make it again with: depthmocap posedb build");
  }
  const auto dofs = reader.take<std::uint32_t>();
  if (dofs != kDofCount) throw Error("the pose database is of a body with " + std::to_string(dofs) + " DoFs", path);
  Counts counts;
  counts.poses = reader.take<std::uint64_t>();
  counts.sources = reader.take<std::uint32_t>();
  counts.origin_bytes = reader.take<std::uint32_t>();
  const auto expected = reader.take<std::uint32_t>();
  if (checksum(reader.rest().data(), reader.rest().size()) != expected) {
    throw Error("the pose database is damaged: its checksum does not fit", path, "make or copy it again");
  }
  return counts;
}

PoseDatabase::Source readSource(Reader& reader, const Counts& counts, const std::string& path) {
  PoseDatabase::Source source;
  source.name = reader.text(reader.take<std::uint32_t>());
  source.first = reader.take<std::uint32_t>();
  source.count = reader.take<std::uint32_t>();
  if (std::uint64_t{source.first} + source.count > counts.poses) {
    throw Error("the pose database is damaged: a source names poses beyond its end", path, "make or copy it again");
  }
  return source;
}

}  // namespace

PoseDatabase loadPoseDatabase(const std::filesystem::path& path) {
  const std::string name = path.string();
  const std::string bytes = readFile(path, "the pose database", kMostBytes);
  Reader reader(bytes, name);
  const Counts counts = readHeader(reader, name);
  PoseDatabase database;
  database.origin = reader.text(counts.origin_bytes);
  for (std::uint32_t i = 0; i < counts.sources; ++i) database.sources.push_back(readSource(reader, counts, name));
  const std::string_view poses = reader.rest();
  if (poses.size() % kPoseBytes != 0 || poses.size() / kPoseBytes != counts.poses) {
    throw Error("the pose database is truncated", name, "make or copy it again");
  }
  database.poses.resize(counts.poses);
  if (!poses.empty()) std::memcpy(static_cast<void*>(database.poses.data()), poses.data(), poses.size());
  for (const auto& pose : database.poses) {
    if (!pose.allFinite()) throw Error("the pose database holds a pose that is no number", name, "make it again");
  }
  return database;
}

void savePoseDatabase(const PoseDatabase& database, const std::filesystem::path& path) {
  std::string body = database.origin;
  for (const PoseDatabase::Source& source : database.sources) {
    DMC_CHECK(std::size_t{source.first} + source.count <= database.size());
    put(body, static_cast<std::uint32_t>(source.name.size()));
    body += source.name;
    put(body, source.first);
    put(body, source.count);
  }
  body.append(reinterpret_cast<const char*>(database.poses.data()), database.size() * kPoseBytes);
  std::string header(kMagic);
  put(header, kVersion);
  put(header, static_cast<std::uint32_t>(kDofCount));
  put(header, static_cast<std::uint64_t>(database.size()));
  put(header, static_cast<std::uint32_t>(database.sources.size()));
  put(header, static_cast<std::uint32_t>(database.origin.size()));
  put(header, checksum(body.data(), body.size()));
  DMC_CHECK(header.size() == kHeaderBytes);
  AtomicFile file(path);
  file.write(header);
  file.write(body);
  file.commit();
}

}  // namespace depthmocap
