#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "depthmocap/ik_result.h"
#include "depthmocap/joint_targets.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// The targets of one pose as a file holds them.
struct PoseTargets {
  std::string id;  // as in the file
  JointTargets targets;
};

// Reads `pose_id,joint,x,y,z` [m], y up; rows of one pose_id need not stand together. Poses in the order in which their
// ids first appear. Error with file and line: wrong columns, an unknown joint, a joint twice in one pose, what is no
// number, coordinates that cannot be a person's (JointTargets::add); and for a file without any target.
std::vector<PoseTargets> readTargetsFile(const std::filesystem::path& path);

// Writes solved poses: `pose_id,time_s,state`, the joints as in a joints file but in the targets' frame (y up), then
// the 36 degrees of freedom and `residual_m`. `time_s` counts the rows, `state` is `tracking`, a joint's confidence 1
// where it had a target and 0 elsewhere. Whole or not at all.
void writeSolvedPoses(const std::vector<PoseTargets>& poses, const std::vector<IkResult>& results,
                      const Skeleton& skeleton, const std::filesystem::path& path);

}  // namespace depthmocap
