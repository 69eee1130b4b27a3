#pragma once
#include <Eigen/Core>

#include "depthmocap/joints.h"
#include "libtracker/segment/identity.h"

namespace depthmocap {

// Where the surface of somebody may be whose pose is expected: around the lines between the joints.
class ExpectedBody {
 public:
  ExpectedBody(Identity who, const JointPositions& p_camera);  // [m] camera

  [[nodiscard]] Identity who() const { return who_; }
  // [m] Of a point in the camera's frame from the nearest line; the greatest number where no surface can be.
  [[nodiscard]] float distance(const Eigen::Vector3f& p) const;
  // Whether the point may lie on the body: nearer to a line than flesh and clothes reach there.
  [[nodiscard]] bool explains(const Eigen::Vector3f& p) const;

  static constexpr float kFarthest_m = 0.20F;  // that a surface is from the lines

 private:
  [[nodiscard]] bool isNear(const Eigen::Vector3f& p) const;

  Identity who_;
  Eigen::Matrix<float, 3, kJointCount> joints_;  // [m] camera
  Eigen::Vector3f low_, high_;                   // [m] what the surface lies within
};

}  // namespace depthmocap
