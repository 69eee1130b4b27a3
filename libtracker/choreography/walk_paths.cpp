#include "libtracker/choreography/walk_paths.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libtracker/choreography/easing.h"
#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

struct NamedPath {
  std::string name;
  NumberNames numbers;
  WalkPath (*make)(const Numbers&);
};

WalkPath straight(const Numbers& n) {
  return straightPath(n.get("forward"), n.get("sideways"), n.get("turn_rate"));
}

// Laps of a circle, facing along it (turns = 1) or always the same way (0).
WalkPath circle(const Numbers& n) {
  const double radius = n.get("radius");
  const double lap_s = n.get("lap_s");
  const double turns = n.get("turns");
  return [=](double t) {
    const double a = 2 * std::numbers::pi * t / lap_s;
    return PathPoint{radius * (1 - std::cos(a)), radius * std::sin(a), turns * a};
  };
}

// To and fro on a short line with turns, within the view of one camera.
WalkPath toAndFro(const Numbers& n) {
  constexpr double kTurnEarly = 0.3;  // [s] the turn begins this long before the line ends; by hand
  const double length = n.get("length");
  const double leg_s = n.get("leg_s");
  const double turn_s = n.get("turn_s");
  return [=](double t) {
    const double lap = leg_s + turn_s;
    const double laps = std::floor(t / lap);
    const double s = t - laps * lap;
    const bool forth = static_cast<int>(laps) % 2 == 0;
    const double along = length * minimumJerk(s / leg_s);
    return PathPoint{0, forth ? along : length - along,
                     std::numbers::pi * (laps + smoothStep((s - leg_s + kTurnEarly) / turn_s))};
  };
}

// A turn on the spot.
WalkPath onTheSpot(const Numbers& n) {
  const double angle = n.get("angle");
  const double turn_s = n.get("turn_s");
  const double start_s = n.get("start_s");
  return [=](double t) { return PathPoint{0, 0, angle * smoothStep((t - start_s) / turn_s)}; };
}

const std::vector<NamedPath>& paths() {
  static const std::vector<NamedPath> all = {
      {"straight", {{"forward", "seconds"}, {"sideways", "turn_rate"}}, &straight},
      {"stairs", {{"forward", "seconds", "rise", "tread"}, {}}, &straight},
      {"circle", {{"radius", "lap_s", "turns", "seconds"}, {}}, &circle},
      {"to_and_fro", {{"length", "leg_s", "turn_s", "seconds"}, {}}, &toAndFro},
      {"on_the_spot", {{"angle", "turn_s", "start_s", "seconds"}, {}}, &onTheSpot},
  };
  return all;
}

const NamedPath* findPath(std::string_view name) {
  const auto found = std::find_if(paths().begin(), paths().end(), [&](const auto& path) { return path.name == name; });
  return found == paths().end() ? nullptr : &*found;
}

// Stairs along z; down them starts so high that the last step of the walk is above 0.
GroundHeight stairs(const Numbers& n) {
  constexpr double kSpareSteps = 2.0;  // beyond what the pelvis passes: the foot in front; by hand
  const double rise = n.get("rise");
  const double tread = n.get("tread");
  const double passed = n.get("forward") * n.get("seconds") / tread;
  const double first = rise > 0 ? 0.0 : -rise * std::ceil(passed + kSpareSteps);
  return [=](double, double z) { return first + rise * std::max(0.0, std::floor(z / tread)); };
}

}  // namespace

std::vector<std::string> walkPathNames() {
  std::vector<std::string> names;
  for (const NamedPath& path : paths()) names.push_back(path.name);
  return names;
}

const NumberNames* walkNumbers(std::string_view path) {
  const NamedPath* found = findPath(path);
  return found == nullptr ? nullptr : &found->numbers;
}

BodyFrames walkAlongNamed(std::string_view path, const Numbers& numbers, const GaitStyle& style, double first_phase) {
  const NamedPath* found = findPath(path);
  DMC_CHECK(found != nullptr);
  const GroundHeight ground = numbers.has("rise") ? stairs(numbers) : GroundHeight{};
  return walkAlong(found->make(numbers), numbers.get("seconds"), style, first_phase, ground);
}

}  // namespace depthmocap
