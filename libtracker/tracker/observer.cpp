#include "libtracker/tracker/observer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libtracker/classify/forest.h"
#include "libtracker/classify/side_expectation.h"
#include "libtracker/skeleton/facing_of.h"
#include "libtracker/tracker/alignment.h"

namespace depthmocap {
namespace {

// The stride is that of a usual focal length: a coarser image is looked at more closely.
ClassifyConfig forCamera(ClassifyConfig config, int threads, const CameraModel& camera) {
  config.threads = threads;
  config.stride = std::max(1, static_cast<int>(std::lround(config.stride * camera.fx / kReferenceFocal_px)));
  return config;
}

// A few hundred of the classified pixels, spread evenly.
void sampleSurface(const CameraModel& camera, const Eigen::Matrix3d& R_world_camera, Evidence& evidence) {
  evidence.samples.clear();
  const std::size_t count = evidence.pixels.pixels.size();
  const std::size_t wanted = std::min<std::size_t>(count, kMaxSurfaceMatches);
  for (std::size_t i = 0; i < wanted; ++i) {
    const auto& pixel = evidence.pixels.pixels[i * count / wanted];
    const Eigen::Vector3d p_camera = camera.unproject(pixel.x, pixel.y, static_cast<double>(pixel.depth_m));
    evidence.samples.push_back({(R_world_camera * p_camera).cast<float>(), pixel.probability});
  }
}

}  // namespace

Observer::Observer(std::shared_ptr<const PartClassifier> classifier, const CameraModel& camera,
                   const TrackerConfig& config)
    : classifier_(std::move(classifier)),
      camera_(camera),
      config_(forCamera(config.classify, config.threads, camera)),
      expect_sides_(config.policy.expect_sides),
      memory_(classifier_->newMemory()),
      finder_(config.markers) {}

void Observer::label(const DepthFrame& frame, const PersonRegion& actor, const Prediction& prediction,
                     Evidence& evidence) {
  const bool expected = prediction.has_pose && expect_sides_;
  ClassifyConfig config = config_;
  if (expected) config.facing_prior = expectedFacing(prediction.q);
  classifier_->classify(frame.depth, actor.mask, camera_, config, *memory_, evidence.pixels);
  if (expected) expectSides(prediction.joints_camera, camera_, config_.threads, evidence.pixels);
}

void Observer::locate(const PartRadii& radii_m, const Prediction* prediction, const Eigen::Matrix3d& R_world_camera,
                      Evidence& evidence) {
  const MarkerSet* expected = prediction != nullptr && prediction->has_pose ? &prediction->markers_camera : nullptr;
  finder_.find(evidence.pixels, camera_, radii_m, expected, evidence.markers_camera);
  if (known_markers_) evidence.markers_camera = *known_markers_;
  evidence.markers_world = rotated(R_world_camera, evidence.markers_camera);
  sampleSurface(camera_, R_world_camera, evidence);
}

void Observer::assume(Facing facing, const Evidence& seen, const PartRadii& radii_m,
                      const Eigen::Matrix3d& R_world_camera, Evidence& supposed) {
  FacingShares certain{};
  certain[static_cast<std::size_t>(facing)] = 1.0F;
  supposed.pixels = seen.pixels;
  classifier_->assumeFacing(certain, config_.threads, *memory_, supposed.pixels);
  locate(radii_m, nullptr, R_world_camera, supposed);
}

}  // namespace depthmocap
