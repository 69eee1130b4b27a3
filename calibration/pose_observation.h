#pragma once
#include <Eigen/Core>
#include <vector>

#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"
#include "depthmocap/marker_set.h"
#include "depthmocap/parts.h"
#include "depthmocap/pose.h"
#include "libtracker/actor/body_template.h"
#include "libtracker/core/classified_pixels.h"

namespace depthmocap {

// What one frame says about the body, in the camera's upright world [m]; the camera is its origin.

// A measured surface point.
struct CloudPoint {
  Eigen::Vector3f p_world = Eigen::Vector3f::Zero();
  std::array<float, kPartCount> probability{};
};

// Where one part ends and the next begins along a limb: the plane of all p with direction . p = offset.
struct PartBoundary {
  enum class Place { LeftElbow, RightElbow, LeftArm, RightArm, LeftKnee, RightKnee, Waist } place = Place::LeftElbow;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  // unit, along the limb
  double offset = 0;
};

// A plane that touches the body from outside: the line of sight past its outline, or the floor. direction . p <= offset
// for all points of `part`, with equality at the outermost.
struct BodyEnd {
  Part part = Part::Head;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitY();  // unit, outwards
  double offset = 0;
};

struct PoseObservation {
  std::vector<CloudPoint> cloud;  // at most some hundreds, as many of each part as there are
  MarkerSet markers_world;
  std::vector<PartBoundary> boundaries;
  std::vector<BodyEnd> ends;
  Pose q = Pose::Zero();               // about this pose; the solve starts here
  Pose deviation = Pose::Constant(1);  // how sure: of each DoF [m or rad]; 0 = not at all
  double weight = 1;                   // (> 0) against the other observations
};

// All classified pixels as points.
std::vector<CloudPoint> cloudOf(const ClassifiedPixels& pixels, const CameraModel& camera);
// About `per_part` points of each part, spread evenly.
std::vector<CloudPoint> thinned(const std::vector<CloudPoint>& cloud, int per_part);
// The points that are most probably of this part.
std::vector<Eigen::Vector3f> pointsOf(const std::vector<CloudPoint>& cloud, Part part);

// The boundaries that a T-pose shows; `left` (unit) points along the arms, `up` along the trunk and the legs.
std::vector<PartBoundary> tposeBoundaries(const std::vector<CloudPoint>& cloud, const Eigen::Vector3d& left,
                                          const Eigen::Vector3d& up);
// Crown, hands and soles by the outline of the mask; the floor [plane in the world] instead of the outline of the feet
// where it is known, for there the mask ends early.
std::vector<BodyEnd> tposeEnds(const MaskImage& mask, const CameraModel& camera, const MarkerSet& markers_world,
                               const Eigen::Vector4d* floor_world);

}  // namespace depthmocap
