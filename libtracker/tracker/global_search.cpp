#include "libtracker/tracker/global_search.h"

#include <algorithm>

#include "libtracker/tracker/alignment.h"

namespace depthmocap {
namespace {

constexpr double kStartSpread_rad = 1.0;  // norm of the difference of two starting poses, at least

}  // namespace

void GlobalSearch::chooseStarts(const PoseDatabase& database) {
  starts_.clear();
  for (const PoseNeighbour& neighbour : neighbours_) {
    if (static_cast<int>(starts_.size()) == start_count_) return;
    const bool is_new = std::all_of(starts_.begin(), starts_.end(), [&](std::uint32_t start) {
      return (database.poses[neighbour.index] - database.poses[start]).norm() > kStartSpread_rad;
    });
    if (is_new) starts_.push_back(neighbour.index);
  }
}

const GlobalSearch::Result& GlobalSearch::find(const MarkerSet& markers_world, double scale, const Actor& actor,
                                               const PoseDatabase& database, PoseSearch& search,
                                               LocalPriorBuilder& prior_builder, MapSolver& solver) {
  result_.found = false;
  PoseQuery query;
  query.markers = markers_world;
  query.scale = scale;
  search.search(query, neighbour_count_, neighbours_);
  chooseStarts(database);
  prior_builder.build(database, neighbours_, prior_);
  for (std::uint32_t start : starts_) {
    Pose q = placedAt(actor, database.pose(start), markers_world, fk_);
    const MapInput input{actor.skeleton, actor.markers, markers_world, &prior_, nullptr, nullptr};
    const MapSummary summary = solver.solve(input, q);
    if (result_.found && summary.energy >= result_.summary.energy) continue;
    result_ = {q, summary, true};
  }
  return result_;
}

}  // namespace depthmocap
