#include "apps/track/collected_motion.h"

#include <fmt/format.h>

namespace depthmocap {
namespace {

CollectedMotion::Sample sampleOf(const TrackedFrame& tracked, OpenSimReader& open_sim) {
  CollectedMotion::Sample sample;
  sample.frame = tracked.frame;
  sample.time_s = tracked.time_s;
  sample.seen = tracked.state != TrackState::Lost;
  if (!sample.seen) return sample;
  sample.joints_world = tracked.R_world_camera * tracked.joints_camera;
  ForwardKinematics fk;
  fk.update(makeSkeleton(tracked.lengths), tracked.q);
  sample.coordinates = open_sim.read(fk, tracked.lengths.hip_width, Eigen::Vector3d::Zero());
  return sample;
}

}  // namespace

void CollectedMotion::add(std::span<const TrackedFrame* const> frame, bool with_samples) {
  people.resize(frame.size());
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const TrackedFrame& tracked = *frame[i];
    Person& person = people[i];
    person.number = tracked.person;
    person.lengths = tracked.lengths;
    if (tracked.state == TrackState::Lost) {
      person.motion.addLost(tracked.time_s);
    } else {
      person.motion.add(tracked.time_s, tracked.q, tracked.lengths);
    }
    if (with_samples) person.samples.push_back(sampleOf(tracked, person.open_sim));
  }
}

std::filesystem::path CollectedMotion::pathOf(const std::filesystem::path& path, const Person& person) const {
  if (people.size() == 1) return path;
  return path.parent_path() / fmt::format("{}-{}{}", path.stem().string(), person.number, path.extension().string());
}

}  // namespace depthmocap
