#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>

#include "libtracker/skeleton/floor_height.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/solve/contact_term.h"

namespace depthmocap {

// Which points of the feet stand on the floor, from the solved poses: those near it that hardly move over a few frames.
// A point that stands is expected where it was put down; the place follows the poses slowly, and a point that the
// solver brings away from it, or off the floor, has been lifted.
class FootWatch {
 public:
  // A solved pose. `floor_world`: n.p + d = 0, n up, if it is seen; else the lowest sole tells it, slowly.
  void observe(const Skeleton& skeleton, const Pose& q, double time_s,
               const std::optional<Eigen::Vector4d>& floor_world);
  // After a loss, a new first pose, or a turn of the world: nothing stands.
  void reset();
  // For the next solve.
  [[nodiscard]] const FootContacts& contacts() const { return contacts_; }

 private:
  static constexpr int kFrames = 4;  // over which the speed is measured
  struct Place {
    double time_s = 0;
    Eigen::Vector3d p_world = Eigen::Vector3d::Zero();
  };
  struct Track {
    std::array<Place, kFrames> last{};  // newest first
    int seen = 0;                       // of those
    void add(const Place& place);
    [[nodiscard]] bool rests() const;
  };
  static void putDownOrLift(Track& track, double height_m, double dt_s, FootContact& contact);

  std::array<Track, kFootPointCount> tracks_;
  FootContacts contacts_;
  FloorHeight floor_height_;
  double time_s_ = 0;
};

}  // namespace depthmocap
