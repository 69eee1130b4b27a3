#include "libtracker/segment/hidden_part.h"

#include <array>

namespace depthmocap {
namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).

// [cells] Widest unmeasured seam at an edge, across which something in front is looked for.
constexpr int kReach = 2;
// [m] What is nearer by this is in front: more than depth noise.
constexpr float kInFront_m = 0.15F;
// [cells] Least of the outline that something covers.
constexpr int kMinCells = 8;
// Least covered share of the actor's cells.
constexpr float kMinShare = 0.01F;
constexpr std::array<std::array<int, 2>, 4> kDirections{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

}  // namespace

bool isPartlyHidden(const CoarseCloud& cloud, const std::vector<std::uint8_t>& keep,
                    const std::vector<std::int32_t>& labels, const std::vector<std::uint8_t>& selected) {
  const auto isActor = [&](std::size_t i) {
    return labels[i] >= 0 && selected[static_cast<std::size_t>(labels[i])] != 0;
  };
  const auto isCovered = [&](int x, int y) {
    for (int step = 0; step < 4 * kReach; ++step) {
      const auto& direction = kDirections[static_cast<std::size_t>(step % 4)];
      const int nx = x + direction[0] * (1 + step / 4);
      const int ny = y + direction[1] * (1 + step / 4);
      if (nx < 0 || ny < 0 || nx >= cloud.width || ny >= cloud.height) continue;
      const std::size_t j = cloud.index(nx, ny);
      const float z = cloud.points[j].z();
      if (z > 0 && keep[j] != 0 && !isActor(j) && z < cloud.points[cloud.index(x, y)].z() - kInFront_m) return true;
    }
    return false;
  };
  int actor = 0;
  int covered = 0;
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      if (!isActor(cloud.index(x, y))) continue;
      ++actor;
      covered += isCovered(x, y) ? 1 : 0;
    }
  }
  return covered >= kMinCells && static_cast<float>(covered) > kMinShare * static_cast<float>(actor);
}

}  // namespace depthmocap
