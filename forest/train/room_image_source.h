#pragma once
#include <memory>
#include <string>
#include <vector>

#include "forest/render/room_view.h"
#include "forest/train/pose_pool.h"
#include "forest/train/renderer_pool.h"
#include "forest/train/training_image.h"

namespace depthmocap {

struct RoomImageOptions {
  std::size_t count = 20000;
  std::uint64_t seed = 1;
  RoomViewConfig view;
  PoseVariation variation;
};

// Random views of furnished rooms with people and without; labels are RoomClass. Image i depends on the options, the
// bodies, the poses and i alone.
class RoomImageSource : public TrainingImageSource {
 public:
  // Throws Error where there is no pose. Several sources may share bodies and poses.
  RoomImageSource(std::shared_ptr<const std::vector<BodySurface>> bodies, std::shared_ptr<const PosePool> poses,
                  const RoomImageOptions& options);

  [[nodiscard]] std::size_t count() const override { return options_.count; }
  [[nodiscard]] std::string description() const override;
  void render(std::size_t i, TrainingImage& image) override;

 private:
  std::shared_ptr<const std::vector<BodySurface>> bodies_;
  std::shared_ptr<const PosePool> poses_;
  RoomImageOptions options_;
  RendererPool<RoomViewRenderer> renderers_;
};

}  // namespace depthmocap
