#pragma once
#include <vector>

#include "libtracker/output/rig_nodes.h"

namespace depthmocap {

// A rig that carries a body's skin.
class SkinRig : public RigNodes {
 public:
  SkinRig(const BodySurface& body, RigStyle style);

  // The skin [m] in the rest pose with the hips at the origin.
  [[nodiscard]] const std::vector<Eigen::Vector3f>& vertices() const { return vertices_; }

 private:
  std::vector<Eigen::Vector3f> vertices_;
};

}  // namespace depthmocap
