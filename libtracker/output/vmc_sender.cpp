#include "libtracker/output/vmc_sender.h"

#include <optional>
#include <string>

#include "libtracker/output/floor_origin.h"
#include "libtracker/output/osc_target.h"
#include "libtracker/output/vmc_bones.h"

namespace depthmocap {
namespace {

// States that /VMC/Ext/OK tells.
constexpr int kLoaded = 1;
constexpr int kCalibrated = 3;
constexpr int kNormalMode = 0;
constexpr std::size_t kUpperBodyBones = 12;  // in the first bundle

void addPose(lo_bundle bundle, const char* path, std::string_view name, const VmcBone& bone) {
  const Eigen::Vector3f p = bone.position.cast<float>();
  const Eigen::Quaternionf r = bone.rotation.cast<float>();
  const lo_message message = lo_message_new();
  lo_message_add_string(message, std::string(name).c_str());
  for (const float value : {p.x(), p.y(), p.z(), r.x(), r.y(), r.z(), r.w()}) lo_message_add_float(message, value);
  lo_bundle_add_message(bundle, path, message);
}

void addState(lo_bundle bundle, TrackState state, double time_s) {
  const lo_message ok = lo_message_new();
  const int tracking = state == TrackState::Lost ? 0 : 1;
  for (const int value : {kLoaded, kCalibrated, kNormalMode, tracking}) lo_message_add_int32(ok, value);
  lo_bundle_add_message(bundle, "/VMC/Ext/OK", ok);
  const lo_message time = lo_message_new();
  lo_message_add_float(time, static_cast<float>(time_s));
  lo_bundle_add_message(bundle, "/VMC/Ext/T", time);
}

}  // namespace

struct VmcSender::Impl {
  explicit Impl(const std::string& named) : target("--vmc", named) {}
  OscTarget target;
  FloorOrigin floor;
  std::optional<double> start_s;
};

VmcSender::VmcSender(const std::string& target) : impl_(std::make_unique<Impl>(target)) {}

VmcSender::~VmcSender() = default;
VmcSender::VmcSender(VmcSender&&) noexcept = default;

void VmcSender::send(double time_s, TrackState state, const BoneLengths& lengths, const Pose& q) {
  Impl& s = *impl_;
  if (!s.start_s) s.start_s = time_s;
  const lo_bundle upper = lo_bundle_new(LO_TT_IMMEDIATE);
  addState(upper, state, time_s - *s.start_s);
  if (state == TrackState::Lost) {
    s.target.send(upper);
    return;
  }
  const Skeleton skeleton = makeSkeleton(lengths);
  const auto bones = vmcBones(skeleton, q, s.floor.update(skeleton, q, time_s));
  addPose(upper, "/VMC/Ext/Root/Pos", "root", VmcBone{});
  const lo_bundle lower = lo_bundle_new(LO_TT_IMMEDIATE);
  for (std::size_t i = 0; i < bones.size(); ++i) {
    addPose(i < kUpperBodyBones ? upper : lower, "/VMC/Ext/Bone/Pos", kVmcBoneNames[i], bones[i]);
  }
  s.target.send(upper);
  s.target.send(lower);
}

}  // namespace depthmocap
