#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "libtracker/core/parts.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/surface_model.h"
#include "libtracker/solve/surface_match.h"

namespace depthmocap {

// A measured point of the actor with the parts that it may belong to.
struct SurfaceSample {
  Eigen::Vector3f p_world = Eigen::Vector3f::Zero();  // [m]
  std::array<float, kPartCount> probability{};        // of each part
};

struct SurfaceMatchConfig {
  double max_distance_m = 0.15;   // [m] (> 0) a sample further from its surface point has no match
  double match_sigma_m = 0.06;    // [m] (> 0) how far the surface is expected from a sample of its part
  double min_probability = 0.02;  // (0, 1] no part is held less likely: the classifier may be wrong
  double sigma_m = 0.03;          // [m] (> 0) of the Lorentzian that weighs a match by its distance
  void validate() const;
};

// Pairs each measured point with the surface point that faces the camera (the origin of the world) and is the most
// likely by its distance and by the sample's part probabilities. One object in a loop allocates nothing after its first
// calls.
class SurfaceMatcher {
 public:
  explicit SurfaceMatcher(const SurfaceMatchConfig& config);

  // `fk`: the present pose; `scale`: size of the actor over the size of the surface model.
  void match(const SurfaceModel& surface, double scale, const ForwardKinematics& fk,
             const std::vector<SurfaceSample>& samples, SurfaceMatches& matches);

 private:
  struct Placed {
    Eigen::Vector3f p_world;
    Eigen::Vector3f n_world;
    std::uint32_t index = 0;  // in the part
  };
  void place(const SurfaceModel& surface, double scale, const ForwardKinematics& fk);

  SurfaceMatchConfig config_;
  std::array<std::vector<Placed>, kPartCount> placed_;
};

}  // namespace depthmocap
