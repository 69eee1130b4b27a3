#include "libtracker/output/gltf.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "libtracker/body/pose_surface.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/motion/bvh_writer.h"
#include "libtracker/skeleton/forward_kinematics.h"

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

// A node of the skeleton. The first kSkinBoneCount nodes are the skin bones in their order; every node is in the skin.
struct RigNode {
  std::string name;
  int parent;  // index of a node; -1: none
  Eigen::Vector3d offset;
};

std::vector<RigNode> rigNodes(const Skeleton& skeleton) {
  const std::vector<MotionBone> bones = bvhBones(skeleton);
  std::vector<RigNode> nodes;
  const auto add = [&](const std::string& name, int parent, const Eigen::Vector3d& offset) {
    nodes.push_back({name, parent, offset});
  };
  for (std::size_t b = 0; b < kBoneCount; ++b) add(bones[b].name, bones[b].parent, bones[b].offset);
  for (const TwistBone& limb : kTwistBones) {
    const MotionBone& bone = bones[static_cast<std::size_t>(limb.bone)];
    add(bone.name + "Untwisted", bone.parent, bone.offset);
  }
  for (std::size_t b = kBoneCount; b < bones.size(); ++b) add(bones[b].name, bones[b].parent, bones[b].offset);
  const auto head = static_cast<std::size_t>(Bone::Head);
  add("HeadTop_End", static_cast<int>(head), bones[head].tip);
  return nodes;
}

Eigen::Matrix3d nodeRotation(int skin_bone, const Pose& q) {
  if (skin_bone < kBoneCount) return localRotation(static_cast<Bone>(skin_bone), q);
  const TwistBone& limb = kTwistBones[static_cast<std::size_t>(skin_bone - kBoneCount)];
  return localRotation(limb.bone, q) *
         Eigen::AngleAxisd(-q[limb.twist], Eigen::Vector3d::Unit(limb.axis)).toRotationMatrix();
}

class Document {
 public:
  Document(const BodySurface& body, const MotionTrack& track)
      : body_(body), track_(track), nodes_(rigNodes(body.skeleton)) {
    float lowest = 0;
    for (const Eigen::Vector3f& p : body.vertices) lowest = std::min(lowest, p.y());
    lift_ = Eigen::Vector3d(0, -static_cast<double>(lowest), 0);
    nodes_[0].offset = lift_;
  }

  std::string bytes() {
    addNodes();
    addSkin();
    addMesh();
    if (!track_.frames.empty()) addAnimation();
    buffer_.describe(document_);
    return packed();
  }

 private:
  [[nodiscard]] int meshNode() const { return static_cast<int>(nodes_.size()); }
  [[nodiscard]] int armatureNode() const { return meshNode() + 1; }

  void addNodes() {
    json nodes = json::array();
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      const RigNode& node = nodes_[n];
      json entry = {{"name", node.name}, {"translation", {node.offset.x(), node.offset.y(), node.offset.z()}}};
      json children = json::array();
      for (std::size_t child = n + 1; child < nodes_.size(); ++child) {
        if (nodes_[child].parent == static_cast<int>(n)) children.push_back(child);
      }
      if (!children.empty()) entry["children"] = children;
      nodes.push_back(entry);
    }
    nodes.push_back({{"name", "Body"}, {"mesh", 0}, {"skin", 0}});
    nodes.push_back({{"name", "Armature"}, {"children", {0, meshNode()}}});
    document_["asset"] = {{"version", "2.0"}, {"generator", "depthmocap"}};
    document_["scene"] = 0;
    document_["scenes"] = listOf({{"nodes", listOf(armatureNode())}});
    document_["nodes"] = nodes;
  }

  void addSkin() {
    std::vector<Eigen::Vector3d> origin;
    std::vector<float> inverse_bind;
    json joints = json::array();
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      const int parent = nodes_[n].parent;
      origin.push_back(nodes_[n].offset);
      if (parent >= 0) origin[n] += origin[static_cast<std::size_t>(parent)];
      Eigen::Matrix4f inverse = Eigen::Matrix4f::Identity();
      inverse.topRightCorner<3, 1>() = -origin[n].cast<float>();
      inverse_bind.insert(inverse_bind.end(), inverse.data(), inverse.data() + 16);
      joints.push_back(n);
    }
    const int accessor = buffer_.add(inverse_bind, nodes_.size(), kFloat, "MAT4");
    document_["skins"] = listOf({{"joints", joints}, {"skeleton", 0}, {"inverseBindMatrices", accessor}});
  }

  void addMesh() {
    std::vector<float> positions;
    std::vector<float> normals;
    std::vector<float> weights;
    std::vector<std::uint8_t> bones;
    Eigen::Vector3f low = Eigen::Vector3f::Constant(1e9F);
    Eigen::Vector3f high = -low;
    const auto vertex_normals = vertexNormals(body_.vertices, body_.triangles);
    for (std::size_t v = 0; v < body_.vertices.size(); ++v) {
      const Eigen::Vector3f p = body_.vertices[v] + lift_.cast<float>();
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
      append(positions, p.cast<double>());
      const Eigen::Vector3f& n = vertex_normals[v];
      append(normals, n.isZero() ? Eigen::Vector3d(0, 1, 0) : Eigen::Vector3d(n.cast<double>()));
      for (std::size_t k = 0; k < 4; ++k) {
        const float weight = body_.skin[v].weight[k];
        weights.push_back(weight);
        bones.push_back(weight > 0 ? body_.skin[v].bone[k] : std::uint8_t{0});
      }
    }
    std::vector<std::uint32_t> indices;
    for (const auto& triangle : body_.triangles) indices.insert(indices.end(), triangle.begin(), triangle.end());
    const std::size_t count = body_.vertices.size();
    const int position = buffer_.add(positions, count, kFloat, "VEC3", kArrayBuffer);
    buffer_.accessor(position)["min"] = {low.x(), low.y(), low.z()};
    buffer_.accessor(position)["max"] = {high.x(), high.y(), high.z()};
    const int normal = buffer_.add(normals, count, kFloat, "VEC3", kArrayBuffer);
    const int joint = buffer_.add(bones, count, kUnsignedByte, "VEC4", kArrayBuffer);
    const int weight = buffer_.add(weights, count, kFloat, "VEC4", kArrayBuffer);
    const int index = buffer_.add(indices, indices.size(), kUnsignedInt, "SCALAR", kElementArrayBuffer);
    const json attributes = {{"POSITION", position}, {"NORMAL", normal}, {"JOINTS_0", joint}, {"WEIGHTS_0", weight}};
    const json primitive = {{"attributes", attributes}, {"indices", index}, {"material", 0}};
    document_["meshes"] = listOf({{"name", "Body"}, {"primitives", listOf(primitive)}});
    const json look = {{"baseColorFactor", {0.62, 0.66, 0.72, 1.0}}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.8}};
    document_["materials"] = listOf({{"name", "Skin"}, {"pbrMetallicRoughness", look}});
  }

  void addAnimation() {
    std::vector<float> times;
    for (const auto& frame : track_.frames) {
      times.push_back(static_cast<float>(frame.time_s - track_.frames.front().time_s));
    }
    time_accessor_ = buffer_.add(times, times.size(), kFloat, "SCALAR");
    buffer_.accessor(time_accessor_)["min"] = listOf(times.front());
    buffer_.accessor(time_accessor_)["max"] = listOf(times.back());
    std::vector<float> root;
    for (const auto& frame : track_.frames) append(root, frame.q.head<3>());
    addChannel(0, "translation", root, "VEC3");
    if (track_.sizeChanges()) {
      std::vector<float> scale;
      for (const auto& frame : track_.frames) append(scale, Eigen::Vector3d::Constant(frame.scale));
      addChannel(0, "scale", scale, "VEC3");
    }
    for (int bone = 0; bone < kSkinBoneCount; ++bone) addChannel(bone, "rotation", rotations(bone), "VEC4");
    document_["animations"] = listOf({{"name", "Motion"}, {"samplers", samplers_}, {"channels", channels_}});
  }

  // x y z w, each on the side of its predecessor, so that linear interpolation does not go the long way.
  [[nodiscard]] std::vector<float> rotations(int bone) const {
    std::vector<float> values;
    Eigen::Vector4d before = Eigen::Vector4d::Zero();
    for (const auto& frame : track_.frames) {
      Eigen::Vector4d now = Eigen::Quaterniond(nodeRotation(bone, frame.q)).normalized().coeffs();
      if (now.dot(before) < 0) now = -now;
      for (int i = 0; i < 4; ++i) values.push_back(static_cast<float>(now[i]));
      before = now;
    }
    return values;
  }

  void addChannel(int node, const char* path, const std::vector<float>& values, const char* type) {
    const int output = buffer_.add(values, track_.frames.size(), kFloat, type);
    channels_.push_back({{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers_.push_back({{"input", time_accessor_}, {"output", output}, {"interpolation", "LINEAR"}});
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

  const BodySurface& body_;
  const MotionTrack& track_;
  std::vector<RigNode> nodes_;
  Eigen::Vector3d lift_;
  Buffer buffer_;
  json document_;
  json samplers_ = json::array();
  json channels_ = json::array();
  int time_accessor_ = 0;
};

}  // namespace

std::string gltfBytes(const BodySurface& body, const MotionTrack& track) {
  return Document(body, track).bytes();
}

void writeGltf(const std::filesystem::path& path, const BodySurface& body, const MotionTrack& track) {
  writeFileAtomically(path, gltfBytes(body, track));
}

}  // namespace depthmocap
