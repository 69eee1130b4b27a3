#include "forest/train/marker_statistics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "libtracker/classify/classify.h"
#include "libtracker/core/parallel.h"
#include "libtracker/core/random.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/marker_model.h"

namespace depthmocap {
namespace {

constexpr double kMinConfidence = 0.3;  // modes with less do not decide where the offset is
constexpr double kSeenArea = 2.0;       // times min_area_m2: a part that shows this much should have a marker
constexpr double kRobust_m = 0.04;      // scale of the Cauchy weights
constexpr int kRounds = 10;             // of reweighting
constexpr std::size_t kChunks = 64;     // of images; fixed, so that the result does not depend on threads

// One mode: where it lies and which way the camera looked, in the bone's frame.
struct Sample {
  Eigen::Vector3d mode;
  Eigen::Vector3d ray;
  double confidence;
};
// What was seen of each part in some images.
struct PartSamples {
  std::vector<Sample> modes;
  int seen = 0;
  int missing = 0;
};
using Samples = std::array<PartSamples, kPartCount>;

void truthAsPixels(const TrainingView& view, int stride, ClassifiedPixels& pixels) {
  pixels.stride = stride;
  pixels.pixels.clear();
  for (int y = 0; y < view.depth.height; y += stride) {
    for (int x = 0; x < view.depth.width; x += stride) {
      const auto part = static_cast<Part>(view.parts.at(x, y));
      if (part == Part::None) continue;
      ClassifiedPixels::Pixel pixel;
      pixel.x = static_cast<std::int16_t>(x);
      pixel.y = static_cast<std::int16_t>(y);
      pixel.depth_m = view.depth.at(x, y);
      pixel.probability[static_cast<std::size_t>(partIndex(part))] = 1.0F;
      pixels.pixels.push_back(pixel);
    }
  }
}

void addSamples(const TrainingView& view, const BodySurface& body, const MarkerSet& modes, Samples& samples) {
  ForwardKinematics fk;
  fk.update(body.skeleton, view.q_world);
  const MarkerModel model = averageMarkerModel(body.skeleton);
  const double scale = statureOf(body.skeleton.lengths) / statureOf(BoneLengths{});
  const Eigen::Isometry3d T_world_camera = view.T_camera_world.inverse();
  for (int i = 0; i < kPartCount; ++i) {
    if (!modes.seen(i)) continue;
    const Bone bone = model[static_cast<std::size_t>(i)].bone;
    const Eigen::Matrix3d R_bone_world = fk.R_world_bone(bone).transpose();
    const Eigen::Vector3d p_camera = modes.position.col(i);
    Sample sample;
    sample.mode = R_bone_world * (T_world_camera * p_camera - fk.origin(bone)) / scale;
    sample.ray = R_bone_world * (T_world_camera.linear() * p_camera.normalized());
    sample.confidence = modes.confidence[i];
    samples[static_cast<std::size_t>(i)].modes.push_back(sample);
  }
}

// Which of the parts that show enough of themselves have no marker.
void countMissing(const TrainingView& view, double min_area_m2, const MarkerSet& modes, Samples& samples) {
  std::array<double, kPartCount> area_m2{};
  const double pixel_angle2 = 1.0 / (view.camera.fx * view.camera.fy);
  for (std::size_t p = 0; p < view.parts.data.size(); ++p) {
    const auto part = static_cast<Part>(view.parts.data[p]);
    if (part == Part::None) continue;
    const auto depth_m = static_cast<double>(view.depth.data[p]);
    area_m2[static_cast<std::size_t>(partIndex(part))] += depth_m * depth_m * pixel_angle2;
  }
  for (int i = 0; i < kPartCount; ++i) {
    if (area_m2[static_cast<std::size_t>(i)] < kSeenArea * min_area_m2) continue;
    PartSamples& part = samples[static_cast<std::size_t>(i)];
    ++part.seen;
    part.missing += modes.seen(i) ? 0 : 1;
  }
}

double distanceOf(const Sample& sample, const MarkerStatistics::PartStatistics& part) {
  return (sample.mode + part.radius_m * sample.ray - part.offset).norm();
}

// Robust least squares of mode + radius * ray = offset over (offset, radius).
void fitOffset(const std::vector<Sample>& samples, MarkerStatistics::PartStatistics& result) {
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix4d A = Eigen::Matrix4d::Identity() * 1e-9;
    Eigen::Vector4d b = Eigen::Vector4d::Zero();
    for (const Sample& sample : samples) {
      if (sample.confidence < kMinConfidence) continue;
      const double distance = round == 0 ? 0.0 : distanceOf(sample, result);
      const double w = 1.0 / (1.0 + std::pow(distance / kRobust_m, 2));
      Eigen::Matrix<double, 3, 4> J;
      J << Eigen::Matrix3d::Identity(), -sample.ray;
      A += w * J.transpose() * J;
      b += w * J.transpose() * sample.mode;
    }
    const Eigen::Vector4d x = A.ldlt().solve(b);
    result.offset = x.head<3>();
    result.radius_m = std::max(0.0, x[3]);
  }
}

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

MarkerStatistics statisticsOf(const Samples& samples) {
  MarkerStatistics statistics;
  std::array<std::vector<double>, MarkerStatistics::kConfidenceBins> by_confidence;
  for (std::size_t part = 0; part < kPartCount; ++part) {
    auto& result = statistics.parts[part];
    result.count = static_cast<int>(samples[part].modes.size());
    result.seen = samples[part].seen;
    result.missing = samples[part].missing;
    fitOffset(samples[part].modes, result);
    std::vector<double> distances;
    for (const Sample& sample : samples[part].modes) {
      distances.push_back(distanceOf(sample, result));
      const auto bin = static_cast<std::size_t>(sample.confidence * MarkerStatistics::kConfidenceBins);
      by_confidence[std::min(bin, by_confidence.size() - 1)].push_back(distances.back());
    }
    result.median_m = quantile(distances, 0.5);
    result.p95_m = quantile(distances, 0.95);
  }
  for (std::size_t bin = 0; bin < by_confidence.size(); ++bin) {
    auto& distances = by_confidence[bin];
    const auto near =
        std::count_if(distances.begin(), distances.end(), [](double d) { return d < MarkerStatistics::kNear_m; });
    const double all = std::max<double>(1, static_cast<double>(distances.size()));
    statistics.by_confidence[bin] = {static_cast<int>(distances.size()), quantile(distances, 0.5),
                                     static_cast<double>(near) / all};
  }
  return statistics;
}

}  // namespace

MarkerStatistics measureMarkers(const std::vector<BodySurface>& bodies,
                                const std::vector<Eigen::Matrix<float, kDofCount, 1>>& poses, const Forest* forest,
                                const MarkerStatisticsConfig& config) {
  std::vector<Samples> parts(kChunks);
  MarkerConfig surface = config.markers;
  surface.push_in = false;
  parallelFor(config.threads, kChunks, [&](std::size_t chunk) {
    TrainingViewRenderer renderer(config.view);
    MarkerFinder finder(surface);
    TrainingView view;
    ClassifiedPixels pixels;
    MarkerSet modes;
    for (auto i = chunk; i < static_cast<std::size_t>(config.images); i += kChunks) {
      Random random(config.seed, i);
      const BodySurface& body = bodies[random.below(static_cast<std::uint32_t>(bodies.size()))];
      const auto& q = poses[random.below(static_cast<std::uint32_t>(poses.size()))];
      renderer.render(body, q.cast<double>(), random, view);
      ClassifyConfig classify_config;
      classify_config.stride = view.camera.width > 400 ? 2 : 1;
      if (forest != nullptr) {
        classify(*forest, view.depth, view.parts, view.camera.fx, classify_config, pixels);
      } else {
        truthAsPixels(view, classify_config.stride, pixels);
      }
      finder.find(pixels, view.camera, {}, nullptr, modes);
      addSamples(view, body, modes, parts[chunk]);
      countMissing(view, config.markers.min_area_m2, modes, parts[chunk]);
    }
  });
  Samples all;
  for (std::size_t part = 0; part < kPartCount; ++part) {
    for (const Samples& chunk : parts) {
      all[part].modes.insert(all[part].modes.end(), chunk[part].modes.begin(), chunk[part].modes.end());
      all[part].seen += chunk[part].seen;
      all[part].missing += chunk[part].missing;
    }
  }
  return statisticsOf(all);
}

}  // namespace depthmocap
