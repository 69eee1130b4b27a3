#include "libtracker/segment/hidden_part.h"

#include <array>

namespace depthmocap {
namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).

// [cells] Widest unmeasured seam at an edge, across which something in front is looked for.
constexpr int kReach = 2;
// [cells] Least of the outline that something covers.
constexpr int kMinCells = 8;
// Least covered share of the actor's cells.
constexpr float kMinShare = 0.01F;
// [cells] How far below somebody's lowest cell something in front is looked for: edges of stereo cameras are ramps.
constexpr int kReachBelow = 4;
// [m] Legs that end higher above the floor than this are not in view down to the feet.
constexpr float kEndsAbove_m = 0.35F;
// Least share of somebody's cells that stand in columns whose lower end is not in view.
constexpr float kCutShare = 0.5F;
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

bool isCutBelow(const CoarseCloud& cloud, const std::vector<std::uint8_t>& keep,
                const std::vector<std::int32_t>& labels, const std::vector<std::uint8_t>& selected,
                const std::optional<Eigen::Vector4f>& floor) {
  const auto isActor = [&](std::size_t i) {
    return labels[i] >= 0 && selected[static_cast<std::size_t>(labels[i])] != 0;
  };
  const auto endsHere = [&](int x, int lowest) {
    const Eigen::Vector3f& p = cloud.points[cloud.index(x, lowest)];
    if (floor && floor->head<3>().dot(p) + (*floor)[3] > kEndsAbove_m) return true;
    for (int y = lowest + 1; y <= lowest + kReachBelow; ++y) {
      if (y >= cloud.height) return y <= lowest + kReach;
      const std::size_t j = cloud.index(x, y);
      const float z = cloud.points[j].z();
      if (z > 0 && keep[j] != 0 && z < p.z() - kInFront_m) return true;
    }
    return false;
  };
  int cells = 0;
  int cut = 0;
  for (int x = 0; x < cloud.width; ++x) {
    int lowest = -1;
    int column = 0;
    for (int y = 0; y < cloud.height; ++y) {
      if (!isActor(cloud.index(x, y))) continue;
      ++column;
      lowest = y;
    }
    if (column == 0) continue;
    cells += column;
    if (endsHere(x, lowest)) cut += column;
  }
  return static_cast<float>(cut) > kCutShare * static_cast<float>(cells);
}

}  // namespace depthmocap
