#include "forest/train/rendered_image_source.h"

#include <optional>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/body/makehuman_model.h"
#include "libtracker/body/sample_body.h"
#include "libtracker/core/parallel.h"
#include "libtracker/core/random.h"
#include "libtracker/skeleton/facing_of.h"

namespace depthmocap {
namespace {

constexpr std::uint64_t kBodyStream = 0x424F;
constexpr std::uint64_t kViewStream = 0x5649;

// An actor who is asked for a T-pose looks at the camera and stands in view.
void askForTPose(TrainingViewConfig& view) {
  view.facing_share = 1.0;
  view.facing_range = 0.5;
  view.min_distance_m = 1.5;
  view.cut_share = 0.03;
  view.carried_share = 0;
  view.obstacle_share = 0;
}

}  // namespace

std::vector<BodySurface> makeBodyPool(const BodyPoolOptions& options, int threads) {
  if (options.count < 1) throw Error("at least one body is needed", "bodies");
  std::optional<MakeHumanModel> makehuman;
  if (!options.makehuman_folder.empty()) makehuman.emplace(options.makehuman_folder);
  std::vector<BodySurface> bodies(static_cast<std::size_t>(options.count));
  parallelFor(threads, bodies.size(), [&](std::size_t i) {
    Random random(options.seed + i, kBodyStream);
    bodies[i] = sampleDressedBody(random, makehuman ? &*makehuman : nullptr);
  });
  return bodies;
}

RenderedImageSource::RenderedImageSource(std::shared_ptr<const std::vector<BodySurface>> bodies,
                                         std::shared_ptr<const PosePool> poses, const RenderedImageOptions& options)
    : bodies_(std::move(bodies)), poses_(std::move(poses)), options_(options) {
  if (!options.t_poses && poses_->poses.empty()) {
    throw Error("no poses to render", "poses", "name a pose database with --posedb or use --procedural");
  }
  if (options_.t_poses) askForTPose(options_.view);
}

std::string RenderedImageSource::description() const {
  return fmt::format("{} images of {} bodies, {}, seed {}", options_.count, bodies_->size(),
                     options_.t_poses ? "T-poses" : poses_->description, options_.seed);
}

void RenderedImageSource::render(std::size_t i, TrainingImage& image) {
  Random random(options_.seed + i, kViewStream);
  const BodySurface& body = (*bodies_)[random.below(static_cast<std::uint32_t>(bodies_->size()))];
  const Pose q = options_.t_poses ? drawTPose(random) : drawPose(*poses_, options_.variation, random);
  TrainingView view;
  auto renderer = renderers_.take([this] { return std::make_unique<TrainingViewRenderer>(options_.view); });
  renderer->render(body, q, random, view);
  renderers_.giveBack(std::move(renderer));
  image.depth = std::move(view.depth);
  image.labels = std::move(view.parts);
  image.focal_px = view.camera.fx;
  image.facing = facingOf(view.q_world);
}

}  // namespace depthmocap
