#include "forest/train/room_image_source.h"

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

constexpr std::uint64_t kRoomStream = 0x524F;

}  // namespace

RoomImageSource::RoomImageSource(std::shared_ptr<const std::vector<BodySurface>> bodies,
                                 std::shared_ptr<const PosePool> poses, const RoomImageOptions& options)
    : bodies_(std::move(bodies)), poses_(std::move(poses)), options_(options) {
  if (poses_->poses.empty()) {
    throw Error("no poses to render", "poses", "name a pose database with --posedb or use --procedural");
  }
}

std::string RoomImageSource::description() const {
  return fmt::format("{} images of furnished rooms with {} bodies, {}, seed {}", options_.count, bodies_->size(),
                     poses_->description, options_.seed);
}

void RoomImageSource::render(std::size_t i, TrainingImage& image) {
  Random random(options_.seed + i, kRoomStream);
  RoomView view;
  auto renderer = renderers_.take([this] { return std::make_unique<RoomViewRenderer>(options_.view); });
  renderer->render(
      *bodies_, [&](Random& r) { return drawPose(*poses_, options_.variation, r); }, random, view);
  renderers_.giveBack(std::move(renderer));
  image.depth = std::move(view.depth);
  image.labels = std::move(view.classes);
  image.focal_px = view.camera.fx;
  image.facing.reset();
}

}  // namespace depthmocap
