#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "depthmocap/ik_result.h"
#include "depthmocap/joint_targets.h"
#include "libtracker/ik/image_term.h"
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

// The joints of one pose in a picture as a file holds them.
struct PoseImageTargets {
  std::string id;
  ImageTargets targets;
};

// Which way v grows in a file of orthographic targets: as its joints say, heads above feet.
enum class VAxis { Auto, Up, Down };

// Reads `pose_id,joint,u,v` with an optional column `weight` (0: as if the row were not there). v is turned up for
// Projection::Orthographic. Errors as readTargetsFile, for a weight below 0, and for a pose with fewer than
// kLeastImageTargets.
std::vector<PoseImageTargets> readImageTargetsFile(const std::filesystem::path& path, Projection projection,
                                                   VAxis v_axis);

// A solved pose as a row of a file.
struct SolvedPose {
  std::string id;
  std::array<bool, kJointCount> given{};  // joints that had a target
  IkResult result;
  double time_s = 0;
};

// Writes solved poses: `pose_id,time_s,state`, the joints as in a joints file but in the targets' frame (y up), then
// the 36 degrees of freedom and `residual_m`. `state` is `tracking`, a joint's confidence 1 where it had a target and 0
// elsewhere. Whole or not at all.
void writeSolvedPoses(const std::vector<SolvedPose>& poses, const Skeleton& skeleton,
                      const std::filesystem::path& path);

}  // namespace depthmocap
