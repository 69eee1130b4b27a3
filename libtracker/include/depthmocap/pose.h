#pragma once
#include <Eigen/Core>
#include <array>
#include <string_view>

namespace depthmocap {

// The pose q in R^36 (Su, Chai, Xia 2016, section 2.2) in the order of that paper. Translations [m], rotations [rad].
//
// Zero pose: a T-pose, y up, facing +z, the actor's left along +x; every bone frame is parallel to the world there.
// 3-DoF joints are a swing (a rotation vector without component along the bone) and a twist about the bone, so that the
// twist of a straight limb, which depth cannot show, is one number by itself, and the only singular pose is the bone
// turned by 180 degrees, which no joint reaches. See joint rotations in forward_kinematics.h.
enum Dof : int {
  kRootTx,
  kRootTy,
  kRootTz,
  kRootRx,  // tilt: rotation vector (rx, 0, rz) in the frame after heading
  kRootRy,  // heading about the world's y, applied last (outermost)
  kRootRz,
  kUpperbackRx,  // swing (rx, 0, rz) after the twist ry about the spine
  kUpperbackRy,
  kUpperbackRz,
  kRclavicleRy,  // swing (0, ry, rz)
  kRclavicleRz,
  kLclavicleRy,
  kLclavicleRz,
  kRhumerusRx,  // twist about the arm; swing (0, ry, rz)
  kRhumerusRy,
  kRhumerusRz,
  kLhumerusRx,
  kLhumerusRy,
  kLhumerusRz,
  kRradiusRy,  // elbow flexion: positive right, negative left bend the forearm forward from the T-pose
  kLradiusRy,
  kNeckRx,  // swing (rx, 0, rz)
  kNeckRz,
  kHeadRy,    // turn of the head
  kRfemurRx,  // swing (rx, 0, rz); twist ry about the leg
  kRfemurRy,
  kRfemurRz,
  kLfemurRx,
  kLfemurRy,
  kLfemurRz,
  kRtibiaRx,  // knee flexion, positive
  kLtibiaRx,
  kRfootRx,  // swing (rx, ry, 0): rx > 0 points the toes down, ry turns them
  kRfootRy,
  kLfootRx,
  kLfootRy,
};

inline constexpr int kDofCount = 36;
inline constexpr int kFirstRotationDof = kRootRx;
inline constexpr int kFirstBodyDof = kUpperbackRx;  // DoFs from here on do not depend on where the actor stands

using Pose = Eigen::Matrix<double, kDofCount, 1>;

inline constexpr std::array<std::string_view, kDofCount> kDofNames = {
    "root_tx",      "root_ty",      "root_tz",      "root_rx",      "root_ry",      "root_rz",
    "upperback_rx", "upperback_ry", "upperback_rz", "rclavicle_ry", "rclavicle_rz", "lclavicle_ry",
    "lclavicle_rz", "rhumerus_rx",  "rhumerus_ry",  "rhumerus_rz",  "lhumerus_rx",  "lhumerus_ry",
    "lhumerus_rz",  "rradius_ry",   "lradius_ry",   "neck_rx",      "neck_rz",      "head_ry",
    "rfemur_rx",    "rfemur_ry",    "rfemur_rz",    "lfemur_rx",    "lfemur_ry",    "lfemur_rz",
    "rtibia_rx",    "ltibia_rx",    "rfoot_rx",     "rfoot_ry",     "lfoot_rx",     "lfoot_ry"};

}  // namespace depthmocap
