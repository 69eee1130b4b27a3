#include "forest/train/marker_statistics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "libtracker/core/parallel.h"
#include "libtracker/core/random.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/marker_model.h"

namespace depthmocap {
namespace {

constexpr double kMinConfidence = 0.3;  // modes with less are left out
constexpr double kRobust_m = 0.04;      // scale of the Cauchy weights
constexpr int kRounds = 10;             // of reweighting
constexpr std::size_t kChunks = 64;     // of images; fixed, so that the result does not depend on threads

// One mode: where it lies and which way the camera looked, in the bone's frame.
struct Sample {
  Eigen::Vector3d mode;
  Eigen::Vector3d ray;
};
using Samples = std::array<std::vector<Sample>, kPartCount>;

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
    if (modes.confidence[i] < kMinConfidence) continue;
    const Bone bone = model[static_cast<std::size_t>(i)].bone;
    const Eigen::Matrix3d R_bone_world = fk.R_world_bone(bone).transpose();
    const Eigen::Vector3d p_camera = modes.position.col(i);
    Sample sample;
    sample.mode = R_bone_world * (T_world_camera * p_camera - fk.origin(bone)) / scale;
    sample.ray = R_bone_world * (T_world_camera.linear() * p_camera.normalized());
    samples[static_cast<std::size_t>(i)].push_back(sample);
  }
}

// Robust least squares of mode + radius * ray = offset over (offset, radius).
MarkerStatistics::PartStatistics fit(const std::vector<Sample>& samples) {
  MarkerStatistics::PartStatistics result;
  result.count = static_cast<int>(samples.size());
  if (samples.empty()) return result;
  std::vector<double> distance(samples.size(), 0.0);
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix4d A = Eigen::Matrix4d::Identity() * 1e-9;
    Eigen::Vector4d b = Eigen::Vector4d::Zero();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double w = 1.0 / (1.0 + std::pow(distance[i] / kRobust_m, 2));
      Eigen::Matrix<double, 3, 4> J;
      J << Eigen::Matrix3d::Identity(), -samples[i].ray;
      A += w * J.transpose() * J;
      b += w * J.transpose() * samples[i].mode;
    }
    const Eigen::Vector4d x = A.ldlt().solve(b);
    result.offset = x.head<3>();
    result.radius_m = std::max(0.0, x[3]);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      distance[i] = (samples[i].mode + result.radius_m * samples[i].ray - result.offset).norm();
    }
  }
  std::sort(distance.begin(), distance.end());
  result.median_m = distance[distance.size() / 2];
  result.p95_m = distance[distance.size() * 95 / 100];
  return result;
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
    }
  });
  MarkerStatistics statistics;
  for (std::size_t part = 0; part < kPartCount; ++part) {
    std::vector<Sample> all;
    for (const Samples& chunk : parts) all.insert(all.end(), chunk[part].begin(), chunk[part].end());
    statistics.parts[part] = fit(all);
  }
  return statistics;
}

}  // namespace depthmocap
