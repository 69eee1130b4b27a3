#include "libtracker/classify/actor_depth.h"

#include <cstring>

#include "libtracker/classify/forest.h"

namespace depthmocap {
namespace {

struct Box {
  int x0, y0, x1, y1;  // x1, y1 exclusive; empty where x1 <= x0
};

// Most of a mask is empty: eight pixels are passed at a time.
bool eightUnset(const std::uint8_t* mask) {
  std::uint64_t eight = 0;
  std::memcpy(&eight, mask, sizeof eight);
  return eight == 0;
}

const std::uint8_t* firstSet(const std::uint8_t* begin, const std::uint8_t* end) {
  while (end - begin >= 8 && eightUnset(begin)) begin += 8;
  return std::find_if(begin, end, [](std::uint8_t m) { return m != 0; });
}

const std::uint8_t* behindLastSet(const std::uint8_t* begin, const std::uint8_t* end) {
  while (end - begin >= 8 && eightUnset(end - 8)) end -= 8;
  while (end > begin && end[-1] == 0) --end;
  return end;
}

Box actorBox(const DepthImage& depth, const MaskImage& mask) {
  Box box{depth.width, depth.height, 0, 0};
  for (int y = 0; y < depth.height; ++y) {
    const std::uint8_t* row = mask.data.data() + mask.index(0, y);
    const std::uint8_t* end = row + mask.width;
    const std::uint8_t* first = firstSet(row, end);
    if (first == end) continue;
    end = behindLastSet(row, end);
    box.x0 = std::min(box.x0, static_cast<int>(first - row));
    box.x1 = std::max(box.x1, static_cast<int>(end - row));
    box.y0 = std::min(box.y0, y);
    box.y1 = y + 1;
  }
  return box;
}

}  // namespace

void cutOutActor(const DepthImage& depth, const MaskImage& mask, ActorDepth& actor) {
  const Box box = actorBox(depth, mask);
  actor.left = box.x0;
  actor.top = box.y0;
  actor.width = std::max(0, box.x1 - box.x0);
  actor.height = std::max(0, box.y1 - box.y0);
  const auto pitch = static_cast<std::size_t>(actor.pitch());
  actor.depth_m.assign(pitch * static_cast<std::size_t>(actor.height + 2), kBackgroundDepth_m);
  for (int y = 0; y < actor.height; ++y) {
    const float* from = depth.data.data() + depth.index(box.x0, box.y0 + y);
    const std::uint8_t* inside = mask.data.data() + mask.index(box.x0, box.y0 + y);
    float* to = actor.depth_m.data() + static_cast<std::size_t>(y + 1) * pitch + 1;
    for (int x = 0; x < actor.width; ++x) {
      const bool on_actor = (inside[x] != 0) & (from[x] > 0.0F);  // no short cut: so the loop becomes vectors
      to[x] = on_actor ? from[x] : kBackgroundDepth_m;
    }
  }
}

float probeScale(double focal_px, float depth_m) {
  return static_cast<float>(focal_px / kReferenceFocal_px) / std::max(depth_m, kNearestProbeDepth_m);
}

}  // namespace depthmocap
