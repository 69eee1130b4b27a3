#pragma once
#include "libtracker/solve/contact_term.h"
#include "libtracker/solve/limit_term.h"
#include "libtracker/solve/map_solver.h"
#include "libtracker/solve/marker_term.h"
#include "libtracker/solve/prior_term.h"
#include "libtracker/solve/smooth_term.h"
#include "libtracker/solve/surface_term.h"

namespace depthmocap {

// Equation (5): the sum of its terms, and their quadratic model.
class MapEnergy {
 public:
  MapEnergy(const MapInput& input, const MapConfig& config);

  [[nodiscard]] double at(const Pose& q);
  // About the pose of the last at(), whose energy is `energy`.
  void expand(double energy, NormalEquations& equations);
  // Energies and marker distance at q; iterations and converged stay as they are.
  void summarise(const Pose& q, MapSummary& summary);

 private:
  const MapConfig& config_;
  const Skeleton& skeleton_;
  MarkerTerm marker_;
  PriorTerm prior_;
  SmoothTerm smooth_;
  LimitTerm limit_;
  SurfaceTerm surface_;
  ContactTerm contact_;
  Pose q_ = Pose::Zero();  // of the last at(), and its frames
  ForwardKinematics fk_;
  TwistEquations twists_;
};

}  // namespace depthmocap
