#include "libtracker/choreography/performance_scope.h"

#include <cmath>

#include "depthmocap/error.h"
#include "libtracker/choreography/postures.h"

namespace depthmocap {
namespace {

constexpr std::string_view kRandomReach = "random_reach";

// The text before the first dot, which is taken off `name`.
std::string_view takeWord(std::string_view& name) {
  const std::size_t end = std::min(name.find('.'), name.size());
  const std::string_view word = name.substr(0, end);
  name.remove_prefix(std::min(end + 1, name.size()));
  return word;
}

bool isHand(const PostureGroup& group) {
  return group.name == "left" || group.name == "right";
}
// Left and right of the same kind, so that one may be a copy of the other.
bool areAlike(const PostureGroup& a, const PostureGroup& b) {
  return a.fields == b.fields;
}

std::vector<double> numbersOf(const PostureGroup& group, KeyPose posture) {
  std::vector<double> numbers;
  for (const double* number : group.numbers(posture)) numbers.push_back(*number);
  return numbers;
}

std::vector<double> numbersOf(const HandTarget& hand) {
  return {hand.out, hand.up, hand.forward, hand.elbow};
}

std::vector<std::pair<std::size_t, double>> allOf(const std::vector<double>& numbers) {
  std::vector<std::pair<std::size_t, double>> changes;
  changes.reserve(numbers.size());
  for (const double number : numbers) changes.emplace_back(changes.size(), number);
  return changes;
}

}  // namespace

std::size_t chosenIndex(double value, std::size_t size, const std::string& where) {
  if (!(value >= 0 && value < static_cast<double>(size) && value == std::floor(value))) {
    throw Error("\"case\" is " + std::to_string(value) + ", which \"of\" does not have", where,
                "it counts from 0 to " + std::to_string(size - 1));
  }
  return static_cast<std::size_t>(value);
}

PerformanceScope::PerformanceScope(const Places& places, int variant, Random& random)
    : expressions_{random, [this](std::string_view name) { return find(name); }}, hands_(places) {
  numbers_["variant"] = variant;
  poses_["standing"] = poses_["base"] = KeyPose{};
}

void PerformanceScope::let(const std::string& name, const std::variant<Expression, GroupValue>& value) {
  if (const auto* hand_value = std::get_if<GroupValue>(&value)) {
    hands_[name] = hand(*hand_value);
  } else {
    numbers_[name] = number(std::get<Expression>(value));
  }
}

const KeyPose* PerformanceScope::findPose(const std::string& name) const {
  const auto& keys = keys_.keys();
  if (name == "last") return keys.empty() ? nullptr : &keys.back();
  if (name == "before") return keys.size() < 2 ? nullptr : &keys[keys.size() - 2];
  const auto found = poses_.find(name);
  return found == poses_.end() ? nullptr : &found->second;
}

double PerformanceScope::number(const Expression& expression) {
  return expression.evaluate(expressions_);
}

Numbers PerformanceScope::numbers(const NamedNumbers& list) {
  Numbers values;
  for (const auto& [name, expression] : list) values.set(name, number(expression));
  return values;
}

HandTarget PerformanceScope::hand(const GroupValue& value) {
  const PostureGroup& group = *findPostureGroup("left");
  KeyPose posture;
  const auto numbers = group.numbers(posture);
  for (const auto& [index, number] : resolve(value, group)) *numbers[index] = number;
  return posture.left;
}

void PerformanceScope::change(const PostureChange& change, KeyPose& posture) {
  posture_ = &posture;
  const bool swaps = change.swap && number(*change.swap) != 0.0;
  if (swaps) swapSides(posture);
  for (const auto& [groups, value] : change.groups) {
    const Changes changes = resolve(value, *groups.front());
    for (const PostureGroup* group : groups) {
      const auto numbers = group->numbers(posture);
      for (const auto& [index, number] : changes) *numbers[index] = number;
    }
  }
  if (swaps) swapSides(posture);
  posture_ = nullptr;
}

std::optional<double> PerformanceScope::find(std::string_view name) const {
  if (name.find('.') != std::string_view::npos) return findInPosture(name);
  if (name == "time") return keys_.end();
  const auto found = numbers_.find(name);
  if (found == numbers_.end()) return std::nullopt;
  return found->second;
}

std::optional<double> PerformanceScope::findInPosture(std::string_view name) const {
  std::string_view rest = name;
  const std::string_view first = takeWord(rest);
  if (first == "style") return findStyleNumber(style_, rest);
  const PostureGroup* group = findPostureGroup(first);
  const KeyPose* posture = posture_;
  if (group == nullptr) {
    posture = findPose(std::string(first));
    group = findPostureGroup(takeWord(rest));
  }
  if (group == nullptr || posture == nullptr) return std::nullopt;
  const auto index = group->find(rest);
  if (!index) return std::nullopt;
  return numbersOf(*group, *posture)[*index];
}

PerformanceScope::Changes PerformanceScope::resolve(const GroupValue& value, const PostureGroup& group) {
  if (const auto* numbers = std::get_if<GroupNumbers>(&value.value)) {
    Changes changes;
    for (const auto& [index, expression] : *numbers) changes.emplace_back(index, number(expression));
    return changes;
  }
  if (const auto* copy = std::get_if<GroupCopy>(&value.value)) return copied(*copy, group);
  const auto& choice = std::get<GroupChoice>(value.value);
  return resolve(choice.of[chosenIndex(number(choice.index), choice.of.size(), choice.where)], group);
}

PerformanceScope::Changes PerformanceScope::copied(const GroupCopy& copy, const PostureGroup& group) {
  if (isHand(group)) {
    if (copy.name == kRandomReach) return allOf(numbersOf(randomReach(expressions_.random)));
    const auto place = hands_.find(copy.name);
    if (place != hands_.end()) return allOf(numbersOf(place->second));
  }
  std::string_view rest = copy.name;
  const std::string_view first = takeWord(rest);
  const PostureGroup* from = findPostureGroup(rest.empty() ? first : rest);
  const KeyPose* posture = rest.empty() ? posture_ : findPose(std::string(first));
  if (from == nullptr || posture == nullptr || !areAlike(*from, group)) {
    throw Error("\"" + copy.name + "\" is no " + (isHand(group) ? "place for a hand" : std::string(group.name)) +
                    " that is known here",
                copy.where);
  }
  return allOf(numbersOf(*from, *posture));
}

}  // namespace depthmocap
