#pragma once
#include "libtracker/solve/contact_term.h"
#include "libtracker/solve/limit_term.h"
#include "libtracker/solve/map_solver.h"
#include "libtracker/solve/marker_term.h"
#include "libtracker/solve/prior_term.h"
#include "libtracker/solve/smooth_term.h"
#include "libtracker/solve/surface_term.h"

namespace depthmocap {

// The stacked residuals of equation (5), in the form that ceres::TinySolver takes. The sum of their squares is the
// energy.
class MapFunction {
 public:
  using Scalar = double;
  // Names and kind as TinySolver wants them.
  enum {
    NUM_RESIDUALS = MarkerTerm::kRows + PriorTerm::kRows + SmoothTerm::kRows + LimitTerm::kRows + SurfaceTerm::kRows +
                    ContactTerm::kRows,
    NUM_PARAMETERS = kDofCount
  };

  MapFunction(const MapInput& input, const MapConfig& config);

  // parameters: q; residuals: NUM_RESIDUALS; jacobian: column-major NUM_RESIDUALS x NUM_PARAMETERS or nullptr.
  bool operator()(const double* parameters, double* residuals, double* jacobian) const;
  // Energies and marker distance at q; iterations and converged stay as they are.
  void summarise(const Pose& q, MapSummary& summary) const;

 private:
  const MapConfig& config_;
  mutable MarkerTerm marker_;  // holds working memory
  PriorTerm prior_;
  SmoothTerm smooth_;
  LimitTerm limit_;
  mutable SurfaceTerm surface_;
  mutable ContactTerm contact_;
};

}  // namespace depthmocap
