#pragma once
#include <optional>

namespace depthmocap {

// The height of the floor where none is seen: that of the lower sole, followed slowly, because without knowledge of
// gravity the floor of a tilted camera rises or falls with the distance; a jump hardly moves it.
class FloorHeight {
 public:
  // sole_y: world y [m] of the lowest sole; times must grow. The floor's y [m].
  double follow(double sole_y, double time_s);

 private:
  std::optional<double> y_;
  double time_s_ = 0;
};

}  // namespace depthmocap
