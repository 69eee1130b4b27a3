#include "libtracker/output/gltf.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "libtracker/core/atomic_file.h"
#include "libtracker/output/skin_rig.h"

namespace depthmocap {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");

// Numbers that the format gives its types.
enum ComponentType { kUnsignedByte = 5121, kUnsignedInt = 5125, kFloat = 5126 };
enum BufferTarget { kNoTarget = 0, kArrayBuffer = 34962, kElementArrayBuffer = 34963 };
constexpr std::uint32_t kMagic = 0x46546C67;        // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;  // "BIN"

json listOf(json element) {
  json list = json::array();
  list.push_back(std::move(element));
  return list;
}

// The one binary buffer and its views.
class Buffer {
 public:
  // Adds an accessor over values that are stored one after another; returns its index.
  template <typename T>
  int add(const std::vector<T>& values, std::size_t count, ComponentType component, const char* type,
          BufferTarget target = kNoTarget) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    const std::size_t size = values.size() * sizeof(T);
    json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}};
    if (target != kNoTarget) view["target"] = target;
    const std::size_t start = bytes_.size();
    bytes_.resize(start + size);
    if (size > 0) std::memcpy(bytes_.data() + start, values.data(), size);
    accessors_.push_back(
        {{"bufferView", views_.size()}, {"componentType", component}, {"count", count}, {"type", type}});
    views_.push_back(view);
    return static_cast<int>(accessors_.size()) - 1;
  }
  json& accessor(int index) { return accessors_[static_cast<std::size_t>(index)]; }
  void describe(json& document) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    document["buffers"] = listOf({{"byteLength", bytes_.size()}});
    document["bufferViews"] = views_;
    document["accessors"] = accessors_;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  json views_ = json::array();
  json accessors_ = json::array();
};

void append(std::vector<float>& out, const Eigen::Vector3d& v) {
  for (int i = 0; i < 3; ++i) out.push_back(static_cast<float>(v[i]));
}

// The names of the first person's nodes are what other programs know; the others' say whose they are.
std::string named(const std::string& name, int number) {
  return number == 1 ? name : fmt::format("{}-{}", name, number);
}

class Document {
 public:
  Document() {
    document_["asset"] = {{"version", "2.0"}, {"generator", "depthmocap"}};
    document_["scene"] = 0;
  }

  // `start_s`: of the animation, in the time of the track.
  void add(int number, const BodySurface& body, const MotionTrack& track, RigStyle style, double start_s) {
    const SkinRig skin(body, style);
    Person rig{body, track, skin, skin.nodes(), {}, nodes_.size()};
    float lowest = 0;
    for (const Eigen::Vector3f& p : skin.vertices()) lowest = std::min(lowest, p.y());
    rig.lift = Eigen::Vector3d(0, -static_cast<double>(lowest), 0);
    rig.nodes[static_cast<std::size_t>(skin.nodeOf(static_cast<int>(Bone::Root)))].offset = rig.lift;
    addNodes(rig, number);
    addSkin(rig);
    addMesh(rig, number);
    if (!track.frames.empty()) addAnimation(rig, start_s);
  }

  std::string bytes() {
    document_["scenes"] = listOf({{"nodes", roots_}});
    document_["nodes"] = nodes_;
    document_["skins"] = skins_;
    document_["meshes"] = meshes_;
    const json look = {{"baseColorFactor", {0.62, 0.66, 0.72, 1.0}}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.8}};
    document_["materials"] = listOf({{"name", "Skin"}, {"pbrMetallicRoughness", look}});
    if (!channels_.empty()) {
      document_["animations"] = listOf({{"name", "Motion"}, {"samplers", samplers_}, {"channels", channels_}});
    }
    buffer_.describe(document_);
    return packed();
  }

 private:
  // One person's part of the document.
  struct Person {
    const BodySurface& body;
    const MotionTrack& track;
    const SkinRig& skin;
    std::vector<SkinRig::Node> nodes;
    Eigen::Vector3d lift;
    std::size_t first;  // index of the first node in the document
  };

  // A skinned mesh is placed by its joints alone, so it stands beside the armature at the root of the scene.
  void addNodes(const Person& rig, int number) {
    for (std::size_t n = 0; n < rig.nodes.size(); ++n) {
      const SkinRig::Node& node = rig.nodes[n];
      json entry = {{"name", node.name}, {"translation", {node.offset.x(), node.offset.y(), node.offset.z()}}};
      json children = json::array();
      for (std::size_t child = n + 1; child < rig.nodes.size(); ++child) {
        if (rig.nodes[child].parent == static_cast<int>(n)) children.push_back(rig.first + child);
      }
      if (!children.empty()) entry["children"] = children;
      nodes_.push_back(entry);
    }
    roots_.push_back(nodes_.size());
    nodes_.push_back({{"name", named("Armature", number)}, {"children", listOf(rig.first)}});
    roots_.push_back(nodes_.size());
    nodes_.push_back({{"name", named("Body", number)}, {"mesh", meshes_.size()}, {"skin", skins_.size()}});
  }

  void addSkin(const Person& rig) {
    std::vector<Eigen::Vector3d> origin;
    std::vector<float> inverse_bind;
    json joints = json::array();
    for (std::size_t n = 0; n < rig.nodes.size(); ++n) {
      const int parent = rig.nodes[n].parent;
      origin.push_back(rig.nodes[n].offset);
      if (parent >= 0) origin[n] += origin[static_cast<std::size_t>(parent)];
      Eigen::Matrix4f inverse = Eigen::Matrix4f::Identity();
      inverse.topRightCorner<3, 1>() = -origin[n].cast<float>();
      inverse_bind.insert(inverse_bind.end(), inverse.data(), inverse.data() + 16);
      joints.push_back(rig.first + n);
    }
    const int accessor = buffer_.add(inverse_bind, rig.nodes.size(), kFloat, "MAT4");
    skins_.push_back({{"joints", joints}, {"skeleton", rig.first}, {"inverseBindMatrices", accessor}});
  }

  void addMesh(const Person& rig, int number) {
    const BodySurface& body = rig.body;
    std::vector<float> positions;
    std::vector<float> normals;
    std::vector<float> weights;
    std::vector<std::uint8_t> bones;
    Eigen::Vector3f low = Eigen::Vector3f::Constant(1e9F);
    Eigen::Vector3f high = -low;
    const auto vertex_normals = vertexNormals(rig.skin.vertices(), body.triangles);
    for (std::size_t v = 0; v < body.vertices.size(); ++v) {
      const Eigen::Vector3f p = rig.skin.vertices()[v] + rig.lift.cast<float>();
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
      append(positions, p.cast<double>());
      const Eigen::Vector3f& n = vertex_normals[v];
      append(normals, n.isZero() ? Eigen::Vector3d(0, 1, 0) : Eigen::Vector3d(n.cast<double>()));
      for (std::size_t k = 0; k < 4; ++k) {
        const float weight = body.skin[v].weight[k];
        weights.push_back(weight);
        bones.push_back(weight > 0 ? static_cast<std::uint8_t>(rig.skin.nodeOf(body.skin[v].bone[k]))
                                   : std::uint8_t{0});
      }
    }
    std::vector<std::uint32_t> indices;
    for (const auto& triangle : body.triangles) indices.insert(indices.end(), triangle.begin(), triangle.end());
    const std::size_t count = body.vertices.size();
    const int position = buffer_.add(positions, count, kFloat, "VEC3", kArrayBuffer);
    buffer_.accessor(position)["min"] = {low.x(), low.y(), low.z()};
    buffer_.accessor(position)["max"] = {high.x(), high.y(), high.z()};
    const int normal = buffer_.add(normals, count, kFloat, "VEC3", kArrayBuffer);
    const int joint = buffer_.add(bones, count, kUnsignedByte, "VEC4", kArrayBuffer);
    const int weight = buffer_.add(weights, count, kFloat, "VEC4", kArrayBuffer);
    const int index = buffer_.add(indices, indices.size(), kUnsignedInt, "SCALAR", kElementArrayBuffer);
    const json attributes = {{"POSITION", position}, {"NORMAL", normal}, {"JOINTS_0", joint}, {"WEIGHTS_0", weight}};
    const json primitive = {{"attributes", attributes}, {"indices", index}, {"material", 0}};
    meshes_.push_back({{"name", named("Body", number)}, {"primitives", listOf(primitive)}});
  }

  void addAnimation(const Person& rig, double start_s) {
    const MotionTrack& track = rig.track;
    std::vector<float> times;
    for (const auto& frame : track.frames) times.push_back(static_cast<float>(frame.time_s - start_s));
    const int time_accessor = buffer_.add(times, times.size(), kFloat, "SCALAR");
    buffer_.accessor(time_accessor)["min"] = listOf(times.front());
    buffer_.accessor(time_accessor)["max"] = listOf(times.back());
    const auto add = [&](std::size_t node, const char* path, const std::vector<float>& values, const char* type) {
      const int output = buffer_.add(values, track.frames.size(), kFloat, type);
      channels_.push_back({{"sampler", samplers_.size()}, {"target", {{"node", rig.first + node}, {"path", path}}}});
      samplers_.push_back({{"input", time_accessor}, {"output", output}, {"interpolation", "LINEAR"}});
    };
    for (int node = 0; node < rig.skin.movingNodes(); ++node) {
      std::vector<float> positions;
      for (const auto& frame : track.frames) {
        append(positions, rig.skin.positions(frame.q)[static_cast<std::size_t>(node)]);
      }
      add(static_cast<std::size_t>(node), "translation", positions, "VEC3");
    }
    if (track.sizeChanges()) {
      std::vector<float> scale;
      for (const auto& frame : track.frames) append(scale, Eigen::Vector3d::Constant(frame.scale));
      add(static_cast<std::size_t>(rig.skin.movingNodes() - 1), "scale", scale, "VEC3");
    }
    for (int bone = 0; bone < kSkinBoneCount; ++bone) {
      add(static_cast<std::size_t>(rig.skin.nodeOf(bone)), "rotation", rotations(rig, bone), "VEC4");
    }
  }

  // x y z w, each on the side of its predecessor, so that linear interpolation does not go the long way.
  [[nodiscard]] static std::vector<float> rotations(const Person& rig, int bone) {
    std::vector<float> values;
    Eigen::Vector4d before = Eigen::Vector4d::Zero();
    for (const auto& frame : rig.track.frames) {
      Eigen::Vector4d now = rig.skin.rotation(bone, frame.q).coeffs();
      if (now.dot(before) < 0) now = -now;
      for (int i = 0; i < 4; ++i) values.push_back(static_cast<float>(now[i]));
      before = now;
    }
    return values;
  }

  [[nodiscard]] std::string packed() const {
    std::string text = document_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::string& binary = buffer_.bytes();
    std::string file;
    const auto number = [&](std::size_t value) {
      const auto n = static_cast<std::uint32_t>(value);
      file.append(reinterpret_cast<const char*>(&n), sizeof n);
    };
    number(kMagic);
    number(2);
    number(12 + 8 + text.size() + 8 + binary.size());
    number(text.size());
    number(kJsonChunk);
    file += text;
    number(binary.size());
    number(kBinaryChunk);
    file += binary;
    return file;
  }

  Buffer buffer_;
  json document_;
  json nodes_ = json::array();
  json roots_ = json::array();
  json skins_ = json::array();
  json meshes_ = json::array();
  json samplers_ = json::array();
  json channels_ = json::array();
};

double startOf(const MotionTrack& track) {
  return track.frames.empty() ? 0.0 : track.frames.front().time_s;
}

double startOf(const std::vector<AnimatedPerson>& people) {
  double start_s = std::numeric_limits<double>::max();
  for (const AnimatedPerson& person : people) start_s = std::min(start_s, startOf(person.track));
  return start_s;
}

}  // namespace

std::string gltfBytes(const BodySurface& body, const MotionTrack& track, RigStyle style) {
  Document document;
  document.add(1, body, track, style, startOf(track));
  return document.bytes();
}

void writeGltf(const std::filesystem::path& path, const std::vector<AnimatedPerson>& people, RigStyle style) {
  Document document;
  for (const AnimatedPerson& person : people) {
    document.add(person.number, person.body, person.track, style, startOf(people));
  }
  writeFileAtomically(path, document.bytes());
}

}  // namespace depthmocap
