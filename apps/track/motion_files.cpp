#include "apps/track/motion_files.h"

#include <string>

#include "apps/track/animation_files.h"
#include "apps/track/laboratory_files.h"
#include "depthmocap/error.h"

namespace depthmocap {
namespace {

bool asksForLaboratory(const TrackOptions& o) {
  return !(o.trc.empty() && o.c3d.empty() && o.mot.empty());
}

bool asksForAnimation(const TrackOptions& o) {
  return !(o.bvh.empty() && o.gltf.empty() && o.usd.empty());
}

std::string firstFile(const TrackOptions& o) {
  for (const auto& path : {o.bvh, o.gltf, o.usd, o.trc, o.c3d, o.mot}) {
    if (!path.empty()) return path.string();
  }
  return {};
}

}  // namespace

MotionFiles::MotionFiles(const TrackOptions& options, double fps)
    : options_(options),
      fps_(fps),
      pending_(asksForAnimation(options) || asksForLaboratory(options)),
      laboratory_(asksForLaboratory(options)) {}

void MotionFiles::add(std::span<const TrackedFrame* const> people) {
  if (pending_) motion_.add(people, laboratory_);
}

void MotionFiles::write() {
  if (!pending_) return;
  pending_ = false;
  std::vector<const CollectedMotion::Person*> people;
  std::vector<MotionTrack> tracks;
  for (const CollectedMotion::Person& person : motion_.people) {
    if (person.motion.empty()) continue;
    people.push_back(&person);
    tracks.push_back(person.motion.track(person.lengths));
  }
  if (tracks.empty()) throw Error("nobody was tracked, so there is no motion to write", firstFile(options_));
  const Eigen::Vector3d origin = options_.origin == "floor" ? moveToFloor(tracks) : Eigen::Vector3d::Zero();
  if (asksForAnimation(options_)) writeAnimationFiles(options_, motion_, people, tracks, fps_);
  if (laboratory_) writeLaboratoryFiles(options_, motion_, origin, fps_);
}

}  // namespace depthmocap
