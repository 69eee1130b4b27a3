#pragma once
#include <array>
#include <vector>

#include "depthmocap/joints.h"
#include "libtracker/motion/bone_roles.h"
#include "libtracker/motion/source_motion.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// A direction rigid with one of our bones that a motion file also shows.
struct BoneAxis {
  Bone bone;
  int axis;        // of the bone's frame: 0 x, 1 y, 2 z
  double lever_m;  // [m] what an error of 1 rad counts in the fit
};

// What is compared beside the joints: the pelvis' pitch, the thorax' and the head's left, and the axis of elbow or
// knee, which fixes the twist of the limb above whether it is bent or straight.
inline constexpr std::array<BoneAxis, 7> kFitAxes = {{{Bone::Root, 2, 0.10},
                                                      {Bone::UpperBack, 0, 0.15},
                                                      {Bone::Head, 0, 0.05},
                                                      {Bone::RightHumerus, 1, 0.04},
                                                      {Bone::LeftHumerus, 1, 0.04},
                                                      {Bone::RightFemur, 0, 0.06},
                                                      {Bone::LeftFemur, 0, 0.06}}};

// One frame of the source in our terms: world y up, metres.
struct FitTargets {
  JointPositions joints;
  std::array<Eigen::Vector3d, kFitAxes.size()> axes;  // unit
};

// How a motion file's skeleton corresponds to ours. The rest pose of the file gives the performer's bone lengths and
// which direction of each bone is ours; a constant lean of its neck, head or pelvis bones is thereby no rotation in q.
// Where the file does not say about which axis elbows and knees turn, the motion does.
class RestCalibration {
 public:
  // metres_per_unit of the motion's lengths. The motion's frames are used for moving offsets and hinge axes. `where`
  // names the file in Errors.
  RestCalibration(const SourceMotion& motion, const NamedBones& named, double metres_per_unit,
                  const std::string& where);

  [[nodiscard]] const BoneLengths& lengths() const { return lengths_; }
  void targets(const GlobalFrame& frame, FitTargets& targets) const;

 private:
  struct AxisSource {
    int bone = 0;
    Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  // in the bone's frame
  };
  void measure(const GlobalFrame& rest, const RestTrunk& trunk);
  void mapJoints(const GlobalFrame& rest, const RestTrunk& trunk);
  void mapAxes(const SourceMotion& motion, const GlobalFrame& rest, const RestTrunk& trunk);

  double metres_per_unit_;
  BoneRoles roles_;
  BoneLengths lengths_;
  Eigen::Matrix3d R_ours_source_ = Eigen::Matrix3d::Identity();  // makes the file's up axis y
  std::array<SourcePoint, kJointCount> joints_;
  std::array<AxisSource, kFitAxes.size()> axes_;
};

}  // namespace depthmocap
