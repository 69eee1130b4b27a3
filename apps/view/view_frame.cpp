#include "apps/view/view_frame.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "depthmocap/world_frame.h"
#include "libtracker/body/pose_surface.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "messages are little-endian");

constexpr int kMaxWidth = 320;  // [px] of the pictures in a message
constexpr float kMillimetres = 1000.0F;

double rounded(double value, double steps) {
  return std::round(value * steps) / steps;
}

json point(const Eigen::Vector3d& p) {
  return {rounded(p.x(), 1e4), rounded(p.y(), 1e4), rounded(p.z(), 1e4)};
}

json times(const StageTimes& ms) {
  const auto value = [](double t) { return rounded(t, 100); };
  return {{"segment", value(ms.segment)}, {"classify", value(ms.classify)}, {"markers", value(ms.markers)},
          {"prior", value(ms.prior)},     {"solve", value(ms.solve)},       {"total", value(ms.total)}};
}

// x y z w of every skin bone in its parent, in the order of the nodes of /body.glb.
json rotations(const Pose& q) {
  json list = json::array();
  const auto add = [&](const Eigen::Matrix3d& R) {
    const Eigen::Vector4d r = Eigen::Quaterniond(R).normalized().coeffs();
    list.push_back({rounded(r[0], 1e5), rounded(r[1], 1e5), rounded(r[2], 1e5), rounded(r[3], 1e5)});
  };
  for (int b = 0; b < kBoneCount; ++b) add(localRotation(static_cast<Bone>(b), q));
  for (const TwistBone& limb : kTwistBones) {
    add(localRotation(limb.bone, q) *
        Eigen::AngleAxisd(-q[limb.twist], Eigen::Vector3d::Unit(limb.axis)).toRotationMatrix());
  }
  return list;
}

// Nothing of somebody who is lost.
void addPose(json& head, const TrackedFrame& tracked) {
  if (tracked.state == TrackState::Lost) return;
  json joints = json::array();
  json confidence = json::array();
  for (int j = 0; j < kJointCount; ++j) {
    joints.push_back(point(tracked.R_world_camera * tracked.joints_camera.col(j)));
    confidence.push_back(rounded(tracked.confidence[j], 100));
  }
  head["joints"] = joints;
  head["confidence"] = confidence;
  head["root"] = point(tracked.q.head<3>());
  head["rotations"] = rotations(tracked.q);
}

json markers(const MarkerSet& markers_camera, const Eigen::Matrix3d& R_world_camera) {
  json list = json::array();
  for (int m = 0; m < kPartCount; ++m) {
    if (!markers_camera.seen(m)) continue;
    const json p = point(R_world_camera * markers_camera.position.col(m));
    list.push_back({m + 1, p[0], p[1], p[2], rounded(markers_camera.confidence[m], 100)});
  }
  return list;
}

// What stands in a frame for each of several people.
json personIn(const TrackedFrame& tracked) {
  json person = {{"person", tracked.person},
                 {"state", trackStateName(tracked.state)},
                 {"stature_m", rounded(tracked.stature_m, 1e4)},
                 {"markers", markers(tracked.markers_camera, tracked.R_world_camera)}};
  addPose(person, tracked);
  return person;
}

// Those who are there.
json peopleIn(std::span<const TrackedFrame> people) {
  json list = json::array();
  for (const TrackedFrame& tracked : people) {
    if (tracked.state != TrackState::Lost) list.push_back(personIn(tracked));
  }
  return list;
}

}  // namespace

ViewFrameEncoder::ViewFrameEncoder(const CameraModel& camera)
    : camera_(camera),
      step_(std::max(1, (camera.width + kMaxWidth - 1) / kMaxWidth)),
      width_(camera.width / step_),
      height_(camera.height / step_) {}

// Under the first who is there.
void ViewFrameEncoder::followFloor(std::span<const TrackedFrame> people) {
  const auto there = [](const TrackedFrame& person) { return person.state != TrackState::Lost; };
  const auto first = std::ranges::find_if(people, there);
  if (first == people.end()) return;
  floor_y_ = floor_.update(makeSkeleton(first->lengths), first->q, first->time_s).y();
}

std::string ViewFrameEncoder::head(std::span<const TrackedFrame> people, const ViewFigures& figures) {
  followFloor(people);
  const TrackedFrame& tracked = people.front();
  json head = {{"type", "frame"},
               {"frame", tracked.frame},
               {"time_s", rounded(tracked.time_s, 1e6)},
               {"state", trackStateName(tracked.state)},
               {"reinitialised", tracked.reinitialised},
               {"fps", rounded(figures.fps, 10)},
               {"latency_ms", rounded(figures.latency_ms, 10)},
               {"clients", figures.clients},
               {"recording", figures.recording},
               {"ms", times(tracked.ms)},
               {"markers", markers(tracked.markers_camera, tracked.R_world_camera)},
               {"stature_m", rounded(tracked.stature_m, 1e4)},
               {"floor_y", rounded(floor_y_, 1e4)}};
  head["image"] = {{"width", width_},  {"height", height_}, {"step", step_},   {"fx", camera_.fx},
                   {"fy", camera_.fy}, {"cx", camera_.cx},  {"cy", camera_.cy}};
  const Eigen::Quaterniond turn(tracked.R_world_camera * uprightWorldFromCamera().transpose());
  head["image"]["turn"] = {turn.x(), turn.y(), turn.z(), turn.w()};
  addPose(head, tracked);
  if (people.size() > 1) head["people"] = peopleIn(people);
  if (figures.playback) {
    const Playback& p = *figures.playback;
    head["playback"] = {
        {"index", p.index}, {"tracked", p.tracked}, {"total", p.total}, {"playing", p.playing}, {"speed", p.speed}};
  }
  return head.dump();
}

void ViewFrameEncoder::pick(const DepthImage& depth, const PartImage& labels, ViewPicture& picture) const {
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  picture.depth_mm.resize(pixels);
  picture.labels.assign(pixels, 0);
  const bool has_labels = labels.width == depth.width && labels.height == depth.height;
  std::uint16_t* mm = picture.depth_mm.data();
  std::uint8_t* parts = picture.labels.data();
  for (int y = 0; y < height_; ++y) {
    const float* depth_row = &depth.at(0, y * step_);
    const std::uint8_t* label_row = has_labels ? &labels.at(0, y * step_) : nullptr;
    for (int x = 0; x < width_; ++x) {
      *mm++ = static_cast<std::uint16_t>(std::min(depth_row[x * step_] * kMillimetres + 0.5F, 65535.0F));
    }
    for (int x = 0; has_labels && x < width_; ++x) *parts++ = label_row[x * step_];
  }
}

std::string ViewFrameEncoder::encode(const ViewPicture& picture, std::span<const TrackedFrame> people,
                                     const ViewFigures& figures) {
  std::string text = head(people, figures);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto length = static_cast<std::uint32_t>(text.size());
  std::string message;
  message.reserve(sizeof length + text.size() + 3 * picture.labels.size());
  message.append(reinterpret_cast<const char*>(&length), sizeof length);
  message += text;
  message.append(reinterpret_cast<const char*>(picture.depth_mm.data()), 2 * picture.depth_mm.size());
  message.append(reinterpret_cast<const char*>(picture.labels.data()), picture.labels.size());
  return message;
}

}  // namespace depthmocap
