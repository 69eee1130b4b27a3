#include "forest/render/stereo_sensor.h"

#include <algorithm>
#include <cmath>

#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

constexpr double kReferenceFocal_px = 617.0;  // [px] of the image that StereoNoise counts its pixels in

// The nearest surface within the window: matching windows are won by the nearer of two surfaces.
std::size_t nearestAround(const DepthImage& depth, int x, int y, int reach) {
  std::size_t best = depth.index(x, y);
  float nearest = depth.data[best];
  for (int dx = -reach; dx <= reach; ++dx) {
    for (int dy = -reach; dy <= reach; ++dy) {
      if (!depth.contains(x + dx, y + dy)) continue;
      const std::size_t i = depth.index(x + dx, y + dy);
      if (depth.data[i] <= 0 || (nearest > 0 && depth.data[i] >= nearest)) continue;
      nearest = depth.data[i];
      best = i;
    }
  }
  return best;
}

// A jump of depth that no slanted surface makes, this far [px] to one of the four sides.
bool edgeWithin(const DepthImage& depth, int x, int y, int reach) {
  constexpr float kJump = 0.06F;  // of the depth
  if (reach <= 0) return false;
  const float here = depth.at(x, y);
  for (const auto& [dx, dy] : {std::pair{-reach, 0}, std::pair{reach, 0}, std::pair{0, -reach}, std::pair{0, reach}}) {
    if (!depth.contains(x + dx, y + dy)) continue;
    const float there = depth.at(x + dx, y + dy);
    if (there <= 0 || std::abs(there - here) > kJump * here * static_cast<float>(1 + 0.1 * reach)) return true;
  }
  return false;
}

}  // namespace

// Chosen by eye beside the real pictures of docs/design/rendered-cameras.md.
std::optional<StereoNoise> stereoNoiseOf(SensorKind kind) {
  StereoNoise n;
  switch (kind) {
    case SensorKind::D435:
    case SensorKind::D435Portrait:
      n.window_px = 13.0;
      n.disparity_noise_px = 0.07;
      n.dropout = 0.03;
      n.dropout_px = 14.0;
      n.smoothing_px = 3.0;
      n.fill_px = 40.0;
      return n;
    case SensorKind::D435Raw:
    case SensorKind::D435Hd:
      n.filling = HoleFilling::None;
      n.smoothing_px = 0.0;
      n.dropout = 0.06;
      n.dropout_power = 2.0;
      n.dropout_px = 34.0;
      n.disparity_noise_px = 0.09;
      n.fattening_px = 1.0;
      n.edge_gap_px = 7.0;
      n.blind_band = true;
      return n;
    case SensorKind::Orbbec:
      n.filling = HoleFilling::None;
      n.smoothing_px = 4.0;
      n.dropout = 0.05;
      n.dropout_px = 45.0;
      n.window_px = 14.0;
      n.fattening_px = 5.0;
      n.min_depth_m = 0.15;
      n.blind_band = true;
      return n;
    default:
      return std::nullopt;
  }
}

RenderOptions StereoSensor::renderOptions() const {
  RenderOptions options;
  options.incidence = true;
  options.p_camera_projector = Eigen::Vector3d(noise.baseline_m, 0.0, 0.0);  // the second imager
  return options;
}

void StereoSensor::apply(const RenderedView& view, const CameraModel& camera, Random& random, DepthImage& depth,
                         PartImage& parts) {
  DMC_CHECK(view.incidence.data.size() == view.depth.data.size());
  DMC_CHECK(view.lit.data.size() == view.depth.data.size());
  depth.reset(camera.width, camera.height, 0.0F);
  parts.reset(camera.width, camera.height, 0);
  const double scale = camera.fx / kReferenceFocal_px;
  match(view, scale, random, depth, parts);
  if (noise.filling != HoleFilling::None) fillHoles(noise.fill_px * scale, depth, parts);
  const double reach = noise.smoothing_px * scale;
  if (reach > 0) smooth(reach, depth, parts);
  for (std::size_t i = 0; i < depth.data.size(); ++i) {
    const auto z = static_cast<double>(depth.data[i]);
    if (z < noise.min_depth_m || z > noise.max_depth_m) depth.data[i] = 0;
    depth.data[i] = std::round(depth.data[i] * 1000.0F) / 1000.0F;
    if (depth.data[i] <= 0) parts.data[i] = 0;
  }
}

void StereoSensor::match(const RenderedView& view, double scale, Random& random, DepthImage& depth, PartImage& parts) {
  const int width = view.depth.width;
  const int height = view.depth.height;
  error_.draw(width, height, std::max(1.0, noise.window_px * scale), random);
  texture_.draw(width, height, std::max(2.0, noise.dropout_px * scale), random);
  growth_.draw(width, height, std::max(2.0, 2 * noise.window_px * scale), random);
  const double focal_baseline = kReferenceFocal_px * noise.baseline_m;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double grown = noise.fattening_px * scale * (0.5 + 0.5 * static_cast<double>(growth_.at(x, y)));
      const int reach = std::max(0, static_cast<int>(grown + random.uniform()));
      const std::size_t i = reach > 0 ? nearestAround(view.depth, x, y, reach) : view.depth.index(x, y);
      const auto z = static_cast<double>(view.depth.data[i]);
      const auto cosine = static_cast<double>(view.incidence.data[i]);
      if (z <= 0 || view.lit.data[i] == 0 || cosine < noise.grazing_cos) continue;
      if (noise.blind_band && x < scale * focal_baseline / z) continue;
      if (noise.edge_gap_px > 0) {
        const double gap = noise.edge_gap_px * scale * (0.7 + 0.5 * static_cast<double>(texture_.at(x, y)));
        if (edgeWithin(view.depth, x, y, static_cast<int>(std::lround(gap)))) continue;
      }
      // Less light comes back from farther: patches without texture grow.
      const double share = std::min(0.95, noise.dropout * std::max(0.2, std::pow(z / 2.0, noise.dropout_power)));
      const double threshold = share > 0 ? std::log((1 - share) / share) / 1.702 : 1e9;
      if (static_cast<double>(texture_.at(x, y)) > threshold) continue;
      const double slant = 1.0 / std::max(0.3, cosine);
      const double disparity = focal_baseline / z + slant * noise.disparity_noise_px *
                                                        (static_cast<double>(error_.at(x, y)) + 0.2 * random.normal());
      if (disparity <= 0) continue;
      depth.at(x, y) = static_cast<float>(focal_baseline / disparity);
      parts.at(x, y) = view.parts.data[i];
    }
  }
}

// Row by row, what lies between two measured pixels.
void StereoSensor::fillHoles(double fill_px, DepthImage& depth, PartImage& parts) const {
  for (int y = 0; y < depth.height; ++y) {
    int left = -1;
    for (int x = 0; x <= depth.width; ++x) {
      const bool measured = x < depth.width && depth.at(x, y) > 0;
      if (!measured && x < depth.width) continue;
      const bool open = left < 0 || x == depth.width;  // a hole at the border has one side only
      const bool wide = x - left - 1 > fill_px;
      for (int h = left + 1; h < x && !wide; ++h) {
        if (left < 0 && x == depth.width) break;
        const int from_left = left < 0 ? x : left;
        const int from_right = x == depth.width ? left : x;
        const float a = depth.at(from_left, y);
        const float b = depth.at(from_right, y);
        const float t = open ? 0.0F : static_cast<float>(h - left) / static_cast<float>(x - left);
        float z = a;
        if (noise.filling == HoleFilling::Farthest) z = std::max(a, b);
        if (noise.filling == HoleFilling::Ramp) z = (1 - t) * a + t * b;
        depth.at(h, y) = z;
        parts.at(h, y) = std::abs(z - a) <= std::abs(z - b) ? parts.at(from_left, y) : parts.at(from_right, y);
      }
      left = x;
    }
  }
}

// A recursive filter to and fro along rows, then columns: edges become ramps.
void StereoSensor::smooth(double reach_px, DepthImage& depth, PartImage& parts) {
  const auto keep = static_cast<float>(std::exp(-1.0 / std::max(0.3, 0.5 * reach_px)));
  before_ = depth;
  const auto pass = [&](std::size_t first, std::ptrdiff_t step, int count) {
    float last = 0;
    auto i = static_cast<std::ptrdiff_t>(first);
    for (int k = 0; k < count; ++k, i += step) {
      float& z = depth.data[static_cast<std::size_t>(i)];
      if (z > 0 && last > 0) z += keep * (last - z);
      last = z;
    }
  };
  const auto width = static_cast<std::size_t>(depth.width);
  const auto height = static_cast<std::size_t>(depth.height);
  for (std::size_t y = 0; y < height; ++y) {
    pass(y * width, 1, depth.width);
    pass(y * width + width - 1, -1, depth.width);
  }
  for (std::size_t x = 0; x < width; ++x) {
    pass(x, depth.width, depth.height);
    pass((height - 1) * width + x, -depth.width, depth.height);
  }
  // The surface that a smoothed pixel is nearest to.
  const int around = std::max(1, static_cast<int>(std::lround(reach_px)));
  const PartImage sharp = parts;
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const float z = depth.at(x, y);
      if (z <= 0) continue;
      float best = std::abs(before_.at(x, y) - z);
      if (best < 0.03F) continue;
      for (int d = -around; d <= around; ++d) {
        for (const auto& [nx, ny] : {std::pair{x + d, y}, std::pair{x, y + d}}) {
          if (!depth.contains(nx, ny) || before_.at(nx, ny) <= 0) continue;
          const float distance = std::abs(before_.at(nx, ny) - z);
          if (distance >= best) continue;
          best = distance;
          parts.at(x, y) = sharp.at(nx, ny);
        }
      }
    }
  }
}

}  // namespace depthmocap
