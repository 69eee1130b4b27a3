#include "apps/track/animation_files.h"

#include "depthmocap/error.h"
#include "libtracker/body/builtin_body.h"
#include "libtracker/motion/bvh_writer.h"
#include "libtracker/output/gltf.h"

namespace depthmocap {
namespace {

constexpr double kCentimetres = 100.0;

}  // namespace

AnimationFiles::AnimationFiles(const TrackOptions& options, double fps)
    : bvh_(options.bvh),
      gltf_(options.gltf),
      bvh_rigid_(options.bvh_rigid),
      bvh_scale_(options.bvh_unit == "cm" ? kCentimetres : 1.0),
      fps_(fps) {}

void AnimationFiles::add(const TrackedFrame& tracked) {
  if (bvh_.empty() && gltf_.empty()) return;
  if (tracked.state == TrackState::Lost) {
    motion_.addLost(tracked.time_s);
  } else {
    motion_.add(tracked.time_s, tracked.q, tracked.lengths);
  }
}

void AnimationFiles::write(const BoneLengths& lengths) {
  if (bvh_.empty() && gltf_.empty()) return;
  if (motion_.empty()) {
    throw Error("nobody was tracked, so there is no motion to write", (bvh_.empty() ? gltf_ : bvh_).string());
  }
  const MotionTrack track = motion_.track(lengths);
  if (!bvh_.empty()) writeBvh(track);
  if (!gltf_.empty()) writeGltf(gltf_, makeBuiltinBody(track.lengths), track);
  bvh_.clear();
  gltf_.clear();
}

void AnimationFiles::writeBvh(const MotionTrack& track) const {
  const bool moving = track.sizeChanges() && !bvh_rigid_;
  BvhWriter writer(bvh_, makeSkeleton(track.lengths), 1.0 / track.frameTime_s(fps_), bvh_scale_, moving);
  for (const MotionTrack::Frame& frame : track.frames) {
    if (moving) {
      writer.write(frame.q, makeSkeleton(track.lengths.scaled(frame.scale)));
    } else {
      writer.write(frame.q);
    }
  }
  writer.finish();
}

}  // namespace depthmocap
