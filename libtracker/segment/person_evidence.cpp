#include "libtracker/segment/person_evidence.h"

#include <algorithm>
#include <cmath>

#include "libtracker/segment/depth_noise.h"

namespace depthmocap {
namespace {

// Chosen on rendered rooms (docs/lab/rooms.md).

// Greatest logarithm of the odds that the classifier gives alone: one cell that errs is outvoted by its neighbours.
constexpr float kMostOdds = 3.0F;
// Logarithm of the odds that is added where the frame before had a person.
constexpr float kKnownOdds = 1.5F;
// Share of its evidence that a cell hands to its neighbour on the same surface: it fades to 1 / e over 5 cells. Written
// out: the exponential function of some machines differs in the last bit.
constexpr float kPassedOn = 0.8187308F;
// Rounds of smoothing: with one, evidence goes along rows and columns only.
constexpr int kRounds = 2;

float limited(float odds) {
  return std::clamp(odds, -kMostOdds, kMostOdds);
}

}  // namespace

void PersonEvidence::find(const CoarseCloud& cloud, const RoomMap& map, const std::vector<Identity>& known,
                          double gap_m) {
  readMap(cloud, map);
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] != kUnknown && cloud.points[i].z() > 0) odds_[i] += kKnownOdds;
  }
  measureSteps(cloud, static_cast<float>(gap_m));
  smooth(cloud);
}

// The map is coarser than the cloud: a cell takes what the nearest of the four map cells around it says that lies at
// about its depth, so that outlines stay where the depth has them.
void PersonEvidence::readMap(const CoarseCloud& cloud, const RoomMap& map) {
  odds_.assign(cloud.points.size(), 0.0F);
  shell_.assign(cloud.points.size(), 0.0F);
  for (int y = 0; y < cloud.height; ++y) {
    const float v = static_cast<float>(y * cloud.stride + cloud.offset - map.offset) / static_cast<float>(map.stride);
    for (int x = 0; x < cloud.width; ++x) {
      const std::size_t i = cloud.index(x, y);
      const float z = cloud.points[i].z();
      if (!(z > 0)) continue;
      const float u = static_cast<float>(x * cloud.stride + cloud.offset - map.offset) / static_cast<float>(map.stride);
      float best = 1e9F;
      const int across = u > std::floor(u) ? 1 : 0;  // on a column or row of the map fewer cells are around
      const int down = v > std::floor(v) ? 2 : 0;
      for (int k = 0; k < 4; ++k) {
        if ((k & ~(across | down)) != 0) continue;
        const int mx = std::clamp(static_cast<int>(u) + (k & 1), 0, map.width - 1);
        const int my = std::clamp(static_cast<int>(v) + (k >> 1), 0, map.height - 1);
        const std::size_t m = map.index(mx, my);
        if (map.measured[m] == 0) continue;
        const int cx = std::clamp((mx * map.stride + map.offset - cloud.offset) / cloud.stride, 0, cloud.width - 1);
        const int cy = std::clamp((my * map.stride + map.offset - cloud.offset) / cloud.stride, 0, cloud.height - 1);
        const float there = cloud.points[cloud.index(cx, cy)].z();
        const float away = std::abs(static_cast<float>(mx) - u) + std::abs(static_cast<float>(my) - v);
        const float cost = away + 20.0F * std::abs(there - z) / gapGrowth(z);
        if (cost >= best) continue;
        best = cost;
        odds_[i] = limited(map.person[m]);
        shell_[i] = map.shell[m];
      }
    }
  }
}

void PersonEvidence::measureSteps(const CoarseCloud& cloud, float gap_m) {
  right_.assign(cloud.points.size(), 0.0F);
  down_.assign(cloud.points.size(), 0.0F);
  const auto share = [&](std::size_t i, std::size_t j) {
    const float zi = cloud.points[i].z();
    const float zj = cloud.points[j].z();
    if (!(zi > 0 && zj > 0)) return 0.0F;
    const float step = std::abs(zi - zj) / (gap_m * gapGrowth(zi));
    return step >= 1.0F ? 0.0F : kPassedOn * (1.0F - step * step);
  };
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      const std::size_t i = cloud.index(x, y);
      if (x + 1 < cloud.width) right_[i] = share(i, i + 1);
      if (y + 1 < cloud.height) down_[i] = share(i, cloud.index(x, y + 1));
    }
  }
}

// Each row, then each column, becomes the mean of its cells weighted by the product of the shares on the way (a
// recursive edge-preserving filter: Gastal and Oliveira 2011).
void PersonEvidence::smooth(const CoarseCloud& cloud) {
  const auto line = [&](std::size_t first, std::size_t step, int count, const std::vector<float>& share) {
    there_.resize(2 * static_cast<std::size_t>(count));
    float sum = 0;
    float weight = 0;
    for (int k = 0; k < count; ++k) {
      const std::size_t i = first + static_cast<std::size_t>(k) * step;
      const float pass = k > 0 ? share[i - step] : 0.0F;
      sum = pass * sum;
      weight = pass * weight;
      there_[2 * static_cast<std::size_t>(k)] = sum;
      there_[2 * static_cast<std::size_t>(k) + 1] = weight;
      sum += odds_[i];
      weight += 1.0F;
    }
    sum = 0;
    weight = 0;
    for (int k = count - 1; k >= 0; --k) {
      const std::size_t i = first + static_cast<std::size_t>(k) * step;
      const float pass = k + 1 < count ? share[i] : 0.0F;
      sum = pass * sum;
      weight = pass * weight;
      const float before = odds_[i];
      odds_[i] = (there_[2 * static_cast<std::size_t>(k)] + before + sum) /
                 (there_[2 * static_cast<std::size_t>(k) + 1] + 1.0F + weight);
      sum += before;
      weight += 1.0F;
    }
  };
  const auto width = static_cast<std::size_t>(cloud.width);
  for (int round = 0; round < kRounds; ++round) {
    for (int y = 0; y < cloud.height; ++y) line(cloud.index(0, y), 1, cloud.width, right_);
    for (int x = 0; x < cloud.width; ++x) line(cloud.index(x, 0), width, cloud.height, down_);
  }
}

}  // namespace depthmocap
