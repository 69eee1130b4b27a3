#include "libtracker/output/skin_rig.h"

#include "libtracker/body/pose_surface.h"

namespace depthmocap {

SkinRig::SkinRig(const BodySurface& body, RigStyle style) : RigNodes(style, body.skeleton), vertices_(body.vertices) {
  if (!rig().rest().isZero(0)) poseSurface(body, rig().rest(), vertices_);
}

}  // namespace depthmocap
