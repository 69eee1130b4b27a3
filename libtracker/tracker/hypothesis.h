#pragma once
#include <optional>

#include "libtracker/core/facing.h"
#include "libtracker/match/surface_matcher.h"
#include "libtracker/solve/map_solver.h"
#include "libtracker/tracker/body_adapter.h"

namespace depthmocap {

// What one frame says of the actor's size.
struct ObservedSize {
  double scale = 1;      // over that of the body in use
  bool is_sure = false;  // of somebody whole and upright
};

// A pose that explains some evidence.
struct Hypothesis {
  Pose q = Pose::Zero();  // world
  MapSummary summary;     // of the last solve
  // [0, 2] What q leaves unexplained of the image; see DenseRefinement::misfit.
  std::optional<double> misfit;
  Matching matching = Matching::ByParts;  // found by distance alone: its markers do not judge it
  bool fresh = false;                     // from a search over all poses, not from the frame before: it has no velocity
  NormalEquations evidence;               // what the image says of q; see MapSolver::expandEvidence
  // Of a pose from one image alone: the body with the size that was found with it.
  std::optional<BodyAdapter> body;
  Facing facing = Facing::Front;     // the side that the pose was found for, and
  double cost = 0;                   // [energy] against the poses of other sides
  std::optional<ObservedSize> size;  // of the body; set while it is being fitted, as is
  std::optional<ShapeEvidence> shape;
};

}  // namespace depthmocap
