#pragma once
#include <Eigen/Core>
#include <optional>

#include "depthmocap/actor.h"
#include "depthmocap/marker_set.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {

// Where legs are that nobody can see: below a trunk that stands or sits, whichever the height above the floor and what
// is seen of the legs speak for. Beyond the paper, whose actor is always in view.
class HiddenLegs {
 public:
  // Of the present frame. `cut_below`: the actor's lower end is not in view; `floor_world`: n.p + d = 0, n up [m].
  void look(bool cut_below, const std::optional<Eigen::Vector4d>& floor_world);

  // The seen markers; where the lower end is not in view, with a weak one for each part of the legs that is not seen.
  const MarkerSet& complete(const MarkerSet& seen_world, const Actor& actor);
  [[nodiscard]] bool supposed() const { return cut_below_; }

 private:
  struct Guess;
  static bool isStray(const MarkerSet& seen, int part, const Guess& stands, const Guess& sits);
  Guess suppose(const Pose& posture, const MarkerSet& trunk, const MarkerSet& seen, const Actor& actor);

  bool cut_below_ = false;
  std::optional<double> floor_y_;  // [m] world
  MarkerSet markers_;
  ForwardKinematics fk_;
};

}  // namespace depthmocap
