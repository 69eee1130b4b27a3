#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"
#include "depthmocap/parts.h"

namespace depthmocap {

using Triangle = std::array<std::uint32_t, 3>;

// A triangle surface in world coordinates. `part` is one per triangle, or empty where nothing is part of a person.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;  // [m]
  std::vector<Triangle> triangles;        // counter-clockwise from outside
  std::vector<std::uint8_t> part;         // Part
};

// Optional outputs in addition to depth and parts.
struct RenderOptions {
  bool incidence = false;
  // Position [m] in the camera frame of the sensor's light source; set = compute `lit`.
  std::optional<Eigen::Vector3d> p_camera_projector;
};

// One noise-free picture. Images all have the camera's size.
struct RenderedView {
  DepthImage depth;  // [m] along the optical axis; 0 = nothing hit
  PartImage parts;   // Part; 0 for background
  Image<float>
      incidence;  // |cos| between the ray and the surface normal (0, 1]; 0 = nothing hit. Empty unless asked for
  MaskImage lit;  // 1 where the projector sees the surface point too. Empty unless asked for
  // Pixels outside this box [x0, x1) x [y0, y1) are empty.
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// Casts one ray through each pixel centre at triangle meshes. Keeps its acceleration structures between calls, so use
// one object per thread. Depth is computed from the plane of the triangle that was hit, in double precision: it does
// not depend on the vector unit of the machine.
class DepthRenderer {
 public:
  DepthRenderer();
  ~DepthRenderer();
  DepthRenderer(DepthRenderer&&) noexcept;

  // The moving surface, in world coordinates [m]; `part` one per triangle. The spans need not outlive the call.
  // Cheapest if `triangles` is what it was at the call before (one actor, many poses).
  void setBody(std::span<const Eigen::Vector3f> vertices, std::span<const Triangle> triangles,
               std::span<const std::uint8_t> part);
  // What stands around it; an empty mesh removes it.
  void setBackground(const TriangleMesh& mesh);

  // T_camera_world takes world to camera coordinates. Reuses the memory of `view`.
  void render(const CameraModel& camera, const Eigen::Isometry3d& T_camera_world, const RenderOptions& options,
              RenderedView& view);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
