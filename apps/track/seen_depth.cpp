#include "apps/track/seen_depth.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace depthmocap {
namespace {

constexpr int kStep_px = 23;          // every so many pixels of a row and rows are looked at; no divisor of usual sizes
constexpr double kLeast_m = 0.001;    // [m] of the first bin
constexpr double kBinGrowth = 1.032;  // of a bin over the one before
constexpr double kTooNear_m = 0.5;    // [m] the tracker needs head and shoulders, which fill the picture here
constexpr double kNoUnit_m = 0.1;     // [m] nothing that a camera measures is so near: the unit is too small
constexpr double kNoRoom_m = 12.0;    // [m] nor so far: the unit is too large
constexpr double kHardlyAny = 0.05;   // share of the frames that were tracked, from which on nothing needs saying
constexpr double kMany = 0.5;         // share of the frames from which on a turned camera need not be thought of
constexpr double kMostlyEmpty = 0.02;  // share of the pixels that are measured, below which nothing can be seen

// Clockwise quarter turns of the picture after which the trunk points up in it.
std::size_t quarterTurnsOf(const JointPositions& p_camera) {
  const Eigen::Vector3d trunk =
      p_camera.col(static_cast<int>(Joint::Neck)) - p_camera.col(static_cast<int>(Joint::Pelvis));
  if (std::abs(trunk.x()) > std::abs(trunk.y())) return trunk.x() < 0 ? 1 : 3;
  return trunk.y() < 0 ? 0 : 2;
}

}  // namespace

void SeenDepth::onFrame(const SessionFrame& frame) {
  if (frame.tracked.state == TrackState::Tracking && !frame.tracked.floor_world) {
    ++tracked_[quarterTurnsOf(frame.tracked.joints_camera)];
  }
  const DepthImage& depth = frame.depth.depth;
  for (int y = kStep_px / 2; y < depth.height; y += kStep_px) {
    for (int x = kStep_px / 2; x < depth.width; x += kStep_px) {
      ++pixels_;
      const auto z = static_cast<double>(depth.at(x, y));
      if (!(z > 0)) continue;
      ++measured_;
      const double bin = std::log(std::max(z, kLeast_m) / kLeast_m) / std::log(kBinGrowth);
      ++bins_[static_cast<std::size_t>(std::min(bin, kBins - 1.0))];
    }
  }
}

double SeenDepth::percentile(double share) const {
  const auto wanted = static_cast<std::uint64_t>(share * static_cast<double>(measured_));
  std::uint64_t below = 0;
  for (int bin = 0; bin < kBins; ++bin) {
    below += bins_[static_cast<std::size_t>(bin)];
    if (below > wanted) return kLeast_m * std::pow(kBinGrowth, bin + 0.5);
  }
  return 0;
}

std::string SeenDepth::explanation(const TurnSearch& turn_that_helps) const {
  if (pixels_ == 0) return {};
  const double share = static_cast<double>(measured_) / static_cast<double>(pixels_);
  if (share < kMostlyEmpty) {
    return fmt::format("{:.0f} % of the pixels are measured: is the lens covered, or is nothing in the camera's range?",
                       100 * share);
  }
  const double low = percentile(0.05);
  const double high = percentile(0.95);
  const std::string seen =
      fmt::format("depth from {:.3g} to {:.3g} m, {:.0f} % of the pixels measured", low, high, 100 * share);
  if (high < kNoUnit_m) return seen + ": the unit of depth is too small (--depth-unit MM, millimetres a step)";
  if (low > kNoRoom_m) return seen + ": the unit of depth is too large (--depth-unit MM, millimetres a step)";
  if (high < kTooNear_m) return seen + ": too near, stand back until head and shoulders are in view";
  if (const std::optional<int> turn_deg = turn_that_helps()) {
    return fmt::format("{}: the pictures are turned, with --turn {} somebody is found", seen, *turn_deg);
  }
  return seen + ": nobody with the head in view, whichever way the pictures are turned";
}

std::optional<int> SeenDepth::turnIfUpright() const {
  const std::uint64_t all = std::accumulate(tracked_.begin(), tracked_.end(), std::uint64_t{0});
  for (std::size_t turns = 1; turns < tracked_.size(); ++turns) {
    if (2 * tracked_[turns] > all) return 90 * static_cast<int>(turns);
  }
  return std::nullopt;
}

std::string lyingText(const SeenDepth& seen) {
  const std::optional<int> turn_deg = seen.turnIfUpright();
  if (!turn_deg) return {};
  return fmt::format("; the person lies, and no floor is in view: if the camera is turned instead, add --turn {}",
                     *turn_deg);
}

std::string trackedText(std::size_t tracked, std::size_t frames, const SeenDepth& seen,
                        const TurnSearch& turn_that_helps) {
  std::string text = fmt::format("tracked {} of {} frames", tracked, frames);
  const double share = static_cast<double>(tracked) / std::max(1.0, static_cast<double>(frames));
  if (frames > 0 && share >= kMany) return text + lyingText(seen);
  if (frames > 0 && share >= kHardlyAny) {
    const std::optional<int> turn_deg = turn_that_helps();
    return turn_deg ? fmt::format("{}; the pictures seem turned, with --turn {} more are", text, *turn_deg) : text;
  }
  const std::string why = seen.explanation(turn_that_helps);
  return why.empty() ? text : text + "; " + why;
}

}  // namespace depthmocap
