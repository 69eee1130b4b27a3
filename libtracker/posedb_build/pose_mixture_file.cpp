#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"
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

class Bytes {
 public:
  Bytes(std::string bytes, std::string where) : bytes_(std::move(bytes)), where_(std::move(where)) {}
  void get(void* to, std::size_t size) {
    if (bytes_.size() - at_ < size) throw Error("the pose mixture is cut short", where_);
    std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  std::uint32_t count(std::uint32_t most) {
    std::uint32_t value = 0;
    get(&value, sizeof value);
    if (value > most) throw Error("the pose mixture is damaged", where_);
    return value;
  }
  void numbers(float* to, Eigen::Index count, double unit) {
    for (Eigen::Index i = 0; i < count; ++i) {
      std::int16_t stored = 0;
      get(&stored, sizeof stored);
      to[i] = static_cast<float>(stored * unit);
    }
  }
  void end() const {
    if (at_ != bytes_.size()) throw Error("the pose mixture is damaged", where_);
  }

 private:
  std::string bytes_;
  std::string where_;
  std::size_t at_ = 0;
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
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error("cannot open the pose mixture", path.string());
  std::ostringstream content;
  content << file.rdbuf();
  Bytes bytes(std::move(content).str(), path.string());
  char magic[8];
  bytes.get(magic, sizeof magic);
  if (std::memcmp(magic, kMagic, sizeof magic) != 0) throw Error("not a pose mixture", path.string());
  PoseMixture mixture;
  mixture.origin.resize(bytes.count(kMaxOrigin));
  bytes.get(mixture.origin.data(), mixture.origin.size());
  const std::uint32_t count = bytes.count(kMaxComponents);
  for (std::uint32_t i = 0; i < count; ++i) {
    PoseMixture::Component component;
    bytes.get(&component.weight, sizeof component.weight);
    if (!(component.weight >= 0 && component.weight <= 1)) throw Error("the pose mixture is damaged", path.string());
    bytes.numbers(component.mean.data(), component.mean.size(), kAngleUnit_rad);
    bytes.numbers(component.basis.data(), component.basis.size(), kBasisUnit);
    bytes.numbers(component.deviation.data(), component.deviation.size(), kAngleUnit_rad);
    mixture.components.push_back(component);
  }
  bytes.end();
  return mixture;
}

}  // namespace depthmocap
