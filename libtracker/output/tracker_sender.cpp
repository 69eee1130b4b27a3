#include "libtracker/output/tracker_sender.h"

#include <fmt/format.h>

#include "libtracker/output/floor_origin.h"
#include "libtracker/output/osc_target.h"
#include "libtracker/output/vr_trackers.h"

namespace depthmocap {
namespace {

void addTriple(lo_bundle bundle, std::string_view tracker, const char* what, const Eigen::Vector3d& values) {
  const lo_message message = lo_message_new();
  for (const double value : values) lo_message_add_float(message, static_cast<float>(value));
  lo_bundle_add_message(bundle, fmt::format("/tracking/trackers/{}/{}", tracker, what).c_str(), message);
}

}  // namespace

struct TrackerSender::Impl {
  explicit Impl(const std::string& named) : target("--osc-trackers", named) {}
  OscTarget target;
  FloorOrigin floor;
};

TrackerSender::TrackerSender(const std::string& target) : impl_(std::make_unique<Impl>(target)) {}

TrackerSender::~TrackerSender() = default;
TrackerSender::TrackerSender(TrackerSender&&) noexcept = default;

void TrackerSender::send(double time_s, TrackState state, const BoneLengths& lengths, const Pose& q) {
  if (state == TrackState::Lost) return;
  const Skeleton skeleton = makeSkeleton(lengths);
  const auto trackers = vrTrackers(skeleton, q, impl_->floor.update(skeleton, q, time_s));
  const lo_bundle bundle = lo_bundle_new(LO_TT_IMMEDIATE);
  for (std::size_t i = 0; i < trackers.size(); ++i) {
    addTriple(bundle, kVrTrackerNames[i], "position", trackers[i].position);
    addTriple(bundle, kVrTrackerNames[i], "rotation", trackers[i].euler_deg);
  }
  impl_->target.send(bundle);
}

}  // namespace depthmocap
