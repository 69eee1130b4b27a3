#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/terminal/output_check.h"
#include "forest/render/room_view.h"
#include "forest/train/pose_pool.h"
#include "forest/train/rendered_image_source.h"

namespace CLI {
class App;
}

namespace depthmocap {

// Where the images of a forest command come from.
struct DataOptions {
  std::vector<std::string> pose_databases;
  bool procedural = false;
  std::string makehuman;
  bool t_pose = false;
  bool rooms = false;
  bool plain = false;
  double posture_share = 0;
  double sitter_share = RoomViewConfig{}.sitter_share;  // of rooms
  std::optional<double> carried_share;                  // none: TrainingViewConfig's, or 0 with plain
  std::optional<double> obstacle_share;                 // likewise
  std::vector<std::string> exclude;
  int bodies = 200;
  std::uint64_t seed = 1;
  int threads = 2;
};

void addDataOptions(CLI::App& command, DataOptions& data);

// Tells `check` of the files that makeImageSet() reads.
void readsData(OutputCheck& check, const DataOptions& data);

// Bodies, poses and the images made of them.
struct ImageSet {
  std::shared_ptr<const std::vector<BodySurface>> bodies;
  std::shared_ptr<const PosePool> poses;
  std::unique_ptr<TrainingImageSource> source;
  TrainingViewConfig view;  // from where people are looked at, without rooms
  // The first `count` of them.
  std::function<std::unique_ptr<TrainingImageSource>(std::size_t count)> first;
};

// `use` decides about poses, bodies and views: what measures a forest never meets what taught it.
ImageSet makeImageSet(const DataOptions& data, PoseUse use, std::size_t images);

}  // namespace depthmocap
