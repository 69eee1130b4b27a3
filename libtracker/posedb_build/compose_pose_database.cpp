#include "libtracker/posedb_build/compose_pose_database.h"

#include <utility>

#include <fmt/format.h>

namespace depthmocap {
namespace {

std::string originOf(const PoseDatabaseSources& s, const PoseDatabaseConfig& config) {
  std::string origin = fmt::format("{} captured and {} procedural motions", s.captured, s.clips.size() - s.captured);
  if (s.procedural) origin += fmt::format(" (seed {})", s.seed);
  if (!s.mixture.components.empty()) {
    origin += fmt::format(", {} samples of a pose mixture (seed {})", s.sample_count, s.seed);
  }
  if (!s.excluded.empty()) origin += fmt::format(", without {}", fmt::join(s.excluded, " "));
  return origin + fmt::format(", threshold {} m, mirror {}", config.threshold_m, config.mirror ? "on" : "off");
}

void addSamples(const PoseDatabaseSources& s, PoseDatabase& database) {
  PoseDatabase::Source source{"samples", static_cast<std::uint32_t>(database.size()), 0};
  for (auto& q : samplePoses(s.mixture, s.sample_count, s.seed)) {
    q[kRootTx] = q[kRootTy] = q[kRootTz] = q[kRootRy] = 0;
    database.poses.push_back(q);
    ++source.count;
  }
  database.sources.push_back(source);
}

}  // namespace

PoseDatabaseResult composePoseDatabase(const PoseDatabaseSources& sources, const PoseDatabaseConfig& config) {
  PoseDatabaseResult result = buildPoseDatabase(sources.clips, config);
  result.database.origin = originOf(sources, config);
  if (!sources.mixture.components.empty()) addSamples(sources, result.database);
  return result;
}

}  // namespace depthmocap
