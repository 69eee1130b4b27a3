#pragma once
#include <vector>

#include "libtracker/ik/ik_solver.h"
#include "libtracker/repair/marker_site.h"

namespace depthmocap {

// A body with markers on it. Marker i is its site on this body, moved by its offset.
struct MarkerBody {
  struct Marker {
    std::size_t track = 0;  // index of the marker in its file
    MarkerSite site;
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // [m] from the site, in the bone's frame
  };
  Skeleton skeleton = makeSkeleton(BoneLengths{});
  std::vector<Marker> markers;

  [[nodiscard]] BonePoint point(std::size_t marker) const;
};

// What was seen of a body at one instant: places [m] (world, y up) of some of its markers.
struct MarkerView {
  std::vector<std::size_t> markers;  // indices into MarkerBody::markers
  std::vector<Eigen::Vector3d> p;

  [[nodiscard]] bool empty() const { return markers.empty(); }
};

// The view as targets of inverse kinematics, all of weight 1.
PointTargets viewTargets(const MarkerBody& body, const MarkerView& view);

// How large the body is against body.skeleton, from distances of markers on one bone and on neighbouring ones.
double roughScale(const MarkerBody& body, const std::vector<MarkerView>& views);

// Fits bone lengths, markers' offsets and the poses of all views at once: Gauss-Newton on distances of markers over
// 20 mm, bone lengths about those of a scaled average body, offsets over the deviation of their site, and the prior.
// poses: where to start, one a view; then the result.
void fitMarkerBody(MarkerBody& body, const std::vector<MarkerView>& views, const PosePrior* prior,
                   std::vector<Pose>& poses);

}  // namespace depthmocap
