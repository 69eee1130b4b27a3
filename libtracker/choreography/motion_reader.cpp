#include "libtracker/choreography/motion_reader.h"

#include <algorithm>

#include "libtracker/choreography/motion_json.h"
#include "libtracker/choreography/step_numbers.h"
#include "libtracker/choreography/walk_paths.h"
#include "libtracker/core/nearest_name.h"

namespace depthmocap {
namespace {

constexpr int kMaxVariants = 100;  // of one motion; by hand, far above what is of use

Expression readExpression(const MotionJson& value) {
  if (value.json().is_number()) return Expression(value.json().get<double>());
  if (!value.json().is_string()) value.fail("must be a number or a formula in quotation marks");
  return {value.text(), value.where()};
}

NamedNumbers readNumbers(const MotionJson& object, const NumberNames& names, std::vector<std::string> others = {}) {
  std::vector<std::string> known = names.required;
  known.insert(known.end(), names.optional.begin(), names.optional.end());
  for (const std::string& name : names.required) static_cast<void>(object.at(name));
  NamedNumbers numbers;
  if (object.json().is_object() && object.json().empty()) return numbers;
  std::vector<std::string> all = known;
  all.insert(all.end(), others.begin(), others.end());
  object.checkKeys(all);
  for (const auto& [key, value] : object.members()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) numbers.emplace_back(key, readExpression(value));
  }
  return numbers;
}

GroupValue readGroup(const MotionJson& value, const PostureGroup& group);

GroupValue readGroupChoice(const MotionJson& value, const PostureGroup& group) {
  value.checkKeys({"case", "of"});
  GroupChoice choice{readExpression(value.at("case")), {}, value.where()};
  for (const MotionJson& one : value.at("of").elements()) choice.of.push_back(readGroup(one, group));
  return {std::move(choice)};
}

GroupValue readGroup(const MotionJson& value, const PostureGroup& group) {
  if (value.json().is_string()) return {GroupCopy{value.text(), value.where()}};
  if (value.has("case")) return readGroupChoice(value, group);
  GroupNumbers numbers;
  if (value.json().is_array()) {
    if (value.json().size() != group.fields.size()) {
      value.fail("must have " + std::to_string(group.fields.size()) + " numbers");
    }
    for (const MotionJson& number : value.elements()) numbers.emplace_back(numbers.size(), readExpression(number));
    return {std::move(numbers)};
  }
  if (!value.json().is_object()) value.fail("must be an object, a list of numbers or the name of another");
  value.checkKeys({group.fields.begin(), group.fields.end()});
  for (const auto& [key, number] : value.members()) {
    if (const auto index = group.find(key)) numbers.emplace_back(*index, readExpression(number));
  }
  return {std::move(numbers)};
}

std::vector<const PostureGroup*> groupsOf(const std::string& name) {
  if (name == "hands") return {findPostureGroup("left"), findPostureGroup("right")};
  if (name == "feet") return {findPostureGroup("left_foot"), findPostureGroup("right_foot")};
  const PostureGroup* group = findPostureGroup(name);
  return group == nullptr ? std::vector<const PostureGroup*>{} : std::vector<const PostureGroup*>{group};
}

// "swap" and the names of groups; `others` are the keys that are no part of the change.
PostureChange readChange(const MotionJson& object, std::vector<std::string> others = {}) {
  for (const PostureGroup& group : postureGroups()) others.emplace_back(group.name);
  others.insert(others.end(), {"hands", "feet", "swap"});
  object.checkKeys(others);
  PostureChange change;
  if (object.has("swap")) change.swap = readExpression(object.at("swap"));
  for (const auto& [key, value] : object.members()) {
    auto groups = groupsOf(key);
    if (groups.empty()) continue;
    GroupValue read = readGroup(value, *groups.front());
    change.groups.emplace_back(std::move(groups), std::move(read));
  }
  return change;
}

// Reads steps with the places and parts that were given before.
class StepReader {
 public:
  explicit StepReader(const MotionFile& file) : file_(file) {}

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
        {"let", &StepReader::readLet},         {"pose", &StepReader::readPose},   {"after", &StepReader::readKey},
        {"set", &StepReader::readSet},         {"repeat", &StepReader::readRepeat}, {"if", &StepReader::readIf},
        {"case", &StepReader::readCase},       {"part", &StepReader::readPart},   {"play", &StepReader::readPlay},
        {"flight", &StepReader::readFlight},   {"orbit", &StepReader::readOrbit}, {"strokes", &StepReader::readStrokes},
        {"style", &StepReader::readStyle},     {"walk", &StepReader::readWalk},
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
      static_cast<void>(MotionJson(nlohmann::ordered_json(key), value.where()).newName());
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
    return {PoseStep{step.at("pose").newName(), from, readChange(step, {"pose", "from"})}, step.where()};
  }
  [[nodiscard]] Step readKey(const MotionJson& step) const {
    const std::string from = step.has("from") ? step.at("from").text() : "base";
    return {KeyStep{readExpression(step.at("after")), from, readChange(step, {"after", "from"})}, step.where()};
  }
  [[nodiscard]] Step readSet(const MotionJson& step) const {
    step.checkKeys({"set", "swap"});
    SetStep set{readChange(step.at("set"))};
    if (step.has("swap")) set.change.swap = readExpression(step.at("swap"));
    return {std::move(set), step.where()};
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
    const auto found = file_.parts.find(name.text());
    if (found != file_.parts.end()) return {PartStep{found->second}, step.where()};
    std::vector<std::string> names;
    for (const auto& [known, steps] : file_.parts) names.push_back(known);
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

  const MotionFile& file_;
};

Places readPlaces(const MotionJson& object, Places places) {
  const PostureGroup& hand = *findPostureGroup("left");
  for (const auto& [name, value] : object.members()) {
    if (!value.json().is_array() || value.json().size() != hand.fields.size()) value.fail("must be a list of 4 numbers");
    KeyPose pose;
    const auto numbers = hand.numbers(pose);
    for (const MotionJson& number : value.elements()) {
      if (!number.json().is_number()) number.fail("must be a number");
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) *numbers[i] = value.json()[i].get<double>();
    places[name] = pose.left;
  }
  return places;
}

MotionScript readMotion(const MotionJson& motion, const std::string& file_name, const MotionFile& file) {
  if (!motion.has("name")) motion.fail("\"name\" is missing");
  MotionScript script;
  script.name = motion.at("name").newName();
  script.where = file_name + ": motion " + script.name;
  const MotionJson named(motion.json(), script.where + ": ");
  named.checkKeys({"name", "variants", "steps"});
  script.variants = named.at("variants").integer(1, kMaxVariants);
  script.steps = StepReader(file).readSteps(named.at("steps"));
  return script;
}

}  // namespace

MotionFile readMotionFile(std::string_view text, const std::string& name, const MotionFile& shared) {
  const nlohmann::ordered_json json = MotionJson::parse(text, name);
  const MotionJson root(json, name + ": ");
  root.checkKeys({"places", "parts", "motions"});
  MotionFile file{shared.places, shared.parts, {}};
  if (root.has("places")) file.places = readPlaces(root.at("places"), file.places);
  if (root.has("parts")) {
    for (const auto& [part, value] : root.at("parts").members()) {
      const MotionJson named(value.json(), name + ": part " + part + ": ");
      named.checkKeys({"steps"});
      file.parts[part] = std::make_shared<const Steps>(StepReader(file).readSteps(named.at("steps")));
    }
  }
  if (!root.has("motions")) return file;
  for (const MotionJson& motion : root.at("motions").elements()) {
    file.motions.push_back(readMotion(motion, name, file));
  }
  return file;
}

}  // namespace depthmocap
