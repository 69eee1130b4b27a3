#include "apps/track/animation_files.h"

#include <fmt/format.h>

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
      floor_origin_(options.origin == "floor"),
      bvh_moving_(options.bvh_moving),
      bvh_scale_(options.bvh_unit == "cm" ? kCentimetres : 1.0),
      fps_(fps) {}

void AnimationFiles::add(std::span<const TrackedFrame* const> people) {
  if (bvh_.empty() && gltf_.empty()) return;
  people_.resize(people.size());
  for (std::size_t i = 0; i < people.size(); ++i) {
    const TrackedFrame& tracked = *people[i];
    Person& person = people_[i];
    person.number = tracked.person;
    person.lengths = tracked.lengths;
    if (tracked.state == TrackState::Lost) {
      person.motion.addLost(tracked.time_s);
    } else {
      person.motion.add(tracked.time_s, tracked.q, tracked.lengths);
    }
  }
}

void AnimationFiles::write() {
  if (bvh_.empty() && gltf_.empty()) return;
  std::vector<int> numbers;
  std::vector<MotionTrack> tracks;
  for (const Person& person : people_) {
    if (person.motion.empty()) continue;
    numbers.push_back(person.number);
    tracks.push_back(person.motion.track(person.lengths));
  }
  if (tracks.empty()) {
    throw Error("nobody was tracked, so there is no motion to write", (bvh_.empty() ? gltf_ : bvh_).string());
  }
  if (floor_origin_) moveToFloor(tracks);
  std::vector<GltfPerson> found;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (!bvh_.empty()) writeBvh(bvhOf(numbers[i]), tracks[i]);
    if (!gltf_.empty()) found.push_back({numbers[i], makeBuiltinBody(tracks[i].lengths), tracks[i]});
  }
  if (!gltf_.empty()) writeGltf(gltf_, found);
  bvh_.clear();
  gltf_.clear();
}

std::filesystem::path AnimationFiles::bvhOf(int number) const {
  if (people_.size() == 1) return bvh_;
  return bvh_.parent_path() / fmt::format("{}-{}{}", bvh_.stem().string(), number, bvh_.extension().string());
}

void AnimationFiles::writeBvh(const std::filesystem::path& path, const MotionTrack& track) const {
  const bool moving = track.sizeChanges() && bvh_moving_;
  BvhWriter writer(path, makeSkeleton(track.lengths), 1.0 / track.frameTime_s(fps_), bvh_scale_, moving);
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
