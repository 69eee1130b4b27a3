#pragma once
#include <optional>
#include <string_view>

#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// Where a marker sits on any body, roughly.
struct MarkerSite {
  Bone bone = Bone::Root;
  double along = 0;                                  // share of the way from the bone's origin to its end
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // [m] from there, in the bone's frame
  double deviation_m = 0.02;                         // [m] (> 0) of the true place in each coordinate
};

// The site as a point of this body.
BonePoint sitePoint(const MarkerSite& site, const Skeleton& skeleton);

// The site of a marker or joint with this name: the joints of a joints file, those of MotionBuilder and Mixamo, and the
// markers of the Plug-in Gait and Helen Hayes sets; case, blanks, punctuation and a subject's name before a colon do
// not matter. Nothing if the name is not known.
std::optional<MarkerSite> siteNamed(std::string_view name);

}  // namespace depthmocap
