#include "forest/render/sensor_model.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "forest/render/person_label.h"
#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

constexpr double kStored_m = 0.001;  // [m] both sensors deliver whole millimetres

float toWholeMillimetres(double depth_m) {
  return static_cast<float>(std::round(depth_m / kStored_m) * kStored_m);
}

// A jump that neither sensor's smooth surfaces make within a pixel.
double edgeJump(double depth_m) {
  return 0.03 + 0.015 * depth_m;
}

struct Neighbourhood {
  bool edge = false;    // a jump to one of the 8 neighbours, or a neighbour without surface
  bool before = false;  // this pixel is on the near side of it
  double behind_m = 0;  // [m] depth of the farthest neighbour; 0 = one has nothing behind
};

Neighbourhood lookAround(const DepthImage& depth, int x, int y) {
  const double here = depth.at(x, y);
  const double jump = edgeJump(here);
  Neighbourhood result;
  double farthest = here;
  bool open = false;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (!depth.contains(x + dx, y + dy)) continue;
      const double there = depth.at(x + dx, y + dy);
      open = open || there <= 0.0;
      farthest = std::max(farthest, there);
      result.edge = result.edge || std::abs(there - here) > jump;
    }
  }
  result.before = open || farthest - here > jump;
  result.behind_m = open ? 0.0 : farthest;
  return result;
}

// The mean inverse depth of the surface that a matching window around the pixel covers: windows round off what is
// smaller than they are, above all the steep rims of limbs.
double windowDisparity(const DepthImage& depth, int x, int y, int stride, double focal_baseline) {
  const double here = depth.at(x, y);
  const double jump = edgeJump(here);
  double sum = 0;
  int count = 0;
  for (int dy = -stride; dy <= stride; dy += stride) {
    for (int dx = -stride; dx <= stride; dx += stride) {
      if (!depth.contains(x + dx, y + dy)) continue;
      const double there = depth.at(x + dx, y + dy);
      if (there <= 0.0 || std::abs(there - here) > jump) continue;
      sum += focal_baseline / there;
      ++count;
    }
  }
  return sum / count;
}

// The pixels that can measure something: the rendered box and a margin [px] for the wobble of silhouettes.
struct Window {
  int x0, y0, x1, y1;

  Window(const RenderedView& view, double margin)
      : x0(std::max(0, view.x0 - static_cast<int>(std::ceil(margin)))),
        y0(std::max(0, view.y0 - static_cast<int>(std::ceil(margin)))),
        x1(std::min(view.depth.width, view.x1 + static_cast<int>(std::ceil(margin)))),
        y1(std::min(view.depth.height, view.y1 + static_cast<int>(std::ceil(margin)))) {}
  void draw(SmoothNoise& field, double spacing, Random& random) const {
    field.draw(std::max(0, x1 - x0), std::max(0, y1 - y0), spacing, random);
  }
};

// How silhouettes wobble: smooth fields over a window, times `lateral_px`.
struct Wobble {
  double lateral_px;
  const SmoothNoise& shift_x;
  const SmoothNoise& shift_y;

  // The pixel of `image` that is measured at (x, y), which is (u, v) of the window.
  [[nodiscard]] std::pair<int, int> source(int x, int y, int u, int v, const DepthImage& image) const {
    return {std::clamp(x + static_cast<int>(std::lround(lateral_px * shift_x.at(u, v))), 0, image.width - 1),
            std::clamp(y + static_cast<int>(std::lround(lateral_px * shift_y.at(u, v))), 0, image.height - 1)};
  }
};

// What a pixel measures.
struct Measured {
  double depth_m;
  std::uint8_t part;
};

// The depths that a sensor hands out [m].
struct DepthRange {
  double min_m;
  double max_m;
};

// Measures the pixels of the window, row by row. `measure(x, y, u, v)` says what the pixel (x, y) of the view gives, at
// (u, v) of the window, if anything; it is asked for pixels with a surface only.
template <typename Measure>
void measurePixels(const RenderedView& view, const Window& window, const Wobble& wobble, const DepthRange& range,
                   const Measure& measure, DepthImage& depth, PartImage& parts) {
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const int u = x - window.x0;
      const int v = y - window.y0;
      const auto [sx, sy] = wobble.source(x, y, u, v, view.depth);
      if (view.depth.at(sx, sy) <= 0.0F) continue;
      const std::optional<Measured> measured = measure(sx, sy, u, v);
      if (!measured || measured->depth_m < range.min_m || measured->depth_m > range.max_m) continue;
      depth.at(x, y) = toWholeMillimetres(measured->depth_m);
      parts.at(x, y) = measured->part;
    }
  }
}

// A standard normal field is above this value on a share of the image (a logistic fit of the normal quantile, good to
// 0.02 for shares in 0.02 .. 0.98).
float thresholdForShare(double share) {
  if (share <= 0.0) return 1e9F;
  if (share >= 1.0) return -1e9F;
  return static_cast<float>(std::log((1.0 - share) / share) / 1.702);
}

// Sets to "no measurement" discs of random places in the box of the picture.
void punchHoles(const RenderedView& view, double holes_a_pixel, double scale, Random& random, DepthImage& depth) {
  const int width = view.x1 - view.x0;
  const int height = view.y1 - view.y0;
  if (width <= 0 || height <= 0) return;
  const double mean = holes_a_pixel * width * height;
  const int count = static_cast<int>(mean + random.uniform());
  for (int i = 0; i < count; ++i) {
    const int cx = view.x0 + static_cast<int>(random.below(static_cast<std::uint32_t>(width)));
    const int cy = view.y0 + static_cast<int>(random.below(static_cast<std::uint32_t>(height)));
    const double radius = std::max(0.7, random.uniform(0.8, 4.0) * scale);
    const int reach = static_cast<int>(std::ceil(radius));
    for (int y = cy - reach; y <= cy + reach; ++y) {
      for (int x = cx - reach; x <= cx + reach; ++x) {
        const double d2 = (x - cx) * (x - cx) + (y - cy) * (y - cy);
        if (depth.contains(x, y) && d2 <= radius * radius) depth.at(x, y) = 0.0F;
      }
    }
  }
}

// The matcher has no measurement for less than a few pixels of one surface.
void removeSpeckles(const RenderedView& view, const DepthImage& unfiltered, DepthImage& depth) {
  constexpr int kSupport = 3;
  for (int y = view.y0; y < view.y1; ++y) {
    for (int x = view.x0; x < view.x1; ++x) {
      const double here = unfiltered.at(x, y);
      if (here <= 0.0) continue;
      int support = 0;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if (!unfiltered.contains(x + dx, y + dy) || (dx == 0 && dy == 0)) continue;
          const double there = unfiltered.at(x + dx, y + dy);
          support += there > 0.0 && std::abs(there - here) < 2.0 * edgeJump(here) ? 1 : 0;
        }
      }
      if (support < kSupport) depth.at(x, y) = 0.0F;
    }
  }
}

template <typename T>
void transpose(const Image<T>& from, Image<T>& to) {
  to.reset(from.height, from.width, T{});
  for (int y = 0; y < from.height; ++y) {
    for (int x = 0; x < from.width; ++x) to.at(y, x) = from.at(x, y);
  }
}

}  // namespace

SensorModel::SensorModel(SensorKind kind) : kind_(kind) {
  if (const std::optional<StereoNoise> noise = stereoNoiseOf(kind)) stereo.noise = *noise;
}

RenderOptions SensorModel::renderOptions() const {
  if (kind_ == SensorKind::Azure) return tof.renderOptions();
  if (stereoNoiseOf(kind_)) {
    RenderOptions options = stereo.renderOptions();
    Eigen::Vector3d& second = *options.p_camera_projector;
    if (kind_ == SensorKind::D435Portrait) second = Eigen::Vector3d(second.y(), second.x(), second.z());
    return options;
  }
  RenderOptions options;
  options.incidence = true;
  if (kind_ == SensorKind::Kinect1) options.p_camera_projector = Eigen::Vector3d(kinect1.baseline_m, 0.0, 0.0);
  return options;
}

void SensorModel::apply(const RenderedView& view, const CameraModel& camera, Random& random, DepthImage& depth,
                        PartImage& parts) {
  if (kind_ == SensorKind::Azure) return tof.apply(view, camera, random, depth, parts);
  if (kind_ == SensorKind::D435Portrait) return applyOnItsSide(view, camera, random, depth, parts);
  if (stereoNoiseOf(kind_)) return stereo.apply(view, camera, random, depth, parts);
  DMC_CHECK(view.incidence.data.size() == view.depth.data.size());
  DMC_CHECK(kind_ == SensorKind::Kinect2 || view.lit.data.size() == view.depth.data.size());
  depth.reset(camera.width, camera.height, 0.0F);
  parts.reset(camera.width, camera.height, 0);
  const double scale = camera.fx / sensorCamera(kind_).fx;
  if (kind_ == SensorKind::Kinect1) {
    applyKinect1(view, scale, random, depth, parts);
  } else {
    applyKinect2(view, scale, random, depth, parts);
  }
}

// Rows of the sensor are columns of the picture. Which way it was turned makes no difference to what is measured.
void SensorModel::applyOnItsSide(const RenderedView& view, const CameraModel& camera, Random& random, DepthImage& depth,
                                 PartImage& parts) {
  transpose(view.depth, turned_.depth);
  transpose(view.parts, turned_.parts);
  transpose(view.incidence, turned_.incidence);
  transpose(view.lit, turned_.lit);
  CameraModel sensor = camera;
  std::swap(sensor.width, sensor.height);
  std::swap(sensor.fx, sensor.fy);
  std::swap(sensor.cx, sensor.cy);
  stereo.apply(turned_, sensor, random, turned_depth_, turned_parts_);
  transpose(turned_depth_, depth);
  transpose(turned_parts_, parts);
}

void SensorModel::applyKinect1(const RenderedView& view, double scale, Random& random, DepthImage& depth,
                               PartImage& parts) {
  const Kinect1Noise& n = kinect1;
  const double match_px = std::max(1.5, n.window_px * scale);
  const int stride = std::max(1, static_cast<int>(std::lround(match_px / 3.0)));
  const double lateral = n.lateral_noise_px * scale;
  const Window window(view, 3.0 * lateral);
  for (SmoothNoise* field : {&shift_x_, &shift_y_, &error_, &dropout_}) window.draw(*field, match_px, random);
  const double focal_baseline = n.focal_px * n.baseline_m;
  const float edge_threshold = thresholdForShare(n.edge_dropout);
  const float hair_threshold = thresholdForShare(n.hair_dropout);

  const auto measure = [&](int x, int y, int u, int v) -> std::optional<Measured> {
    if (view.lit.at(x, y) == 0) return std::nullopt;
    const float cosine = view.incidence.at(x, y);
    const float drop = dropout_.at(u, v);
    const std::uint8_t part = view.parts.at(x, y);
    const bool head = partOfPerson(part) == static_cast<std::uint8_t>(Part::Head);
    if (cosine < n.grazing_cos * (1.0 + 0.5 * drop)) return std::nullopt;
    if (head && cosine < n.hair_cos && drop > hair_threshold) return std::nullopt;
    if (drop > edge_threshold && lookAround(view.depth, x, y).edge) return std::nullopt;

    const double slant = 1.0 / std::max(0.3, static_cast<double>(cosine));
    const double noise = slant * (n.window_noise_px * error_.at(u, v) + n.pixel_noise_px * random.normal());
    const double disparity =
        std::round((windowDisparity(view.depth, x, y, stride, focal_baseline) + noise) / n.disparity_step_px) *
        n.disparity_step_px;
    if (disparity <= 0.0) return std::nullopt;
    return Measured{focal_baseline / disparity, part};
  };
  measurePixels(view, window, {lateral, shift_x_, shift_y_}, {n.min_depth_m, n.max_depth_m}, measure, depth, parts);
  punchHoles(view, n.holes / (640.0 * 480.0 * scale * scale), scale, random, depth);
  unfiltered_ = depth;
  removeSpeckles(view, unfiltered_, depth);
  for (std::size_t i = 0; i < depth.data.size(); ++i) {
    if (depth.data[i] <= 0.0F) parts.data[i] = 0;
  }
}

void SensorModel::applyKinect2(const RenderedView& view, double scale, Random& random, DepthImage& depth,
                               PartImage& parts) {
  const Kinect2Noise& n = kinect2;
  const double lateral = n.lateral_noise_px * scale;
  const Window window(view, 3.0 * lateral);
  for (SmoothNoise* field : {&shift_x_, &shift_y_}) window.draw(*field, 2.0, random);
  window.draw(error_, n.multipath_px * scale, random);

  const auto measure = [&](int x, int y, int u, int v) -> std::optional<Measured> {
    const double clean = view.depth.at(x, y);
    const double cosine = view.incidence.at(x, y);
    if (cosine < n.grazing_cos) return std::nullopt;
    const double slant = 1.0 / std::max(0.25, cosine);
    const double spread = (n.noise_m + n.noise_per_m2 * clean * clean) * (0.5 + 0.5 * slant);
    Measured measured{clean + spread * random.normal() + n.multipath_m * error_.at(u, v), view.parts.at(x, y)};
    const Neighbourhood around = lookAround(view.depth, x, y);
    if (around.before && random.uniform() < n.flying_share) {
      const double mix = random.uniform();
      const double gap = around.behind_m > 0.0 ? around.behind_m - clean : n.flying_reach_m;
      // A pixel that is mostly background, with nothing there, is not measured at all.
      if (around.behind_m <= 0.0 && mix > 0.6) return std::nullopt;
      measured.depth_m += mix * mix * gap;
      if (mix * mix * gap > 0.1) measured.part = 0;
    }
    return measured;
  };
  measurePixels(view, window, {lateral, shift_x_, shift_y_}, {n.min_depth_m, n.max_depth_m}, measure, depth, parts);
}

}  // namespace depthmocap
