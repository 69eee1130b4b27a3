#pragma once
#include <vector>

#include "depthmocap/actor.h"
#include "libtracker/posedb/pose_search.h"
#include "libtracker/prior/local_prior_builder.h"
#include "libtracker/prior/prior_config.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/solve/map_solver.h"

namespace depthmocap {

// Finds a pose from one frame's markers alone: database search without the smoothness terms, several starting poses,
// the best energy wins (method section A, equation (5), first frame).
class GlobalSearch {
 public:
  struct Result {
    Pose q = Pose::Zero();
    MapSummary summary;
    bool found = false;
  };
  // `neighbours`: poses to ask the database for; `starts`: how many of them, spread out, to solve from.
  GlobalSearch(int neighbours, int starts) : neighbour_count_(neighbours), start_count_(starts) {}

  const Result& find(const MarkerSet& markers_world, double scale, const Actor& actor, const PoseDatabase& database,
                     PoseSearch& search, LocalPriorBuilder& prior_builder, MapSolver& solver);

  // The local model of the last find().
  [[nodiscard]] const LocalPrior& prior() const { return prior_; }

 private:
  void chooseStarts(const PoseDatabase& database);

  int neighbour_count_;
  int start_count_;
  std::vector<PoseNeighbour> neighbours_;
  std::vector<std::uint32_t> starts_;
  LocalPrior prior_;
  ForwardKinematics fk_;
  Result result_;
};

}  // namespace depthmocap
