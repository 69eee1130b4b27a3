#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "depthmocap/marker_set.h"
#include "libtracker/core/config_fields.h"
#include "libtracker/posedb/pose_database.h"
#include "libtracker/skeleton/marker_model.h"

namespace depthmocap {

// Parameters of the search distance, equation (3), and of the index that proposes candidates for it.
struct PoseSearchConfig {
  double alpha = 0.75;             // (>= 0) weight of the marker distance
  double beta = 0.25;              // (>= 0) weight of the change of pose
  double sigma_m = 0.05;           // [m] (> 0) of the Lorentzian
  bool upright_alignment = false;  // R(a_n, a~) turns about the vertical only, beyond the paper; else any rotation
  int candidates = 512;            // [poses] (>= 1) proposed by the FLANN index for the exact distance
  int features = 16;               // (1 .. 30) principal components of the markers that the index holds
  std::vector<ConfigField> fields();
  void validate() const;  // throws Error naming field, value and rule
};

// The markers and the history to search for.
struct PoseQuery {
  MarkerSet markers;            // world frame (y up)
  bool has_history = false;     // whether the two poses before are known
  Pose q_prev = Pose::Zero();   // q_-1
  Pose q_prev2 = Pose::Zero();  // q_-2
  double heading = 0;  // [rad] rough heading of the actor, a start where has_history; else all directions are tried
  double scale = 1.0;  // (> 0) size of the actor over the size of the search's skeleton
};

struct PoseNeighbour {
  std::uint32_t index = 0;  // in the database
  double distance = 0;      // equation (3)
};

// Finds the nearest database poses to a set of markers.
//
// The distance (3) is confidence-weighted and summed over the seen markers, as the paper sums: with c_i the confidences
// and R, t the rigid motion that best aligns the seen markers (c_i-weighted least squares),
//   d = alpha * sum_i c_i rho(|a_n,i - R a~_i - t|) + beta * || q_n - 2 q_-1 + q_-2 ||^2
// where the pose term runs over kShapeDofs (neither place nor heading) and is left out without history. Distances of
// one query compare; those of queries with other markers do not.
//
// Candidates come from a FLANN kd-tree over the first principal components of the database's marker shapes, each turned
// by the best rotation onto their mean, as the exact distance turns them. The query's components are the posterior mean
// of a Gaussian with the database's covariance, given the seen markers and an unknown rigid motion; so markers that are
// missing are filled in by regression. The rough heading, where there is history, or else all directions, are tried as
// a start; if two different rotations explain the markers, each proposes half of the candidates.
//
// Thread-compatible. Our own code does not allocate after the first search; FLANN allocates a vector of `features`
// floats.
class PoseSearch {
 public:
  // Computes the database's markers a_n for this skeleton. The database must not be empty and must outlive the search.
  PoseSearch(const PoseDatabase& database, const Skeleton& skeleton, const MarkerModel& markers,
             const PoseSearchConfig& config);
  ~PoseSearch();
  PoseSearch(PoseSearch&&) noexcept;

  // The `count` nearest poses, nearest first, ties by index: FLANN candidates ordered by the exact distance (3). Fewer
  // if fewer are proposed. With fewer than 3 seen markers only the pose term orders candidates well.
  void search(const PoseQuery& query, int count, std::vector<PoseNeighbour>& neighbours);
  // The same over all poses: the reference that search() is measured against.
  void searchExhaustive(const PoseQuery& query, int count, std::vector<PoseNeighbour>& neighbours);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
