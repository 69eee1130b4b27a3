#include "forest/render/depth_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <embree3/rtcore.h>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

constexpr float kNearest_m = 0.05F;  // surfaces nearer than this to the camera's plane are not seen
// Rays are handed to Embree in square tiles, so that the rays of one call take the same way through the tree.
constexpr int kTile_px = 16;
constexpr std::size_t kTileRays = static_cast<std::size_t>(kTile_px) * kTile_px;
// A ray to the projector starts this far off the surface, so that it does not hit its own triangle.
constexpr double kShadowStart_m = 0.004;

struct PixelBox {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// The pixels that a set of points can cover; everything if a point is behind the camera's near plane.
PixelBox coveredPixels(const CameraModel& camera, const Eigen::Isometry3d& T_camera_world,
                       std::span<const Eigen::Vector3f> vertices) {
  const PixelBox whole{0, 0, camera.width, camera.height};
  if (vertices.empty()) return {};
  const Eigen::Matrix3d R = T_camera_world.linear();
  const Eigen::Vector3d t = T_camera_world.translation();
  constexpr double inf = std::numeric_limits<double>::infinity();
  Eigen::Array2d low(inf, inf);
  Eigen::Array2d high(-inf, -inf);
  bool any_before = false;
  bool any_behind = false;
  for (const Eigen::Vector3f& v : vertices) {
    const Eigen::Vector3d p = R * v.cast<double>() + t;
    (p.z() > kNearest_m ? any_before : any_behind) = true;
    if (p.z() <= kNearest_m) continue;
    const Eigen::Array2d uv = camera.project(p).array();
    low = low.min(uv);
    high = high.max(uv);
  }
  if (!any_before) return {};
  if (any_behind) return whole;
  const auto clamp = [](double value, int limit) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
  };
  return {clamp(std::floor(low.x()), camera.width), clamp(std::floor(low.y()), camera.height),
          clamp(std::ceil(high.x()) + 1, camera.width), clamp(std::ceil(high.y()) + 1, camera.height)};
}

// One geometry of the Embree scene with our own copy of its triangles.
struct Surface {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> part;
  RTCGeometry geometry = nullptr;
  unsigned id = RTC_INVALID_GEOMETRY_ID;
};

void setRay(RTCRay& ray, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  ray.org_x = static_cast<float>(origin.x());
  ray.org_y = static_cast<float>(origin.y());
  ray.org_z = static_cast<float>(origin.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.time = 0.0F;
  ray.mask = ~0U;
  ray.flags = 0;
}

}  // namespace

struct DepthRenderer::Impl {
  Impl() {
    device = rtcNewDevice("threads=1,user_threads=0");
    if (device == nullptr) throw Error("Embree does not start", "depth renderer");
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST));
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
  }
  ~Impl() {
    remove(body);
    remove(background);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void remove(Surface& surface) {
    if (surface.geometry == nullptr) return;
    rtcDetachGeometry(scene, surface.id);
    rtcReleaseGeometry(surface.geometry);
    surface = {};
  }

  void set(Surface& surface, std::span<const Eigen::Vector3f> vertices, std::span<const Triangle> triangles,
           std::span<const std::uint8_t> part, RTCBuildQuality quality) {
    const bool same_topology = surface.geometry != nullptr && surface.vertices.size() == vertices.size() &&
                               std::ranges::equal(surface.triangles, triangles);
    if (!same_topology) remove(surface);
    surface.vertices.assign(vertices.begin(), vertices.end());
    surface.part.assign(part.begin(), part.end());
    if (triangles.empty()) return;
    if (!same_topology) {
      surface.triangles.assign(triangles.begin(), triangles.end());
      add(surface, quality);
    }
    auto* target = static_cast<float*>(rtcGetGeometryBufferData(surface.geometry, RTC_BUFFER_TYPE_VERTEX, 0));
    std::copy_n(surface.vertices.front().data(), 3 * surface.vertices.size(), target);
    rtcUpdateGeometryBuffer(surface.geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(surface.geometry);
  }

  void add(Surface& surface, RTCBuildQuality quality) {
    surface.geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(surface.geometry, quality);
    // The vertex buffer belongs to Embree, which pads it for its 16-byte loads.
    rtcSetNewGeometryBuffer(surface.geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Eigen::Vector3f),
                            surface.vertices.size());
    void* indices = rtcSetNewGeometryBuffer(surface.geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(Triangle), surface.triangles.size());
    std::memcpy(indices, surface.triangles.data(), surface.triangles.size() * sizeof(Triangle));
    surface.id = rtcAttachGeometry(scene, surface.geometry);
  }

  void castTile(const CameraModel& camera, const PixelBox& tile, const RenderOptions& options, RenderedView& view);
  void shade(std::size_t pixel, const RTCRayHit& ray, const RenderOptions& options, RenderedView& view) const;
  void castShadows(const CameraModel& camera, const PixelBox& tile, RenderedView& view);

  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  Surface body;
  Surface background;

  // Of the picture being rendered, in the world.
  Eigen::Matrix3d R_world_camera = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_world_camera = Eigen::Vector3d::Zero();
  Eigen::Vector3d p_world_projector = Eigen::Vector3d::Zero();
  std::array<RTCRayHit, kTileRays> rays;
  std::array<RTCRay, kTileRays> shadow_rays;
};

DepthRenderer::DepthRenderer() : impl_(std::make_unique<Impl>()) {}
DepthRenderer::~DepthRenderer() = default;
DepthRenderer::DepthRenderer(DepthRenderer&&) noexcept = default;

void DepthRenderer::setBody(std::span<const Eigen::Vector3f> vertices, std::span<const Triangle> triangles,
                            std::span<const std::uint8_t> part) {
  DMC_CHECK(part.size() == triangles.size());
  impl_->set(impl_->body, vertices, triangles, part, RTC_BUILD_QUALITY_LOW);
}

void DepthRenderer::setBackground(const TriangleMesh& mesh) {
  DMC_CHECK(mesh.part.empty() || mesh.part.size() == mesh.triangles.size());
  impl_->set(impl_->background, mesh.vertices, mesh.triangles, mesh.part, RTC_BUILD_QUALITY_MEDIUM);
}

void DepthRenderer::render(const CameraModel& camera, const Eigen::Isometry3d& T_camera_world,
                           const RenderOptions& options, RenderedView& view) {
  view.depth.reset(camera.width, camera.height, 0.0F);
  view.parts.reset(camera.width, camera.height, 0);
  if (options.incidence) view.incidence.reset(camera.width, camera.height, 0.0F);
  if (options.p_camera_projector) view.lit.reset(camera.width, camera.height, 0);

  const Eigen::Isometry3d T_world_camera = T_camera_world.inverse();
  impl_->R_world_camera = T_world_camera.linear();
  impl_->p_world_camera = T_world_camera.translation();
  if (options.p_camera_projector) impl_->p_world_projector = T_world_camera * *options.p_camera_projector;
  rtcCommitScene(impl_->scene);

  const PixelBox box = impl_->background.geometry != nullptr
                           ? PixelBox{0, 0, camera.width, camera.height}
                           : coveredPixels(camera, T_camera_world, impl_->body.vertices);
  view.x0 = box.x0, view.y0 = box.y0, view.x1 = box.x1, view.y1 = box.y1;
  for (int y = box.y0; y < box.y1; y += kTile_px) {
    for (int x = box.x0; x < box.x1; x += kTile_px) {
      impl_->castTile(camera, {x, y, std::min(x + kTile_px, box.x1), std::min(y + kTile_px, box.y1)}, options, view);
    }
  }
}

void DepthRenderer::Impl::castTile(const CameraModel& camera, const PixelBox& tile, const RenderOptions& options,
                                   RenderedView& view) {
  unsigned count = 0;
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x) {
      RTCRayHit& r = rays[count++];
      // 1 m along the optical axis: the ray's parameter is the depth.
      setRay(r.ray, p_world_camera, R_world_camera * camera.unproject(x, y, 1.0));
      r.ray.tnear = kNearest_m;
      r.ray.tfar = std::numeric_limits<float>::infinity();
      r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    }
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect1M(scene, &context, rays.data(), count, sizeof(RTCRayHit));

  std::size_t i = 0;
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x, ++i) {
      if (rays[i].hit.geomID != RTC_INVALID_GEOMETRY_ID) shade(view.depth.index(x, y), rays[i], options, view);
    }
  }
  if (options.p_camera_projector) castShadows(camera, tile, view);
}

void DepthRenderer::Impl::shade(std::size_t pixel, const RTCRayHit& ray, const RenderOptions& options,
                                RenderedView& view) const {
  const Surface& surface = ray.hit.geomID == body.id ? body : background;
  const Triangle& triangle = surface.triangles[ray.hit.primID];
  std::array<Eigen::Vector3d, 3> corner;
  for (std::size_t k = 0; k < 3; ++k) corner[k] = surface.vertices[triangle[k]].cast<double>() - p_world_camera;
  const Eigen::Vector3d normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const Eigen::Vector3d direction(ray.ray.dir_x, ray.ray.dir_y, ray.ray.dir_z);
  // A triangle seen from its edge has no stable plane: its corners bound the depth.
  const Eigen::Vector3d axis = R_world_camera.col(2);
  const auto [nearest, farthest] = std::minmax({axis.dot(corner[0]), axis.dot(corner[1]), axis.dot(corner[2])});
  const double slope = normal.dot(direction);
  const double depth = slope != 0.0 ? normal.dot(corner[0]) / slope : nearest;
  view.depth.data[pixel] = static_cast<float>(std::clamp(depth, nearest, farthest));
  if (!surface.part.empty()) view.parts.data[pixel] = surface.part[ray.hit.primID];
  if (!options.incidence) return;
  const double scale = normal.norm() * direction.norm();
  view.incidence.data[pixel] = static_cast<float>(std::max(1e-3, scale > 0.0 ? std::abs(slope) / scale : 0.0));
}

void DepthRenderer::Impl::castShadows(const CameraModel& camera, const PixelBox& tile, RenderedView& view) {
  std::array<std::size_t, kTileRays> pixels;
  unsigned count = 0;
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x) {
      const double depth = view.depth.at(x, y);
      if (depth <= 0.0) continue;
      const Eigen::Vector3d surface = R_world_camera * camera.unproject(x, y, depth) + p_world_camera;
      const Eigen::Vector3d to_projector = p_world_projector - surface;
      RTCRay& ray = shadow_rays[count];
      pixels[count++] = view.depth.index(x, y);
      setRay(ray, surface, to_projector);
      ray.tnear = static_cast<float>(kShadowStart_m / to_projector.norm());
      ray.tfar = 1.0F;
    }
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded1M(scene, &context, shadow_rays.data(), count, sizeof(RTCRay));
  for (unsigned i = 0; i < count; ++i) view.lit.data[pixels[i]] = shadow_rays[i].tfar < 0.0F ? 0 : 1;
}

}  // namespace depthmocap
