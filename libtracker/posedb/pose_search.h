#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "libtracker/core/marker_set.h"
#include "libtracker/posedb/pose_database.h"
#include "libtracker/skeleton/marker_model.h"

namespace depthmocap {

// Parameters of the search distance, equation (3).
struct PoseSearchConfig {
  double alpha = 0.75;      // weight of the marker distance
  double beta = 0.25;       // weight of the change of pose
  double sigma_m = 0.05;    // [m] of the Lorentzian
  int candidates = 512;     // [poses] proposed by the FLANN index for the exact distance (>= neighbours)
  int checks = 1024;        // [leaves] FLANN looks at
  int trees = 4;            // of the randomised kd-forest
  std::uint32_t seed = 1;   // of the kd-forest
  void validate() const;    // throws Error naming field, value and rule
};

// What is searched for.
struct PoseQuery {
  MarkerSet markers;              // world frame (y up)
  bool has_history = false;       // whether the two poses before are known
  Pose q_prev = Pose::Zero();     // q_-1
  Pose q_prev2 = Pose::Zero();    // q_-2
  double heading = 0;             // [rad] rough heading of the actor, used where has_history; else tried all around
};

struct PoseNeighbour {
  std::uint32_t index = 0;  // in the database
  double distance = 0;      // equation (3)
};

// Finds the nearest database poses to a set of markers. The database's markers a_n are computed once for a skeleton and a
// marker model. Thread-compatible; search() does not allocate after its first calls.
class PoseSearch {
 public:
  PoseSearch(const PoseDatabase& database, const Skeleton& skeleton, const MarkerModel& markers,
             const PoseSearchConfig& config);
  ~PoseSearch();
  PoseSearch(PoseSearch&&) noexcept;

  // The `count` nearest poses, nearest first, ties by index: FLANN candidates ordered by the exact distance (3).
  void search(const PoseQuery& query, int count, std::vector<PoseNeighbour>& neighbours);
  // The same over all poses: the reference that search() is measured against.
  void searchExhaustive(const PoseQuery& query, int count, std::vector<PoseNeighbour>& neighbours);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
