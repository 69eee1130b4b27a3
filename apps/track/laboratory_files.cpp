#include "apps/track/laboratory_files.h"

#include <functional>

#include "libtracker/marker_files/marker_files.h"

namespace depthmocap {
namespace {

using Samples = std::vector<CollectedMotion::Sample>;

// Our world in a laboratory's of C3D files: z up, the zero pose faces x.
Eigen::Vector3d laboratoryPoint(const Eigen::Vector3d& p_world) {
  return {p_world.z(), p_world.x(), p_world.y()};
}

// Joint centres as markers named like the joints; `place` turns our world into the file's.
MarkerSequence markersOf(const Samples& samples, double fps, const Eigen::Vector3d& origin,
                         const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& place) {
  MarkerSequence markers;
  for (const CollectedMotion::Sample& sample : samples) {
    markers.frame.push_back(sample.frame);
    markers.time_s.push_back(sample.time_s);
  }
  const double length_s = samples.back().time_s - samples.front().time_s;
  markers.fps = length_s > 0 ? static_cast<double>(samples.size() - 1) / length_s : fps;
  markers.addTracks({kJointNames.begin(), kJointNames.end()});
  for (int joint = 0; joint < kJointCount; ++joint) {
    MarkerTrack& track = markers.tracks[static_cast<std::size_t>(joint)];
    for (std::size_t t = 0; t < samples.size(); ++t) {
      const auto column = static_cast<Eigen::Index>(t);
      track.seen[column] = samples[t].seen;
      if (samples[t].seen) track.p.col(column) = place(samples[t].joints_world.col(joint) - origin);
    }
  }
  return markers;
}

// Frames in which the person was lost have no row.
std::vector<OpenSimRow> openSimRows(const Samples& samples, const Eigen::Vector3d& origin) {
  constexpr int kPelvisTx = 3;
  std::vector<OpenSimRow> rows;
  for (const CollectedMotion::Sample& sample : samples) {
    if (!sample.seen) continue;
    rows.push_back({sample.time_s, sample.coordinates});
    rows.back().values.segment<3>(kPelvisTx) -= openSimPoint(origin);
  }
  return rows;
}

}  // namespace

void writeLaboratoryFiles(const TrackOptions& o, const CollectedMotion& motion, const Eigen::Vector3d& origin,
                          double fps) {
  for (const CollectedMotion::Person& person : motion.people) {
    if (person.motion.empty()) continue;
    const Samples& samples = person.samples;
    if (!o.trc.empty()) writeTrc(markersOf(samples, fps, origin, openSimPoint), motion.pathOf(o.trc, person));
    if (!o.c3d.empty()) writeC3d(markersOf(samples, fps, origin, laboratoryPoint), motion.pathOf(o.c3d, person));
    if (!o.mot.empty()) writeMot(openSimRows(samples, origin), motion.pathOf(o.mot, person));
  }
}

}  // namespace depthmocap
