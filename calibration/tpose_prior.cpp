#include "calibration/tpose_prior.h"

#include <cmath>
#include <utility>

namespace depthmocap {
namespace {

constexpr double kChestDepth_m = 0.10;  // of the spine behind the body's surface
constexpr double kStraight = 0.03;      // [rad] deviation of a joint that people can hold straight
constexpr double kLoose = 0.12;

// Standard deviations [rad] of the right side and the middle.
constexpr std::pair<Dof, double> kDeviations[] = {
    {kUpperbackRx, 0.06},   {kUpperbackRy, 0.05},  {kUpperbackRz, 0.04}, {kRclavicleRy, 0.06},    {kRclavicleRz, 0.08},
    {kRhumerusRx, 0.10},    {kRhumerusRy, 0.20},   {kRhumerusRz, 0.20},  {kRradiusRy, kStraight}, {kNeckRx, kLoose},
    {kNeckRz, 0.06},        {kHeadRy, kLoose},     {kRfemurRx, kLoose},  {kRfemurRy, kLoose},     {kRfemurRz, 0.20},
    {kRtibiaRx, kStraight}, {kRfootRx, kStraight}, {kRfootRy, 0.20},
};

}  // namespace

void setTPosePrior(const BoneLengths& lengths, const BodyOutline& outline, PoseObservation& observation) {
  Pose& q = observation.q;
  q.setZero();
  const double head_y = lengths.torso + 1.7 * lengths.neck_to_head;  // crown above the root, as statureOf has it
  q[kRootTx] = outline.middle_x;
  q[kRootTy] = outline.top - head_y;
  q[kRootTz] = -outline.distance - kChestDepth_m;
  const Eigen::Vector3d span = outline.left_hand - outline.right_hand;
  q[kRootRy] = -std::atan2(span.z(), span.x());
  Pose& deviation = observation.deviation;
  deviation.setZero();
  for (const auto& [dof, value] : kDeviations) deviation[dof] = value;
  for (const auto& [right, left, count] :
       {std::array{int{kRclavicleRy}, int{kLclavicleRy}, 2}, std::array{int{kRhumerusRx}, int{kLhumerusRx}, 3},
        std::array{int{kRradiusRy}, int{kLradiusRy}, 1}, std::array{int{kRfemurRx}, int{kLfemurRx}, 3},
        std::array{int{kRtibiaRx}, int{kLtibiaRx}, 1}, std::array{int{kRfootRx}, int{kLfootRx}, 2}}) {
    for (int i = 0; i < count; ++i) deviation[left + i] = deviation[right + i];
  }
}

}  // namespace depthmocap
