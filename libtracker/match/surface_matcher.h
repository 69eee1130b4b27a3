#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "depthmocap/parts.h"
#include "libtracker/core/config_fields.h"
#include "libtracker/match/placed_surface.h"
#include "libtracker/skeleton/surface_match.h"

namespace depthmocap {

// A measured point of the actor with the parts that it may belong to.
struct SurfaceSample {
  Eigen::Vector3f p_world = Eigen::Vector3f::Zero();  // [m]
  std::array<float, kPartCount> probability{};        // of each part
};

// What decides which point of the surface a measured point belongs to: the distance and the parts that the classifier
// sees, or the distance alone.
enum class Matching { ByParts, ByDistance };

struct SurfaceMatchConfig {
  double max_distance_m = 0.30;   // [m] (> 0) a sample further from its surface point has no match
  double match_sigma_m = 0.04;    // [m] (> 0) how far the surface is expected from a sample of its part
  double min_probability = 0.02;  // (0, 1] no part is held less likely: the classifier may be wrong
  double sigma_m = 0.02;          // [m] (> 0) of the Lorentzian that weighs a match by its distance
  int max_matches = 450;          // (1 .. kMaxSurfaceMatches)
  std::vector<ConfigField> fields();
  void validate() const;  // throws Error naming field, value and rule
};

// Pairs each measured point with the point of the placed surface that is the most likely by its distance and by the
// sample's part probabilities. One object in a loop allocates nothing after its first calls.
class SurfaceMatcher {
 public:
  explicit SurfaceMatcher(const SurfaceMatchConfig& config);

  // The frame. At most max_matches of the samples are looked at, spread evenly.
  void observe(const std::vector<SurfaceSample>& samples, Matching matching);
  void match(const PlacedSurface& placed, SurfaceMatches& matches) const;
  // [0, 1] What the body leaves unexplained: the mean over the samples of the squared distance to its surface, of any
  // part, over reach_m [m]; 1 from there on.
  [[nodiscard]] double unexplained(const PlacedSurface& placed, double reach_m) const;

 private:
  struct Sample {
    Eigen::Vector3f p_world;  // [m]
    PartDoubts doubts;
  };

  SurfaceMatchConfig config_;
  std::vector<Sample> samples_;
};

}  // namespace depthmocap
