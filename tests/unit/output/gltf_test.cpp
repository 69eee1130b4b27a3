#include "libtracker/output/gltf.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include <gtest/gtest.h>

#include "libtracker/body/builtin_body.h"
#include "libtracker/body/pose_surface.h"
#include "libtracker/core/random.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

using nlohmann::json;

// A reader by the specification of glTF 2.0, not by our writer.
class Glb {
 public:
  explicit Glb(const std::string& bytes) {
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(number(bytes, 4), 2U);
    EXPECT_EQ(number(bytes, 8), bytes.size());
    const std::size_t text = number(bytes, 12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(text % 4, 0U);
    document = json::parse(bytes.substr(20, text));
    EXPECT_EQ(bytes.substr(24 + text, 4), std::string("BIN\0", 4));
    binary_ = bytes.substr(28 + text);
    EXPECT_EQ(number(bytes, 20 + text), binary_.size());
    EXPECT_EQ(document["buffers"][0]["byteLength"], binary_.size());
  }
  template <typename T>
  [[nodiscard]] std::vector<T> values(int accessor) const {
    const json& view = document["bufferViews"][document["accessors"][accessor]["bufferView"].get<int>()];
    const std::string part = binary_.substr(view["byteOffset"], view["byteLength"]);
    std::vector<T> result(part.size() / sizeof(T));
    std::memcpy(result.data(), part.data(), part.size());
    return result;
  }
  // World transform of every node in one frame of the animation; without animation in the rest pose.
  [[nodiscard]] std::vector<Eigen::Affine3d> worldAt(int frame) const {
    const std::size_t count = document["nodes"].size();
    std::vector<Eigen::Vector3d> translation(count, Eigen::Vector3d::Zero());
    std::vector<Eigen::Quaterniond> rotation(count, Eigen::Quaterniond::Identity());
    std::vector<double> scale(count, 1.0);
    for (std::size_t n = 0; n < count; ++n) {
      if (!document["nodes"][n].contains("translation")) continue;
      for (int i = 0; i < 3; ++i) translation[n][i] = document["nodes"][n]["translation"][i];
    }
    const json channels = document.contains("animations") ? document["animations"][0]["channels"] : json::array();
    for (const json& channel : channels) {
      const json& sampler = document["animations"][0]["samplers"][channel["sampler"].get<int>()];
      const std::vector<float> v = values<float>(sampler["output"]);
      const std::size_t n = channel["target"]["node"];
      const auto f = static_cast<std::size_t>(frame);
      if (channel["target"]["path"] == "translation") translation[n] = {v[3 * f], v[3 * f + 1], v[3 * f + 2]};
      if (channel["target"]["path"] == "scale") scale[n] = v[3 * f];
      if (channel["target"]["path"] == "rotation") rotation[n] = {v[4 * f + 3], v[4 * f], v[4 * f + 1], v[4 * f + 2]};
    }
    std::vector<Eigen::Affine3d> world(count);
    const auto place = [&](auto&& self, std::size_t n, const Eigen::Affine3d& parent) -> void {
      world[n] = parent * Eigen::Translation3d(translation[n]) * rotation[n] * Eigen::Scaling(scale[n]);
      for (const json& child : document["nodes"][n].value("children", json::array())) self(self, child, world[n]);
    };
    place(place, document["scenes"][0]["nodes"][0], Eigen::Affine3d::Identity());
    return world;
  }
  [[nodiscard]] std::size_t node(const std::string& name) const {
    for (std::size_t n = 0; n < document["nodes"].size(); ++n) {
      if (document["nodes"][n]["name"] == name) return n;
    }
    throw std::runtime_error("no node " + name);
  }
  json document;

 private:
  static std::uint32_t number(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  }
  std::string binary_;
};

const BodySurface& body() {
  static const BodySurface surface = makeBuiltinBody(averageBoneLengths(1.66));
  return surface;
}

MotionTrack randomTrack(int frames) {
  MotionTrack track;
  track.lengths = body().skeleton.lengths;
  Random random(11);
  for (int i = 0; i < frames; ++i) {
    MotionTrack::Frame frame;
    frame.time_s = 5.0 + i / 30.0;
    for (int d = 0; d < kDofCount; ++d) frame.q[d] = random.uniform(-1.0, 1.0);
    frame.scale = i == 0 ? 0.95 : 1.0;
    track.frames.push_back(frame);
  }
  return track;
}

TEST(Gltf, JointsAreWhereOurKinematicsPutsThem) {
  constexpr std::array<const char*, kJointCount> kNames = {
      "Hips",     "Spine",       "Neck",         "Head",      "LeftArm",   "LeftForeArm",
      "LeftHand", "RightArm",    "RightForeArm", "RightHand", "LeftUpLeg", "LeftLeg",
      "LeftFoot", "LeftToeBase", "RightUpLeg",   "RightLeg",  "RightFoot", "RightToeBase"};
  const MotionTrack track = randomTrack(5);
  const Glb glb(gltfBytes(body(), track));
  for (std::size_t f = 0; f < track.frames.size(); ++f) {
    const auto world = glb.worldAt(static_cast<int>(f));
    const Skeleton skeleton = makeSkeleton(track.lengths.scaled(track.frames[f].scale));
    const JointPositions expected = jointPositions(skeleton, track.frames[f].q);
    for (int j = 0; j < kJointCount; ++j) {
      Eigen::Vector3d p = world[glb.node(kNames[static_cast<std::size_t>(j)])].translation();
      if (j == 3) p = 0.5 * (p + world[glb.node("HeadTop_End")].translation());
      EXPECT_LT((p - expected.col(j)).norm(), 1e-5) << "frame " << f << ' ' << kNames[static_cast<std::size_t>(j)];
    }
  }
}

TEST(Gltf, SkinFollowsAsOurs) {
  const MotionTrack track = randomTrack(3);
  const Glb glb(gltfBytes(body(), track));
  const json& attributes = glb.document["meshes"][0]["primitives"][0]["attributes"];
  const auto positions = glb.values<float>(attributes["POSITION"]);
  const auto joints = glb.values<std::uint8_t>(attributes["JOINTS_0"]);
  const auto weights = glb.values<float>(attributes["WEIGHTS_0"]);
  const auto inverse = glb.values<float>(glb.document["skins"][0]["inverseBindMatrices"]);
  const auto world = glb.worldAt(2);
  std::vector<Eigen::Vector3f> expected;
  poseSurface(body(), track.frames[2].q, expected);
  ASSERT_EQ(positions.size(), 3 * expected.size());
  for (std::size_t v = 0; v < expected.size(); v += 13) {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t joint = joints[4 * v + k];
      const Eigen::Matrix4f bind = Eigen::Map<const Eigen::Matrix4f>(&inverse[16 * joint]);
      const Eigen::Vector4f rest(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2], 1);
      const std::size_t node = glb.document["skins"][0]["joints"][joint];
      p += static_cast<double>(weights[4 * v + k]) * (world[node] * (bind * rest).head<3>().cast<double>());
    }
    EXPECT_LT((p - expected[v].cast<double>()).norm(), 1e-4) << v;
  }
}

TEST(Gltf, TimesStartAtZeroAndKeepTheirDistances) {
  const Glb glb(gltfBytes(body(), randomTrack(4)));
  const json& input = glb.document["accessors"][glb.document["animations"][0]["samplers"][0]["input"].get<int>()];
  EXPECT_EQ(input["min"][0], 0.0);
  EXPECT_NEAR(input["max"][0], 0.1, 1e-6);
  EXPECT_EQ(input["count"], 4);
}

TEST(Gltf, RestPoseStandsOnTheFloorFacingForward) {
  const Glb glb(gltfBytes(body(), {body().skeleton.lengths, {}}));
  EXPECT_FALSE(glb.document.contains("animations"));
  const auto world = glb.worldAt(0);
  const auto at = [&](const char* name) { return Eigen::Vector3d(world[glb.node(name)].translation()); };
  EXPECT_GT(at("LeftHand").x(), 0.5);
  EXPECT_LT(at("RightHand").x(), -0.5);
  EXPECT_GT(at("LeftToeBase").z(), at("LeftFoot").z() + 0.1);
  const json& position =
      glb.document["accessors"][glb.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<int>()];
  EXPECT_NEAR(position["min"][1], 0.0, 1e-6);
  EXPECT_NEAR(position["max"][1], 1.66, 0.03);
}

// Feet on the floor in most frames, once in the air, at a place that nobody chose.
TEST(MotionTrack, StandsOnTheFloorBelowTheFirstHips) {
  MotionTrack track;
  track.lengths = averageBoneLengths(1.7);
  for (int i = 0; i < 9; ++i) {
    MotionTrack::Frame frame;
    frame.time_s = i / 30.0;
    frame.q.head<3>() = Eigen::Vector3d(0.4 + 0.1 * i, -0.2 + (i == 4 ? 0.3 : 0.0), -2.5);
    track.frames.push_back(frame);
  }
  MotionTrack beside = track;
  for (auto& frame : beside.frames) frame.q[kRootTx] += 1.0;
  std::vector<MotionTrack> tracks = {track, beside};
  moveToFloor(tracks);
  const auto ankle_y = [&](std::size_t frame) {
    ForwardKinematics fk;
    fk.update(makeSkeleton(track.lengths), tracks[0].frames[frame].q);
    return fk.origin(Bone::LeftFoot).y();
  };
  EXPECT_NEAR(ankle_y(0), ankleHeight(track.lengths), 1e-9);
  EXPECT_NEAR(ankle_y(4), ankleHeight(track.lengths) + 0.3, 1e-9);
  EXPECT_NEAR(tracks[0].frames[0].q[kRootTx], 0.0, 1e-12);
  EXPECT_NEAR(tracks[0].frames[0].q[kRootTz], 0.0, 1e-12);
  EXPECT_NEAR(tracks[1].frames[3].q[kRootTx], 1.3, 1e-12);  // people keep their distances
  EXPECT_GT(tracks[0].frames[0].q[kRootTy], 0.7);
}

TEST(MotionTrack, RestsWhileLostAndStartsWithTheFirstPose) {
  MotionTrackBuilder builder;
  builder.addLost(0.0);
  EXPECT_TRUE(builder.empty());
  const BoneLengths small = averageBoneLengths(1.6);
  builder.add(0.1, Pose::Constant(0.2), small);
  builder.addLost(0.2);
  const MotionTrack track = builder.track(small.scaled(1.25));
  ASSERT_EQ(track.frames.size(), 3U);
  for (const auto& frame : track.frames) {
    EXPECT_EQ(frame.q, Pose::Constant(0.2));
    EXPECT_NEAR(frame.scale, 0.8, 1e-12);
  }
  EXPECT_TRUE(track.sizeChanges());
  EXPECT_NEAR(track.frameTime_s(30), 0.1, 1e-12);
}

TEST(Gltf, SeveralPeopleHaveASkeletonASkinAndChannelsEach) {
  const BodySurface body = makeBuiltinBody(averageBoneLengths(1.7));
  std::vector<AnimatedPerson> people;
  for (const int number : {1, 3}) {
    MotionTrackBuilder motion;
    for (int i = 0; i < 4; ++i) {
      Pose q = Pose::Zero();
      q[kRootTx] = number;
      motion.add(1.0 + 0.1 * (i + number), q, body.skeleton.lengths);
    }
    people.push_back({number, body, motion.track(body.skeleton.lengths)});
  }
  const TemporaryFolder folder;
  writeGltf(folder / "two.glb", people);
  const Glb glb(readBytes(folder / "two.glb"));
  EXPECT_EQ(glb.document["skins"].size(), 2U);
  EXPECT_EQ(glb.document["meshes"].size(), 2U);
  const json& nodes = glb.document["nodes"];
  std::vector<std::string> roots;
  for (const json& root : glb.document["scenes"][0]["nodes"]) roots.push_back(nodes[root.get<std::size_t>()]["name"]);
  EXPECT_EQ(roots, (std::vector<std::string>{"Armature", "Body", "Armature-3", "Body-3"}));
  // Each person's channels move nodes of that person's skin.
  std::array<int, 2> channels{};
  for (const json& channel : glb.document["animations"][0]["channels"]) {
    const json node = channel["target"]["node"];
    for (std::size_t k = 0; k < 2; ++k) {
      const json& joints = glb.document["skins"][k]["joints"];
      channels[k] += std::find(joints.begin(), joints.end(), node) != joints.end() ? 1 : 0;
    }
  }
  EXPECT_GT(channels[0], 10);
  EXPECT_EQ(channels[0], channels[1]);
}

}  // namespace
}  // namespace depthmocap
