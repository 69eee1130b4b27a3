#include "libtracker/actor/template_surface.h"

#include <cstdint>
#include <cstring>

#include "depthmocap/error.h"
#include "libtracker/actor/embedded_bodies.h"

namespace depthmocap {
namespace {

// The file: the magic, then the three bodies, each as read() takes it. Numbers are little-endian, as on every machine
// that the program runs on.
constexpr std::string_view kMagic = "dmcbody1";
constexpr std::uint32_t kMostPoints = 1U << 20;  // of a part; more is no such file

class Writer {
 public:
  template <typename T>
  void put(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <typename Vector>
  void putVector(const Vector& v) {
    for (int i = 0; i < 3; ++i) put(v[i]);
  }
  std::string bytes{kMagic};
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {
    if (!rest_.starts_with(kMagic)) throw Error("is not a file of body templates", "bodies.bin");
    rest_.remove_prefix(kMagic.size());
  }
  template <typename T>
  T get() {
    if (rest_.size() < sizeof(T)) throw Error("is cut short", "bodies.bin");
    T value;
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_.remove_prefix(sizeof value);
    return value;
  }
  template <typename Vector>
  void getVector(Vector& v) {
    for (int i = 0; i < 3; ++i) v[i] = get<typename Vector::Scalar>();
  }
  Bone getBone() {
    const auto bone = get<std::uint8_t>();
    if (bone >= kBoneCount) throw Error("names a bone that does not exist", "bodies.bin");
    return static_cast<Bone>(bone);
  }
  [[nodiscard]] bool atEnd() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

void write(const TemplateSurface& body, Writer& out) {
  for (const auto field : kBoneLengthFields) out.put(body.lengths.*field);
  out.put(body.surface.stature_m);
  for (const auto& part : body.surface.parts) {
    out.put(static_cast<std::uint32_t>(part.size()));
    for (const SurfaceModel::Point& point : part) {
      out.put(static_cast<std::uint8_t>(point.bone));
      out.putVector(point.p_bone);
      out.putVector(point.n_bone);
    }
  }
  for (const TemplateSurface::End& end : body.ends) {
    out.put(static_cast<std::uint8_t>(end.bone));
    out.put(static_cast<std::uint8_t>(end.part));
    out.putVector(end.p);
    out.putVector(end.n);
  }
}

TemplateSurface read(Reader& in) {
  TemplateSurface body;
  for (const auto field : kBoneLengthFields) body.lengths.*field = in.get<double>();
  body.surface.stature_m = in.get<double>();
  for (auto& part : body.surface.parts) {
    const auto count = in.get<std::uint32_t>();
    if (count > kMostPoints) throw Error("has an impossible number of points", "bodies.bin");
    for (std::uint32_t i = 0; i < count; ++i) {
      SurfaceModel::Point& point = part.emplace_back();
      point.bone = in.getBone();
      in.getVector(point.p_bone);
      in.getVector(point.n_bone);
    }
  }
  for (TemplateSurface::End& end : body.ends) {
    end.bone = in.getBone();
    const auto part = in.get<std::uint8_t>();
    if (part > kPartCount) throw Error("names a part that does not exist", "bodies.bin");
    end.part = static_cast<Part>(part);
    in.getVector(end.p);
    in.getVector(end.n);
  }
  return body;
}

}  // namespace

std::string shippedBodiesToBytes(const ShippedBodies& bodies) {
  Writer out;
  for (const TemplateSurface* body : {&bodies.average, &bodies.man, &bodies.woman}) write(*body, out);
  return out.bytes;
}

ShippedBodies shippedBodiesFromBytes(std::string_view bytes) {
  Reader in(bytes);
  ShippedBodies bodies;
  for (TemplateSurface* body : {&bodies.average, &bodies.man, &bodies.woman}) *body = read(in);
  if (!in.atEnd()) throw Error("goes on after its end", "bodies.bin");
  return bodies;
}

const ShippedBodies& shippedBodies() {
  static const ShippedBodies bodies = shippedBodiesFromBytes(embeddedBodies());
  return bodies;
}

}  // namespace depthmocap
