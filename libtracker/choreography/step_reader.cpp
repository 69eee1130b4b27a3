#include "libtracker/choreography/step_reader.h"

#include "libtracker/choreography/step_numbers.h"
#include "libtracker/choreography/value_reader.h"
#include "libtracker/choreography/walk_paths.h"
#include "libtracker/core/nearest_name.h"

namespace depthmocap {
namespace {

// The change that `groups` holds, and the step's "swap".
PostureChange readSwapped(const MotionJson& step, const MotionJson& groups, const std::vector<std::string>& others) {
  PostureChange change = readChange(groups, others);
  if (step.has("swap")) change.swap = readExpression(step.at("swap"));
  return change;
}

class StepReader {
 public:
  explicit StepReader(const Parts& parts) : parts_(parts) {}

  [[nodiscard]] Steps readSteps(const MotionJson& list) const {
    Steps steps;
    for (const MotionJson& one : list.elements()) steps.push_back(readStep(one));
    return steps;
  }

 private:
  struct Kind {
    std::string name;  // the key that a step of this kind has
    Step (StepReader::*read)(const MotionJson&) const;
  };
  static const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all = {
        {"let", &StepReader::readLet},       {"pose", &StepReader::readPose},     {"after", &StepReader::readKey},
        {"set", &StepReader::readSet},       {"repeat", &StepReader::readRepeat}, {"if", &StepReader::readIf},
        {"case", &StepReader::readCase},     {"part", &StepReader::readPart},     {"play", &StepReader::readPlay},
        {"flight", &StepReader::readFlight}, {"orbit", &StepReader::readOrbit},   {"strokes", &StepReader::readStrokes},
        {"style", &StepReader::readStyle},   {"walk", &StepReader::readWalk},
    };
    return all;
  }

  [[nodiscard]] Step readStep(const MotionJson& step) const {
    if (!step.json().is_object()) step.fail("must be an object");
    std::vector<std::string> names;
    for (const Kind& kind : kinds()) {
      if (step.has(kind.name)) return (this->*kind.read)(step);
      names.push_back(kind.name);
    }
    step.checkKeys(names);
    step.fail("has no kind of step", "give it \"after\", \"set\", \"let\" or another");
  }

  [[nodiscard]] Step readLet(const MotionJson& step) const {
    step.checkKeys({"let"});
    LetStep let;
    for (const auto& [key, value] : step.at("let").members()) {
      value.checkNewName(key);
      if (value.json().is_array() || value.json().is_object()) {
        let.values.emplace_back(key, readGroup(value, *findPostureGroup("left")));
      } else {
        let.values.emplace_back(key, readExpression(value));
      }
    }
    return {std::move(let), step.where()};
  }
  [[nodiscard]] Step readPose(const MotionJson& step) const {
    const std::string from = step.has("from") ? step.at("from").text() : "standing";
    return {PoseStep{step.at("pose").newName(), from, readSwapped(step, step, {"pose", "from", "swap"})}, step.where()};
  }
  [[nodiscard]] Step readKey(const MotionJson& step) const {
    const std::string from = step.has("from") ? step.at("from").text() : "base";
    return {KeyStep{readExpression(step.at("after")), from, readSwapped(step, step, {"after", "from", "swap"})},
            step.where()};
  }
  [[nodiscard]] Step readSet(const MotionJson& step) const {
    step.checkKeys({"set", "swap"});
    return {SetStep{readSwapped(step, step.at("set"), {})}, step.where()};
  }
  [[nodiscard]] Step readRepeat(const MotionJson& step) const {
    step.checkKeys({"repeat", "as", "steps"});
    const std::string as = step.has("as") ? step.at("as").newName() : "";
    return {RepeatStep{readExpression(step.at("repeat")), as, readSteps(step.at("steps"))}, step.where()};
  }
  [[nodiscard]] Step readIf(const MotionJson& step) const {
    step.checkKeys({"if", "then", "else"});
    Steps otherwise = step.has("else") ? readSteps(step.at("else")) : Steps{};
    return {ChoiceStep{readExpression(step.at("if")), true, {std::move(otherwise), readSteps(step.at("then"))}},
            step.where()};
  }
  [[nodiscard]] Step readCase(const MotionJson& step) const {
    step.checkKeys({"case", "of"});
    ChoiceStep choice{readExpression(step.at("case")), false, {}};
    for (const MotionJson& steps : step.at("of").elements()) choice.of.push_back(readSteps(steps));
    return {std::move(choice), step.where()};
  }
  [[nodiscard]] Step readPart(const MotionJson& step) const {
    step.checkKeys({"part"});
    const MotionJson name = step.at("part");
    const auto found = parts_.find(name.text());
    if (found != parts_.end()) return {PartStep{found->second}, step.where()};
    std::vector<std::string> names;
    for (const auto& [known, steps] : parts_) names.push_back(known);
    name.fail("there is no part \"" + name.text() + "\" before",
              names.empty() ? "" : "did you mean \"" + nearestName(name.text(), names) + "\"?");
  }

  [[nodiscard]] Step readPlay(const MotionJson& step) const {
    step.checkKeys({"play"});
    return {PlayStep{readNumbers(step.at("play"), playNumbers())}, step.where()};
  }
  [[nodiscard]] Step readFlight(const MotionJson& step) const {
    step.checkKeys({"flight"});
    return {FlightStep{readNumbers(step.at("flight"), flightNumbers())}, step.where()};
  }
  [[nodiscard]] Step readOrbit(const MotionJson& step) const {
    step.checkKeys({"orbit"});
    const MotionJson orbit = step.at("orbit");
    return {OrbitStep{readGroup(orbit.at("center"), *findPostureGroup("right")),
                      readNumbers(orbit, orbitNumbers(), {"center"})},
            step.where()};
  }
  [[nodiscard]] Step readStrokes(const MotionJson& step) const {
    step.checkKeys({"strokes"});
    const MotionJson object = step.at("strokes");
    StrokesStep strokes{readGroup(object.at("center"), *findPostureGroup("right")),
                        readNumbers(object, strokesNumbers(), {"center", "points"}),
                        {}};
    for (const MotionJson& point : object.at("points").elements()) {
      const auto numbers = point.elements();
      if (numbers.size() != 2) point.fail("must have 2 numbers");
      strokes.points.emplace_back(readExpression(numbers[0]), readExpression(numbers[1]));
    }
    if (strokes.points.size() < 2) object.at("points").fail("must have 2 points or more");
    return {std::move(strokes), step.where()};
  }
  [[nodiscard]] Step readStyle(const MotionJson& step) const {
    step.checkKeys({"style"});
    return {StyleStep{readNumbers(step.at("style"), styleNumbers())}, step.where()};
  }
  [[nodiscard]] Step readWalk(const MotionJson& step) const {
    step.checkKeys({"walk"});
    const MotionJson walk = step.at("walk");
    const MotionJson path = walk.at("path");
    const NumberNames* names = walkNumbers(path.text());
    if (names == nullptr) {
      path.fail("there is no path \"" + path.text() + "\"",
                "did you mean \"" + nearestName(path.text(), walkPathNames()) + "\"?");
    }
    return {WalkStep{path.text(), readNumbers(walk, *names, {"path"})}, step.where()};
  }

  const Parts& parts_;
};

}  // namespace

Steps readSteps(const MotionJson& list, const Parts& parts) {
  return StepReader(parts).readSteps(list);
}

}  // namespace depthmocap
