#include "libtracker/clinical/movement_events.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace depthmocap {
namespace {

// A tenth of a long step: sway and the noise of tracking stay below.
constexpr double kLeastSwing_m = 0.12;    // [m] a foot moves to and fro against the pelvis in a step
constexpr double kFootDown_m = 0.12;      // [m] above the floor; a foot put down heel first is tracked about so high
constexpr double kOffTheFloor_m = 0.05;   // [m] about twice the error of a tracked ankle
constexpr double kLeastFlight_s = 0.1;    // [s] three frames; a hop of 1 cm takes 0.1 s, too
constexpr double kSeatedKnee_deg = 60;    // [deg] chairs bend knees to 90, high stools to 60
constexpr double kStandingKnee_deg = 30;  // [deg] old people stand so
constexpr double kLeastRest_s = 0.5;      // [s] at least so long the hips rest on a seat; in a squat they turn at once
constexpr double kRestingHips_m = 0.05;   // [m] so far rest lets them move
constexpr double kLongestRise_s = 4.0;    // [s] the frail need so long
constexpr double kLeastRise_m = 0.15;     // [m] a high stool

using Rows = std::span<const AnglesRow>;

double knee(const AnglesRow& row) {
  static const int left = clinicalAngleIndex("left_knee_flexion");
  static const int right = clinicalAngleIndex("right_knee_flexion");
  return 0.5 * (row.angles[left] + row.angles[right]);
}

double lowerSole(const AnglesRow& row) {
  return std::min(row.signals.left_sole_y_m, row.signals.right_sole_y_m);
}

// The height where the lower sole mostly is.
double floorHeight(const std::vector<AnglesRow>& rows) {
  std::vector<double> soles;
  for (const AnglesRow& row : rows) {
    if (row.state != TrackState::Lost) soles.push_back(lowerSole(row));
  }
  if (soles.empty()) return 0;
  const auto middle = soles.begin() + static_cast<std::ptrdiff_t>(soles.size() / 2);
  std::nth_element(soles.begin(), middle, soles.end());
  return *middle;
}

// Unbroken runs of frames with a pose.
std::vector<Rows> runsOf(const std::vector<AnglesRow>& rows) {
  std::vector<Rows> runs;
  const auto tracked = [](const AnglesRow& row) { return row.state != TrackState::Lost; };
  for (auto first = rows.begin(); first != rows.end();) {
    first = std::find_if(first, rows.end(), tracked);
    const auto last = std::find_if_not(first, rows.end(), tracked);
    if (first != last) runs.emplace_back(first, last);
    first = last;
  }
  return runs;
}

// Maxima between falls of at least kLeastSwing_m on both sides, where the foot is before the other one, too: in a squat
// both go to and fro against the pelvis.
void steps(Rows rows, MovementKind kind, double BodySignals::*ahead, double BodySignals::*other_ahead,
           double BodySignals::*sole, double floor_y, std::vector<MovementEvent>& events) {
  double low = rows.front().signals.*ahead;
  const AnglesRow* peak = nullptr;
  for (const AnglesRow& row : rows) {
    const double now = row.signals.*ahead;
    if (peak == nullptr) {
      low = std::min(low, now);
      if (now > low + kLeastSwing_m) peak = &row;
      continue;
    }
    if (now > peak->signals.*ahead) peak = &row;
    if (now > peak->signals.*ahead - kLeastSwing_m) continue;
    const bool is_before = peak->signals.*ahead > std::max(0.0, peak->signals.*other_ahead + kLeastSwing_m);
    if (is_before && peak->signals.*sole < floor_y + kFootDown_m) {
      events.push_back({kind, peak->time_s, peak->time_s});
    }
    low = now;
    peak = nullptr;
  }
}

void jumps(Rows rows, double floor_y, std::vector<MovementEvent>& events) {
  const auto flies = [&](const AnglesRow& row) { return lowerSole(row) > floor_y + kOffTheFloor_m; };
  for (auto first = rows.begin(); first != rows.end();) {
    first = std::find_if(first, rows.end(), flies);
    const auto last = std::find_if_not(first, rows.end(), flies);
    // What begins or ends out of sight is none: somebody may hang.
    if (first != last && first != rows.begin() && last != rows.end() &&
        last->time_s - first->time_s >= kLeastFlight_s) {
      events.push_back({MovementKind::Jump, first->time_s, std::prev(last)->time_s});
    }
    first = last;
  }
}

// Whether the hips rested up to row `i` with bent knees.
bool restsUntil(Rows rows, std::size_t i) {
  const double here = rows[i].signals.pelvis_y_m;
  for (std::size_t k = i;; --k) {
    if (knee(rows[k]) < kSeatedKnee_deg || std::abs(rows[k].signals.pelvis_y_m - here) > kRestingHips_m) return false;
    if (rows[i].time_s - rows[k].time_s >= kLeastRest_s) return true;
    if (k == 0) return false;
  }
}

void risings(Rows rows, std::vector<MovementEvent>& events) {
  const AnglesRow* seated = nullptr;  // the last row at rest
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (restsUntil(rows, i)) {
      seated = &rows[i];
      continue;
    }
    if (seated == nullptr) continue;
    const bool stands =
        knee(rows[i]) < kStandingKnee_deg && rows[i].signals.pelvis_y_m > seated->signals.pelvis_y_m + kLeastRise_m;
    if (stands) events.push_back({MovementKind::SitToStand, seated->time_s, rows[i].time_s});
    if (stands || rows[i].time_s - seated->time_s > kLongestRise_s) seated = nullptr;
  }
}

}  // namespace

std::vector<MovementEvent> findMovements(const std::vector<AnglesRow>& rows) {
  const double floor_y = floorHeight(rows);
  std::vector<MovementEvent> events;
  for (const Rows run : runsOf(rows)) {
    const auto left = &BodySignals::left_foot_ahead_m;
    const auto right = &BodySignals::right_foot_ahead_m;
    steps(run, MovementKind::LeftStep, left, right, &BodySignals::left_sole_y_m, floor_y, events);
    steps(run, MovementKind::RightStep, right, left, &BodySignals::right_sole_y_m, floor_y, events);
    jumps(run, floor_y, events);
    risings(run, events);
  }
  std::ranges::stable_sort(events, {}, &MovementEvent::start_s);
  return events;
}

}  // namespace depthmocap
