#pragma once
#include <array>
#include <string>
#include <vector>

#include "depthmocap/joints.h"
#include "libtracker/motion/bone_names.h"
#include "libtracker/motion/source_motion.h"
#include "libtracker/skeleton/motion_clip.h"

namespace depthmocap {

// Distance between the source's joints and ours after the fit [m], over all frames.
struct RetargetResiduals {
  std::array<double, kJointCount> mean_m{};
  std::array<double, kJointCount> max_m{};
  [[nodiscard]] double mean() const;  // [m] over all joints
};

struct RetargetResult {
  MotionClip clip;
  std::vector<JointPositions> source_joints;  // [m] of each frame, in the clip's world: the source's, not the fit's
  RetargetResiduals residuals;
  double beyond_limits = 0;  // share of the frames with a joint clearly beyond its limits
  std::vector<std::string> warnings;
};

// Fits the 36 DoF to every frame of a motion on any human skeleton (in the spirit of Gleicher 1998): bone lengths from
// the rest pose, then per frame least squares on the 18 joints and the axes of kFitAxes by Levenberg-Marquardt, started
// from the frame before. DoFs are continuous in time, except that a body upside down changes the sign of its tilt
// (root_rx, root_rz stay within pi). The motion must have frames and
// a standing rest pose (withStandingRest); `where` names the file in Errors.
RetargetResult retarget(const SourceMotion& motion, const NamedBones& named, double metres_per_unit,
                        const std::string& where);

}  // namespace depthmocap
