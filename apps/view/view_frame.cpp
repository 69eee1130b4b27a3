#include "apps/view/view_frame.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "libtracker/body/pose_surface.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "messages are little-endian");

constexpr int kMaxWidth = 320;  // [px] of the pictures in a message
constexpr double kMillimetres = 1000.0;

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

void addPose(json& head, const TrackedFrame& tracked) {
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

}  // namespace

ViewFrameEncoder::ViewFrameEncoder(const CameraModel& camera)
    : camera_(camera), step_(std::max(1, (camera.width + kMaxWidth - 1) / kMaxWidth)) {}

std::string ViewFrameEncoder::head(const TrackedFrame& tracked, const ViewFigures& figures) {
  const bool lost = tracked.state == TrackState::Lost;
  if (!lost) floor_y_ = floor_.update(makeSkeleton(tracked.lengths), tracked.q, tracked.time_s).y();
  const int width = camera_.width / step_;
  const int height = camera_.height / step_;
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
  head["image"] = {{"width", width},   {"height", height}, {"step", step_},   {"fx", camera_.fx},
                   {"fy", camera_.fy}, {"cx", camera_.cx}, {"cy", camera_.cy}};
  const Eigen::Quaterniond turn(tracked.R_world_camera * uprightWorldFromCamera().transpose());
  head["image"]["turn"] = {turn.x(), turn.y(), turn.z(), turn.w()};
  if (!lost) addPose(head, tracked);
  if (figures.playback) {
    const Playback& p = *figures.playback;
    head["playback"] = {
        {"index", p.index}, {"tracked", p.tracked}, {"total", p.total}, {"playing", p.playing}, {"speed", p.speed}};
  }
  return head.dump();
}

std::string ViewFrameEncoder::encode(const DepthImage& depth, const PartImage& labels, const TrackedFrame& tracked,
                                     const ViewFigures& figures) {
  std::string text = head(tracked, figures);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const int width = camera_.width / step_;
  const int height = camera_.height / step_;
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const auto length = static_cast<std::uint32_t>(text.size());
  std::string message(sizeof length + text.size() + 3 * pixels, '\0');
  std::memcpy(message.data(), &length, sizeof length);
  std::memcpy(message.data() + sizeof length, text.data(), text.size());
  char* depths = message.data() + sizeof length + text.size();
  char* parts = depths + 2 * pixels;
  const bool has_labels = labels.width == depth.width && labels.height == depth.height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float mm = depth.at(x * step_, y * step_) * static_cast<float>(kMillimetres);
      const auto value = static_cast<std::uint16_t>(std::clamp(mm + 0.5F, 0.0F, 65535.0F));
      std::memcpy(depths, &value, sizeof value);
      depths += sizeof value;
      *parts++ = static_cast<char>(has_labels ? labels.at(x * step_, y * step_) : 0);
    }
  }
  return message;
}

}  // namespace depthmocap
