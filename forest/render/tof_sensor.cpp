#include "forest/render/tof_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

// The hexagon's flat edges are as wide as this share of the image; its points touch the image's sides. No figures of
// it are published.
constexpr double kFlatEdge = 0.5;
// [px] size of patches that reflect alike; by eye.
constexpr double kReflectance_px = 40.0;

double jumpAt(double depth_m) {
  return 0.03 + 0.015 * depth_m;
}

// How far [m] the surface recedes between the pixels (x, y) - d and (x, y) + d: 0 on planes, whose inverse depth is
// linear in the image, positive in concave corners. 0 beside a silhouette.
double recess(const DepthImage& depth, int x, int y, int dx, int dy) {
  if (!depth.contains(x - dx, y - dy) || !depth.contains(x + dx, y + dy)) return 0;
  const double here = depth.at(x, y);
  const double a = depth.at(x - dx, y - dy);
  const double b = depth.at(x + dx, y + dy);
  if (a <= 0 || b <= 0) return 0;
  constexpr double kSameSurface_m = 0.6;  // beyond, the light of the other side is too weak to matter
  if (std::abs(a - here) > kSameSurface_m || std::abs(b - here) > kSameSurface_m) return 0;
  return std::max(0.0, here * here * (0.5 / a + 0.5 / b - 1.0 / here));
}

// How much farther [m] a surface near a concave corner seems. Light that came by the other wall travelled as far as
// direct light in the corner itself, farther beside it: a walls' corner looks round (Fuchs 2010; Freedman et al. 2014).
double multipathBias(const DepthImage& depth, int x, int y, double focal_px, const TofNoise& n) {
  const double reach_px = n.multipath_reach_m * focal_px / depth.at(x, y);
  const int far = std::max(2, static_cast<int>(std::lround(reach_px)));
  const int near = std::max(1, far / 3);
  const double ratio = static_cast<double>(far) / near;
  double bias = 0;
  for (const auto& [dx, dy] : {std::array{1, 0}, std::array{0, 1}}) {
    const double wide = recess(depth, x, y, far * dx, far * dy);
    if (wide <= 0) continue;
    bias += std::max(0.0, wide - ratio * recess(depth, x, y, near * dx, near * dy));
  }
  return n.multipath * bias;
}

struct Silhouette {
  bool here = false;      // a jump to a neighbour
  double behind_m = 0;    // [m] depth of the farthest neighbour
  bool in_front = false;  // this pixel is the near side
};

Silhouette silhouetteAt(const DepthImage& depth, int x, int y) {
  Silhouette result;
  const double here = depth.at(x, y);
  const double jump = jumpAt(here);
  for (const auto& [dx, dy] : {std::array{-1, 0}, std::array{1, 0}, std::array{0, -1}, std::array{0, 1}}) {
    if (!depth.contains(x + dx, y + dy)) continue;
    const double there = depth.at(x + dx, y + dy);
    result.behind_m = std::max(result.behind_m, there);
    result.here = result.here || there <= 0 || std::abs(there - here) > jump;
  }
  result.in_front = result.here && result.behind_m > here + jump;
  return result;
}

}  // namespace

bool insideHexagon(int x, int y, int width, int height) {
  const double u = std::abs(2.0 * (x + 0.5) / width - 1.0);   // 0 in the middle, 1 at the side
  const double v = std::abs(2.0 * (y + 0.5) / height - 1.0);  // 0 in the middle, 1 at top and bottom
  return u <= 1.0 - (1.0 - kFlatEdge) * v;
}

RenderOptions TofSensor::renderOptions() const {
  RenderOptions options;
  options.incidence = true;
  return options;
}

void TofSensor::apply(const RenderedView& view, const CameraModel& camera, Random& random, DepthImage& depth,
                      PartImage& parts) {
  DMC_CHECK(view.incidence.data.size() == view.depth.data.size());
  const TofNoise& n = noise;
  depth.reset(camera.width, camera.height, 0.0F);
  parts.reset(camera.width, camera.height, 0);
  const double scale = camera.fx / 504.0;  // [1] to the full image, in whose pixels TofNoise counts
  wiggle_.draw(camera.width, camera.height, std::max(2.0, n.wiggle_px * scale), random);
  reflectance_.draw(camera.width, camera.height, std::max(2.0, kReflectance_px * scale), random);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const double clean = view.depth.at(x, y);
      if (clean <= 0 || !insideHexagon(x, y, camera.width, camera.height)) continue;
      const double cosine = view.incidence.at(x, y);
      if (cosine < n.grazing_cos) continue;
      const double beyond = (clean - n.max_depth_m) / n.fade_m;
      if (beyond > 0 && beyond > 0.5 + 0.5 * reflectance_.at(x, y)) continue;
      const double slant = 1.0 / std::max(0.25, cosine);
      const double spread = (n.noise_m + n.noise_per_m2 * clean * clean) * (0.5 + 0.5 * slant);
      double measured = clean + spread * random.normal() + n.wiggle_m * wiggle_.at(x, y) +
                        multipathBias(view.depth, x, y, camera.fx, n);
      std::uint8_t part = view.parts.at(x, y);
      const Silhouette edge = silhouetteAt(view.depth, x, y);
      if (edge.here) {
        if (random.uniform() < n.edge_dropout) continue;
        if (edge.in_front && random.uniform() < n.flying_share) {
          const double mix = random.uniform();
          measured += mix * mix * (edge.behind_m - clean);
          if (measured - clean > 0.1) part = 0;
        }
      }
      if (measured < n.min_depth_m) continue;
      depth.at(x, y) = static_cast<float>(std::round(measured * 1000.0) / 1000.0);
      parts.at(x, y) = part;
    }
  }
}

}  // namespace depthmocap
