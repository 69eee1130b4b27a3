#include "libtracker/segment/components.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "libtracker/segment/depth_noise.h"

namespace depthmocap {

namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).

// Share of a component's cells that must be somebody's for the component to be.
constexpr float kKnownShare = 0.2F;
// [cells] Smaller components have no thickness and are never mistaken for a panel.
constexpr int kMinCellsForThickness = 30;

struct Step {
  int x;
  int y;
};
// Half of the neighbours (the other half sees this cell as theirs), then the same one cell farther.
constexpr std::array<Step, 4> kNear{{{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
constexpr std::array<Step, 2> kFar{{{-2, 0}, {0, -2}}};

}  // namespace

std::int32_t ComponentFinder::root(std::int32_t cell) {
  auto at = [&](std::int32_t i) -> std::int32_t& { return parent_[static_cast<std::size_t>(i)]; };
  while (at(cell) != cell) {
    at(cell) = at(at(cell));
    cell = at(cell);
  }
  return cell;
}

// Two roots, unless they are known to belong to different people.
void ComponentFinder::connect(std::int32_t a, std::int32_t b) {
  const Identity who_a = who_[static_cast<std::size_t>(a)];
  const Identity who_b = who_[static_cast<std::size_t>(b)];
  if (who_a != who_b && who_a != kUnknown && who_b != kUnknown) return;
  parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  who_[static_cast<std::size_t>(std::min(a, b))] = who_a != kUnknown ? who_a : who_b;
}

void ComponentFinder::connectCells(const CoarseCloud& cloud, const std::vector<std::uint8_t>& keep, float gap_m) {
  parent_.resize(cloud.points.size());
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      const std::size_t i = cloud.index(x, y);
      const Eigen::Vector3f& p = cloud.points[i];
      const bool used = keep[i] != 0 && p.z() > 0;
      parent_[i] = used ? static_cast<std::int32_t>(i) : kNoComponent;
      if (!used) continue;
      const float gap = gap_m * gapGrowth(p.z());
      const auto tryJoin = [&](const Step& step) {
        const int nx = x + step.x;
        const int ny = y + step.y;
        if (nx < 0 || ny < 0 || nx >= cloud.width) return;
        const std::size_t j = cloud.index(nx, ny);
        if (parent_[j] == kNoComponent || (cloud.points[j] - p).squaredNorm() > gap * gap) return;
        connect(root(static_cast<std::int32_t>(i)), root(static_cast<std::int32_t>(j)));
      };
      for (const Step& step : kNear) tryJoin(step);
      for (const Step& step : kFar) tryJoin(step);
    }
  }
}

// Components are numbered in the order of their first cell.
void ComponentFinder::numberComponents() {
  labels_.assign(parent_.size(), kNoComponent);
  components_.clear();
  for (std::size_t i = 0; i < parent_.size(); ++i) {
    if (parent_[i] == kNoComponent) continue;
    const auto first = static_cast<std::size_t>(root(static_cast<std::int32_t>(i)));
    if (first == i) {
      labels_[i] = static_cast<std::int32_t>(components_.size());
      components_.emplace_back();
    } else {
      labels_[i] = labels_[first];
    }
  }
}

void ComponentFinder::measure(const CoarseCloud& cloud, const Eigen::Vector3f& up) {
  moments_.assign(components_.size(), Eigen::Matrix3d::Zero());
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      const std::size_t i = cloud.index(x, y);
      if (labels_[i] == kNoComponent) continue;
      const Eigen::Vector3f& p = cloud.points[i];
      const auto label = static_cast<std::size_t>(labels_[i]);
      Component& c = components_[label];
      const float height = up.dot(p);
      if (c.cells == 0) {
        c.low = c.high = p;
        c.bottom_m = c.top_m = height;
      }
      ++c.cells;
      c.area_m2 += cloud.cellArea(p.z());
      c.mean += p;
      c.low = c.low.cwiseMin(p);
      c.high = c.high.cwiseMax(p);
      c.bottom_m = std::min(c.bottom_m, height);
      c.top_m = std::max(c.top_m, height);
      c.touches_side |= x == 0 || x == cloud.width - 1;
      c.touches_border |= c.touches_side || y == 0 || y == cloud.height - 1;
      const Eigen::Vector3d pd = p.cast<double>();
      moments_[label].noalias() += pd * pd.transpose();
    }
  }
  for (std::size_t k = 0; k < components_.size(); ++k) {
    Component& c = components_[k];
    c.mean /= static_cast<float>(c.cells);
    if (c.cells < kMinCellsForThickness) continue;
    const Eigen::Vector3d mean = c.mean.cast<double>();
    const Eigen::Matrix3d covariance = moments_[k] / c.cells - mean * mean.transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(covariance, Eigen::EigenvaluesOnly);
    c.thickness_m = static_cast<float>(std::sqrt(std::max(0.0, solver.eigenvalues()[0])));
  }
}

void ComponentFinder::identify(std::span<const Identity> known) {
  known_cells_.assign(components_.size(), 0);
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (labels_[i] == kNoComponent || known[i] == kUnknown) continue;
    const auto label = static_cast<std::size_t>(labels_[i]);
    components_[label].who = known[i];
    ++known_cells_[label];
  }
  for (std::size_t k = 0; k < components_.size(); ++k) {
    Component& c = components_[k];
    if (static_cast<float>(known_cells_[k]) < kKnownShare * static_cast<float>(c.cells)) c.who = kUnknown;
  }
}

void ComponentFinder::find(const CoarseCloud& cloud, const std::vector<std::uint8_t>& keep, double gap_m,
                           const Eigen::Vector3f& up, std::span<const Identity> known) {
  who_.assign(cloud.points.size(), kUnknown);
  std::copy(known.begin(), known.end(), who_.begin());
  connectCells(cloud, keep, static_cast<float>(gap_m));
  numberComponents();
  describe(cloud, up, known);
}

void ComponentFinder::describe(const CoarseCloud& cloud, const Eigen::Vector3f& up, std::span<const Identity> known) {
  measure(cloud, up);
  identify(known);
}

}  // namespace depthmocap
