#include "libtracker/body/makehuman_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include <fmt/format.h>
#include <zlib.h>

#include "depthmocap/error.h"
#include "libtracker/core/json_file.h"

namespace depthmocap {
namespace {

constexpr float kMetresPerDecimetre = 0.1F;
constexpr float kFarthest_m = 100;                     // a coordinate beyond is no body's
constexpr std::size_t kMostVertices = 1U << 17U;       // base.obj has 19,158
constexpr std::size_t kMostTriangles = 1U << 18U;      // likewise, 27,000 of the body
constexpr std::size_t kMostTextBytes = mebibytes(32);  // base.obj, the largest file, has 3 MB
constexpr const char* kAdvice = "give the folder with MakeHuman's base.obj, rig, weights and targets";

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw Error(what, file.string(), kAdvice);
}

// Splits text into words, one line at a time, without copies.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}
  bool nextLine() {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return true;
  }
  // Empty at the end of the line.
  std::string_view next() {
    const std::size_t start = std::min(line_.find_first_not_of(" \t\r"), line_.size());
    line_.remove_prefix(start);
    const std::string_view word = line_.substr(0, std::min(line_.find_first_of(" \t\r"), line_.size()));
    line_.remove_prefix(word.size());
    return word;
  }

 private:
  std::string_view rest_, line_;
};

template <typename T>
bool parse(std::string_view word, T& value) {
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  return result.ec == std::errc{} && result.ptr == word.data() + word.size();
}

bool parsePoint(Words& words, Eigen::Vector3f& p) {
  for (int i = 0; i < 3; ++i) {
    if (!parse(words.next(), p[i])) return false;
  }
  p *= kMetresPerDecimetre;
  return p.allFinite() && p.cwiseAbs().maxCoeff() < kFarthest_m;
}

std::string readGzip(const std::filesystem::path& file) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> in(gzopen(file.c_str(), "rb"), &gzclose);
  if (!in) fail(file, "cannot be opened");
  std::string text;
  std::array<char, 1U << 15U> buffer;
  int got = 0;
  while ((got = gzread(in.get(), buffer.data(), static_cast<unsigned>(buffer.size()))) > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(got));
    if (text.size() > kMostTextBytes) fail(file, "unpacks to more than any target");
  }
  if (got < 0) fail(file, "is not a complete gzip file");
  return text;
}

// Corners of an obj face, counted from 0; an empty result for a broken line.
std::vector<std::uint32_t> parseFace(Words& words, std::size_t vertex_count) {
  std::vector<std::uint32_t> corners;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    std::uint32_t index = 0;
    if (!parse(word.substr(0, word.find('/')), index) || index == 0 || index > vertex_count) return {};
    corners.push_back(index - 1);
  }
  return corners;
}

std::vector<std::uint32_t> jointVertices(const nlohmann::json& head, const MakeHumanMesh& mesh) {
  if (head.at("strategy") == "MEAN") return head.at("vertex_indices").get<std::vector<std::uint32_t>>();
  const auto cube = mesh.joint_cubes.find(head.at("cube_name").get<std::string>());
  return cube == mesh.joint_cubes.end() ? std::vector<std::uint32_t>{} : cube->second;
}

struct Share {
  std::string_view rig_bone;
  Bone bone;
  float share;
};
// The rig's second neck bone spans the lower half of the turning part of the neck.
constexpr Share kShares[] = {
    {"Hips", Bone::Root, 1},
    {"LHipJoint", Bone::Root, 1},
    {"RHipJoint", Bone::Root, 1},
    {"LowerBack", Bone::Root, 1},
    {"Spine", Bone::UpperBack, 1},
    {"Spine1", Bone::UpperBack, 1},
    {"Neck", Bone::Neck, 1},
    {"Neck1", Bone::Neck, 0.5F},
    {"Neck1", Bone::Head, 0.5F},
    {"Head", Bone::Head, 1},
    {"LeftShoulder", Bone::LeftClavicle, 1},
    {"RightShoulder", Bone::RightClavicle, 1},
    {"LeftArm", Bone::LeftHumerus, 1},
    {"RightArm", Bone::RightHumerus, 1},
    {"LeftForeArm", Bone::LeftRadius, 1},
    {"RightForeArm", Bone::RightRadius, 1},
    {"LeftHand", Bone::LeftRadius, 1},
    {"RightHand", Bone::RightRadius, 1},
    {"LeftFingerBase", Bone::LeftRadius, 1},
    {"RightFingerBase", Bone::RightRadius, 1},
    {"LeftHandFinger1", Bone::LeftRadius, 1},
    {"RightHandFinger1", Bone::RightRadius, 1},
    {"LThumb", Bone::LeftRadius, 1},
    {"RThumb", Bone::RightRadius, 1},
    {"LeftUpLeg", Bone::LeftFemur, 1},
    {"RightUpLeg", Bone::RightFemur, 1},
    {"LeftLeg", Bone::LeftTibia, 1},
    {"RightLeg", Bone::RightTibia, 1},
    {"LeftFoot", Bone::LeftFoot, 1},
    {"RightFoot", Bone::RightFoot, 1},
    {"LeftToeBase", Bone::LeftFoot, 1},
    {"RightToeBase", Bone::RightFoot, 1},
};

}  // namespace

MakeHumanMesh readMakeHumanMesh(const std::filesystem::path& file) {
  const std::string text = readFile(file, "the mesh", kMostTextBytes);
  MakeHumanMesh mesh;
  std::string group;
  Words words(text);
  while (words.nextLine()) {
    const std::string_view kind = words.next();
    if (kind == "v") {
      Eigen::Vector3f p;
      if (!parsePoint(words, p)) fail(file, "has a broken vertex line");
      if (mesh.vertices.size() == kMostVertices) fail(file, "has more vertices than any body");
      mesh.vertices.push_back(p);
    } else if (kind == "g") {
      group = words.next();
    } else if (kind == "f" && (group == "body" || group.starts_with("joint-"))) {
      const std::vector<std::uint32_t> corners = parseFace(words, mesh.vertices.size());
      if (corners.size() < 3) fail(file, "has a broken face line");
      if (group == "body") {
        if (mesh.triangles.size() + corners.size() > kMostTriangles) fail(file, "has more faces than any body");
        for (std::size_t i = 2; i < corners.size(); ++i)
          mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
        mesh.body_vertices =
            std::max<std::size_t>(mesh.body_vertices, *std::max_element(corners.begin(), corners.end()) + 1);
      } else {
        auto& cube = mesh.joint_cubes[group];
        for (const std::uint32_t v : corners) {
          if (std::find(cube.begin(), cube.end(), v) == cube.end()) cube.push_back(v);
        }
      }
    }
  }
  if (mesh.triangles.empty()) fail(file, "has no group 'body'");
  return mesh;
}

MakeHumanTarget readMakeHumanTarget(const std::filesystem::path& file, std::size_t vertex_count) {
  const std::string text = readGzip(file);
  MakeHumanTarget target;
  Words words(text);
  while (words.nextLine()) {
    const std::string_view first = words.next();
    if (first.empty() || first.starts_with('#')) continue;
    std::uint32_t vertex = 0;
    Eigen::Vector3f delta;
    if (!parse(first, vertex) || vertex >= vertex_count || !parsePoint(words, delta)) fail(file, "has a broken line");
    if (target.vertex.size() == vertex_count) fail(file, "has more lines than the body has vertices");
    target.vertex.push_back(vertex);
    target.delta.push_back(delta);
  }
  return target;
}

MakeHumanJoints readMakeHumanRig(const std::filesystem::path& file, const MakeHumanMesh& mesh) {
  const nlohmann::json rig = readJsonFile(file);
  MakeHumanJoints joints;
  try {
    for (const auto& [bone, value] : rig.items()) {
      std::vector<std::uint32_t> vertices = jointVertices(value.at("head"), mesh);
      const bool known =
          std::all_of(vertices.begin(), vertices.end(), [&](auto v) { return v < mesh.vertices.size(); });
      if (vertices.empty() || !known) fail(file, fmt::format("bone {} starts at a joint that base.obj lacks", bone));
      joints[bone] = std::move(vertices);
    }
  } catch (const nlohmann::json::exception& e) {
    fail(file, fmt::format("is not a MakeHuman rig: {}", e.what()));
  }
  return joints;
}

std::vector<BoneWeights> readMakeHumanWeights(const std::filesystem::path& file, std::size_t body_vertices) {
  const nlohmann::json json = readJsonFile(file);
  std::vector<BoneWeights> weights(body_vertices, BoneWeights{});
  try {
    for (const Share& share : kShares) {
      for (const auto& entry : json.at("weights").at(std::string(share.rig_bone))) {
        const auto vertex = entry.at(0).get<std::size_t>();
        if (vertex < body_vertices) {
          weights[vertex][static_cast<std::size_t>(share.bone)] += share.share * entry.at(1).get<float>();
        }
      }
    }
  } catch (const nlohmann::json::exception& e) {
    fail(file, fmt::format("is not a MakeHuman weights file: {}", e.what()));
  }
  for (BoneWeights& row : weights) {
    float sum = 0;
    for (const float w : row) sum += w;
    if (!(sum > 0 && std::isfinite(sum))) fail(file, "leaves a vertex of the body without weight");
    for (float& w : row) w /= sum;
  }
  return weights;
}

}  // namespace depthmocap
