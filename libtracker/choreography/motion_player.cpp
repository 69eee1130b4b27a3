#include "libtracker/choreography/motion_player.h"

#include <algorithm>
#include <cmath>

#include "depthmocap/error.h"
#include "libtracker/choreography/flight.h"
#include "libtracker/choreography/guided_hands.h"
#include "libtracker/choreography/performance_scope.h"
#include "libtracker/choreography/postures.h"
#include "libtracker/choreography/walk_paths.h"

namespace depthmocap {
namespace {

constexpr double kMaxSeconds = 120.0;  // [s] of a motion; by hand, far above the longest of ours (13 s)
constexpr int kMaxSteps = 10000;       // of a performance; by hand, far above the most of ours (some hundreds)

class MotionPlayer {
 public:
  MotionPlayer(const Places& places, int variant, const Skeleton& skeleton, Random& random)
      : scope_(places, variant, random), skeleton_(skeleton), random_(random) {}

  RawMotion perform(const MotionScript& motion) {
    runAll(motion.steps);
    if (frames_.empty())
      throw Error("has no frames", motion.where, "end it with \"play\", \"walk\" or a line of hands");
    for (const Flight& flight : flights_) fly(flight, frames_);
    return {std::move(frames_)};
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& advice = {}) const {
    throw Error(what, *where_, advice);
  }

  void runAll(const Steps& steps) {
    for (const Step& step : steps) {
      where_ = &step.where;
      if (++step_count_ > kMaxSteps) fail("is a motion that does not end", "let it repeat less");
      std::visit([&](const auto& action) { run(action); }, step.action);
    }
  }

  void run(const LetStep& step) {
    for (const auto& [name, value] : step.values) scope_.let(name, value);
  }
  void run(const PoseStep& step) { scope_.setPose(step.name, changed(pose(step.from), step.change)); }
  void run(const SetStep& step) {
    if (scope_.keys().keys().empty()) fail("there is no key to set", "begin with \"after\": 0");
    scope_.change(step.change, scope_.keys().last());
  }
  void run(const KeyStep& step) {
    KeySequence& keys = scope_.keys();
    const double after_s = scope_.number(step.after_s);
    const double time_s = keys.end() + after_s;
    const bool in_order = keys.keys().empty() ? time_s >= 0 : time_s > keys.end();
    if (!in_order) fail("\"after\" is not above 0", "keys stand in the order of time");
    if (time_s > kMaxSeconds) fail("is a motion that does not end", "let it repeat less");
    scope_.change(step.change, keys.add(pose(step.from), after_s));
  }

  void run(const RepeatStep& step) {
    const double count = scope_.number(step.count);
    if (count < 0 || count != std::floor(count)) fail("\"repeat\" is not a whole number of times");
    const std::string* where = where_;
    for (double i = 0; i < count; ++i) {
      if (!step.as.empty()) scope_.let(step.as, i);
      runAll(step.steps);
      where_ = where;
      if (++step_count_ > kMaxSteps) fail("is a motion that does not end", "let it repeat less");
    }
  }
  void run(const ChoiceStep& step) {
    const double value = scope_.number(step.index);
    const double index = step.is_condition ? (value != 0.0 ? 1.0 : 0.0) : value;
    runAll(step.of[chosenIndex(index, step.of.size(), *where_)]);
  }
  void run(const PartStep& step) { runAll(*step.steps); }

  void run(const PlayStep& step) {
    const Numbers numbers = scope_.numbers(step.numbers);
    const double tempo = numbers.has("tempo") ? numbers.get("tempo") : random_.uniform(0.85, 1.15);
    if (tempo <= 0) fail("\"tempo\" is not above 0");
    if (scope_.keys().keys().size() < 2) fail("there are not two keys to play");
    if (scope_.keys().end() / tempo > kMaxSeconds) fail("is a motion that does not end", "raise \"tempo\"");
    const double spread = numbers.get("spread", 0.03);
    const Performance usual;
    const Performance performance{.tempo = tempo,
                                  .hand_spread = spread,
                                  .angle_spread = numbers.get("angle_spread", 1.3 * spread),
                                  .heel_rise = numbers.get("heel_rise", usual.heel_rise),
                                  .hops = numbers.get("hops") != 0.0};
    if (is_played_) fail("the keys are played already", "keep one \"play\"");
    is_played_ = true;
    BodyFrames played = playKeys(skeleton_, scope_.keys(), performance, random_);
    if (frames_.empty()) {
      frames_ = std::move(played);
    } else {
      overlayUpperBody(played, frames_);
    }
  }
  void run(const FlightStep& step) {
    const Numbers n = scope_.numbers(step.numbers);
    if (n.get("height") < 0) fail("\"height\" is below 0");
    flights_.push_back({n.get("start_s", scope_.keys().end()), n.get("height"), n.get("tuck"), n.get("sideways"),
                        n.get("forward"), n.get("turn")});
  }

  void run(const OrbitStep& step) {
    Orbit orbit{.center = scope_.hand(step.center)};
    const Numbers n = scope_.numbers(step.numbers);
    orbit.out = n.get("out");
    orbit.up = n.get("up");
    orbit.forward = n.get("forward");
    orbit.up_frequency = n.get("up_frequency", orbit.up_frequency);
    orbit.up_phase = n.get("up_phase", orbit.up_phase);
    orbit.round_s = n.get("round_s");
    orbit.rounds = n.get("rounds");
    orbit.both = n.get("both") != 0.0;
    orbit.apart = n.get("apart");
    orbit.follow = n.get("follow");
    checkSeconds(std::min(orbit.round_s, orbit.rounds * orbit.round_s), "round_s");
    checkSeconds(orbit.rounds * orbit.round_s, "rounds");
    begin(followOrbit(skeleton_, orbit, random_));
  }
  void run(const StrokesStep& step) {
    Strokes strokes{.center = scope_.hand(step.center)};
    const Numbers n = scope_.numbers(step.numbers);
    strokes.width = n.get("width");
    strokes.height = n.get("height");
    strokes.stroke_s = n.get("stroke_s");
    strokes.follow = n.get("follow");
    for (const auto& [right, up] : step.points) {
      const double x = scope_.number(right);
      strokes.points.push_back({x, scope_.number(up)});
    }
    checkSeconds(strokes.stroke_s * static_cast<double>(strokes.points.size()), "stroke_s");
    begin(followStrokes(skeleton_, strokes, random_));
  }

  void run(const StyleStep& step) { changeStyle(scope_.numbers(step.numbers), scope_.style()); }
  void run(const WalkStep& step) {
    const Numbers numbers = scope_.numbers(step.numbers);
    checkSeconds(numbers.get("seconds"), "seconds");
    for (const char* name : {"lap_s", "leg_s", "turn_s", "tread"}) {
      if (numbers.has(name) && numbers.get(name) <= 0) fail(std::string(name) + " is not above 0");
    }
    if (scope_.style().cycle_s <= 0) fail("\"cycle_s\" of the style is not above 0");
    if (scope_.style().duty <= 0 || scope_.style().duty >= 1) fail("\"duty\" of the style is not between 0 and 1");
    begin(walkAlongNamed(step.path, numbers, scope_.style(), random_.uniform()));
  }
  void begin(BodyFrames frames) {
    if (!frames_.empty()) fail("the motion has frames already", "keep one \"walk\" or line of hands, before \"play\"");
    frames_ = std::move(frames);
  }

  void checkSeconds(double seconds, const std::string& name) const {
    if (!(seconds > 0 && seconds <= kMaxSeconds)) fail("\"" + name + "\" makes the motion too short or too long");
  }
  [[nodiscard]] KeyPose pose(const std::string& name) const {
    const KeyPose* found = scope_.findPose(name);
    if (found == nullptr) fail("there is no pose \"" + name + "\"", "make it by a \"pose\" before");
    return *found;
  }
  KeyPose changed(KeyPose posture, const PostureChange& change) {
    scope_.change(change, posture);
    return posture;
  }

  PerformanceScope scope_;
  const Skeleton& skeleton_;
  Random& random_;
  BodyFrames frames_;
  std::vector<Flight> flights_;
  const std::string* where_ = nullptr;  // of the step that runs
  int step_count_ = 0;
  bool is_played_ = false;
};

}  // namespace

RawMotion playMotion(const MotionScript& motion, const Places& places, int variant, const Skeleton& skeleton,
                     Random& random) {
  return MotionPlayer(places, variant, skeleton, random).perform(motion);
}

}  // namespace depthmocap
