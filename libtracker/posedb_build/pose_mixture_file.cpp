#include <cmath>
#include <cstring>
#include <filesystem>

#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/byte_reader.h"
#include "libtracker/posedb_build/pose_mixture.h"

// Layout, little-endian: "DMCPMIX1", u32 length of origin, origin, u32 components, then a component: f32 weight and its
// numbers as i16: mean [1e-4 rad], basis [1/32767], deviation [1e-4 rad].
namespace depthmocap {
namespace {

constexpr char kMagic[] = "DMCPMIX1";
constexpr double kAngleUnit_rad = 1e-4;
constexpr double kBasisUnit = 1.0 / 32767.0;
constexpr std::uint32_t kMaxComponents = 100000;
constexpr std::uint32_t kMaxOrigin = 4096;

void put(std::string& out, const void* data, std::size_t size) {
  out.append(static_cast<const char*>(data), size);
}

void putNumbers(std::string& out, const float* values, Eigen::Index count, double unit) {
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto stored = static_cast<std::int16_t>(std::lround(static_cast<double>(values[i]) / unit));
    put(out, &stored, sizeof stored);
  }
}

class Bytes : public ByteReader {
 public:
  explicit Bytes(const std::filesystem::path& path) : ByteReader(path, "the pose mixture") {}
  void numbers(float* to, Eigen::Index count, double unit) {
    for (Eigen::Index i = 0; i < count; ++i) {
      std::int16_t stored = 0;
      raw(&stored, sizeof stored);
      to[i] = static_cast<float>(stored * unit);
    }
  }
};

}  // namespace

void savePoseMixture(const PoseMixture& mixture, const std::filesystem::path& path) {
  std::string out(kMagic, 8);
  const auto length = static_cast<std::uint32_t>(mixture.origin.size());
  put(out, &length, sizeof length);
  out += mixture.origin;
  const auto count = static_cast<std::uint32_t>(mixture.components.size());
  put(out, &count, sizeof count);
  for (const auto& component : mixture.components) {
    put(out, &component.weight, sizeof component.weight);
    putNumbers(out, component.mean.data(), component.mean.size(), kAngleUnit_rad);
    putNumbers(out, component.basis.data(), component.basis.size(), kBasisUnit);
    putNumbers(out, component.deviation.data(), component.deviation.size(), kAngleUnit_rad);
  }
  writeFileAtomically(path, out);
}

PoseMixture loadPoseMixture(const std::filesystem::path& path) {
  Bytes bytes(path);
  char magic[8];
  bytes.raw(magic, sizeof magic);
  if (std::memcmp(magic, kMagic, sizeof magic) != 0) throw Error("not a pose mixture", path.string());
  PoseMixture mixture;
  mixture.origin.resize(bytes.count(kMaxOrigin));
  bytes.raw(mixture.origin.data(), mixture.origin.size());
  const std::uint32_t count = bytes.count(kMaxComponents);
  for (std::uint32_t i = 0; i < count; ++i) {
    PoseMixture::Component component;
    bytes.raw(&component.weight, sizeof component.weight);
    bytes.check(component.weight >= 0 && component.weight <= 1);
    bytes.numbers(component.mean.data(), component.mean.size(), kAngleUnit_rad);
    bytes.numbers(component.basis.data(), component.basis.size(), kBasisUnit);
    bytes.numbers(component.deviation.data(), component.deviation.size(), kAngleUnit_rad);
    mixture.components.push_back(component);
  }
  bytes.end();
  return mixture;
}

}  // namespace depthmocap
