#include "libtracker/output/usd.h"

#include <algorithm>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "libtracker/core/atomic_file.h"
#include "libtracker/output/skin_rig.h"

namespace depthmocap {
namespace {

// Elements between brackets, each as `text` gives it.
template <typename Range, typename Text>
std::string list(const Range& range, Text text) {
  std::string all;
  for (const auto& element : range) {
    if (!all.empty()) all += ", ";
    all += text(element);
  }
  return "[" + all + "]";
}

std::string triple(const Eigen::Vector3d& v) {
  return fmt::format("({:.6f}, {:.6f}, {:.6f})", v.x(), v.y(), v.z());
}

std::string quaternion(const Eigen::Quaterniond& q) {
  return fmt::format("({:.7f}, {:.7f}, {:.7f}, {:.7f})", q.w(), q.x(), q.y(), q.z());
}

// A translation; USD multiplies rows from the left.
std::string translation(const Eigen::Vector3d& v) {
  return fmt::format("( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), ({:.6f}, {:.6f}, {:.6f}, 1) )", v.x(), v.y(), v.z());
}

// Names are paths from the root of the skeleton.
std::vector<std::string> jointPaths(const std::vector<SkinRig::Node>& nodes) {
  std::vector<std::string> paths;
  for (const SkinRig::Node& node : nodes) {
    std::string name = node.name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == ':' || c == '.'; }, '_');
    paths.push_back(node.parent < 0 ? name : paths[static_cast<std::size_t>(node.parent)] + "/" + name);
  }
  return paths;
}

// One person's part of the file.
class PersonText {
 public:
  PersonText(const AnimatedPerson& person, RigStyle style)
      : person_(person),
        skin_(person.body, style),
        name_(person.number == 1 ? "Person" : fmt::format("Person_{}", person.number)),
        nodes_(skin_.nodes()) {
    float lowest = 0;
    for (const Eigen::Vector3f& p : skin_.vertices()) lowest = std::min(lowest, p.y());
    lift_ = Eigen::Vector3d(0, -static_cast<double>(lowest), 0);
    nodes_[static_cast<std::size_t>(hips())].offset = lift_;
    const std::vector<std::string> paths = jointPaths(nodes_);
    joints_ = list(paths, [](const std::string& path) { return '"' + path + '"'; });
  }

  // `time_code(s)`: of a frame's time.
  template <typename TimeCode>
  void write(AtomicFile& file, TimeCode time_code) const {
    file.write(fmt::format("\n    def SkelRoot \"{}\"\n    {{\n", name_));
    file.write(skeleton());
    if (!person_.track.frames.empty()) writeAnimation(file, time_code);
    file.write(mesh());
    file.write("    }\n");
  }

 private:
  [[nodiscard]] int hips() const { return skin_.nodeOf(static_cast<int>(Bone::Root)); }

  [[nodiscard]] std::string skeleton() const {
    std::vector<Eigen::Vector3d> origins;
    for (const SkinRig::Node& node : nodes_) {
      origins.push_back(node.offset);
      if (node.parent >= 0) origins.back() += origins[static_cast<std::size_t>(node.parent)];
    }
    return fmt::format(
        "        def Skeleton \"Skeleton\" (\n            prepend apiSchemas = [\"SkelBindingAPI\"]\n        )\n       "
        " {{\n"
        "            uniform token[] joints = {}\n            uniform matrix4d[] bindTransforms = {}\n"
        "            uniform matrix4d[] restTransforms = {}\n"
        "            rel skel:animationSource = </Motion/{}/Animation>\n        }}\n",
        joints_, list(origins, translation),
        list(nodes_, [](const SkinRig::Node& node) { return translation(node.offset); }), name_);
  }

  template <typename TimeCode>
  void writeAnimation(AtomicFile& file, TimeCode time_code) const {
    const auto& frames = person_.track.frames;
    file.write(fmt::format(
        "\n        def SkelAnimation \"Animation\"\n        {{\n            uniform token[] joints = {}\n", joints_));
    const auto samples = [&](const char* name, auto text) {
      file.write(fmt::format("            {}.timeSamples = {{\n", name));
      for (const MotionTrack::Frame& frame : frames) {
        file.write(fmt::format("                {:.6f}: {},\n", time_code(frame.time_s), text(frame)));
      }
      file.write("            }\n");
    };
    samples("float3[] translations",
            [&](const MotionTrack::Frame& frame) { return list(translations(frame), triple); });
    samples("quatf[] rotations", [&](const MotionTrack::Frame& frame) { return list(rotations(frame), quaternion); });
    samples("half3[] scales", [&](const MotionTrack::Frame& frame) { return list(scales(frame), triple); });
    file.write("        }\n");
  }

  [[nodiscard]] std::vector<Eigen::Vector3d> translations(const MotionTrack::Frame& frame) const {
    std::vector<Eigen::Vector3d> all;
    all.reserve(nodes_.size());
    for (const SkinRig::Node& node : nodes_) all.push_back(node.offset);
    std::ranges::copy(skin_.positions(frame.q), all.begin());
    return all;
  }

  [[nodiscard]] std::vector<Eigen::Quaterniond> rotations(const MotionTrack::Frame& frame) const {
    std::vector<Eigen::Quaterniond> all(nodes_.size(), Eigen::Quaterniond::Identity());
    for (int bone = 0; bone < kSkinBoneCount; ++bone) {
      all[static_cast<std::size_t>(skin_.nodeOf(bone))] = skin_.rotation(bone, frame.q);
    }
    return all;
  }

  [[nodiscard]] std::vector<Eigen::Vector3d> scales(const MotionTrack::Frame& frame) const {
    std::vector<Eigen::Vector3d> all(nodes_.size(), Eigen::Vector3d::Ones());
    all[static_cast<std::size_t>(hips())] *= frame.scale;
    return all;
  }

  [[nodiscard]] std::string mesh() const {
    std::vector<Eigen::Vector3d> points;
    Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::max());
    Eigen::Vector3d high = -low;
    for (const Eigen::Vector3f& p : skin_.vertices()) {
      points.emplace_back(p.cast<double>() + lift_);
      low = low.cwiseMin(points.back());
      high = high.cwiseMax(points.back());
    }
    const auto normals = vertexNormals(skin_.vertices(), person_.body.triangles);
    std::vector<int> joints;
    std::vector<float> weights;
    for (const BodySurface::Skin& skin : person_.body.skin) {
      for (std::size_t k = 0; k < skin.bone.size(); ++k) {
        joints.push_back(skin.weight[k] > 0 ? skin_.nodeOf(skin.bone[k]) : 0);
        weights.push_back(skin.weight[k]);
      }
    }
    const auto number = [](auto value) { return fmt::format("{}", value); };
    std::string text =
        "\n        def Mesh \"Body\" (\n            prepend apiSchemas = [\"SkelBindingAPI\"]\n        )\n        {\n";
    const auto attribute = [&](std::string_view name, const std::string& value) {
      text += fmt::format("            {} = {}\n", name, value);
    };
    attribute("float3[] extent", list(std::vector<Eigen::Vector3d>{low, high}, triple));
    attribute("int[] faceVertexCounts", list(person_.body.triangles, [](const auto&) { return std::string("3"); }));
    attribute("int[] faceVertexIndices", list(person_.body.triangles, [](const auto& corners) {
                return fmt::format("{}, {}, {}", corners[0], corners[1], corners[2]);
              }));
    attribute("point3f[] points", list(points, triple));
    attribute("normal3f[] normals", list(normals, [](const Eigen::Vector3f& n) { return triple(n.cast<double>()); }) +
                                        " (\n                interpolation = \"vertex\"\n            )");
    attribute("color3f[] primvars:displayColor", "[(0.62, 0.66, 0.72)]");
    const char* per_vertex =
        " (\n                elementSize = 4\n                interpolation = \"vertex\"\n            )";
    attribute("int[] primvars:skel:jointIndices", list(joints, number) + per_vertex);
    attribute("float[] primvars:skel:jointWeights", list(weights, number) + per_vertex);
    attribute("uniform token subdivisionScheme", "\"none\"");
    attribute("rel skel:skeleton", fmt::format("</Motion/{}/Skeleton>", name_));
    return text + "        }\n";
  }

  const AnimatedPerson& person_;
  SkinRig skin_;
  std::string name_;
  std::vector<SkinRig::Node> nodes_;
  Eigen::Vector3d lift_ = Eigen::Vector3d::Zero();
  std::string joints_;
};

// First and last time of all [s].
std::pair<double, double> timesOf(const std::vector<AnimatedPerson>& people) {
  double first_s = std::numeric_limits<double>::max();
  double last_s = std::numeric_limits<double>::lowest();
  for (const AnimatedPerson& person : people) {
    if (person.track.frames.empty()) continue;
    first_s = std::min(first_s, person.track.frames.front().time_s);
    last_s = std::max(last_s, person.track.frames.back().time_s);
  }
  return {first_s, std::max(first_s, last_s)};
}

}  // namespace

void writeUsd(const std::filesystem::path& path, const std::vector<AnimatedPerson>& people, double fps,
              RigStyle style) {
  const auto [first_s, last_s] = timesOf(people);
  const auto time_code = [start_s = first_s, fps](double time_s) { return (time_s - start_s) * fps; };
  AtomicFile file(path);
  file.write(
      fmt::format("#usda 1.0\n(\n    defaultPrim = \"Motion\"\n    metersPerUnit = 1\n    upAxis = \"Y\"\n"
                  "    startTimeCode = 0\n    endTimeCode = {:.6f}\n    timeCodesPerSecond = {:.6f}\n"
                  "    framesPerSecond = {:.6f}\n)\n\ndef Xform \"Motion\" (\n    kind = \"component\"\n)\n{{",
                  time_code(last_s), fps, fps));
  for (const AnimatedPerson& person : people) PersonText(person, style).write(file, time_code);
  file.write("}\n");
  file.commit();
}

}  // namespace depthmocap
