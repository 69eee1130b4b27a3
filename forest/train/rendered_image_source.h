#pragma once
#include <memory>
#include <string>
#include <vector>

#include "forest/render/training_view.h"
#include "forest/train/pose_pool.h"
#include "forest/train/renderer_pool.h"
#include "forest/train/training_image.h"
#include "libtracker/body/body_surface.h"

namespace depthmocap {

// Bodies to render, made once: half of them from each family where there are two.
struct BodyPoolOptions {
  int count = 200;               // (>= 1)
  std::string makehuman_folder;  // of the MakeHuman base mesh; empty = built-in bodies only
  std::uint64_t seed = 1;
};
std::vector<BodySurface> makeBodyPool(const BodyPoolOptions& options, int threads);

struct RenderedImageOptions {
  std::size_t count = 20000;
  std::uint64_t seed = 1;
  TrainingViewConfig view;
  PoseVariation variation;
  bool t_poses = false;  // T-poses instead of those of the pool, facing the camera
};

// Random views of random bodies in random poses. Image i depends on the options, the bodies, the poses and i alone.
class RenderedImageSource : public TrainingImageSource {
 public:
  // Throws Error where there is no pose and T-poses are not asked for. Several sources may share bodies and poses.
  RenderedImageSource(std::shared_ptr<const std::vector<BodySurface>> bodies, std::shared_ptr<const PosePool> poses,
                      const RenderedImageOptions& options);

  [[nodiscard]] std::size_t count() const override { return options_.count; }
  [[nodiscard]] std::string description() const override;
  void render(std::size_t i, TrainingImage& image) override;

 private:
  std::shared_ptr<const std::vector<BodySurface>> bodies_;
  std::shared_ptr<const PosePool> poses_;
  RenderedImageOptions options_;
  RendererPool<TrainingViewRenderer> renderers_;
};

}  // namespace depthmocap
