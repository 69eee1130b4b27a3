#include "libtracker/choreography/value_reader.h"

#include <algorithm>

namespace depthmocap {
namespace {

GroupValue readGroupChoice(const MotionJson& value, const PostureGroup& group) {
  value.checkKeys({"case", "of"});
  GroupChoice choice{readExpression(value.at("case")), {}, value.where()};
  for (const MotionJson& one : value.at("of").elements()) choice.of.push_back(readGroup(one, group));
  return {std::move(choice)};
}

std::vector<const PostureGroup*> groupsOf(const std::string& name) {
  if (name == "hands") return {findPostureGroup("left"), findPostureGroup("right")};
  if (name == "feet") return {findPostureGroup("left_foot"), findPostureGroup("right_foot")};
  const PostureGroup* group = findPostureGroup(name);
  return group == nullptr ? std::vector<const PostureGroup*>{} : std::vector<const PostureGroup*>{group};
}

}  // namespace

Expression readExpression(const MotionJson& value) {
  if (value.json().is_number()) return Expression(value.json().get<double>());
  if (!value.json().is_string()) value.fail("must be a number or a formula in quotation marks");
  return {value.text(), value.where()};
}

NamedNumbers readNumbers(const MotionJson& object, const NumberNames& names, const std::vector<std::string>& others) {
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

PostureChange readChange(const MotionJson& object, std::vector<std::string> others) {
  for (const PostureGroup& group : postureGroups()) others.emplace_back(group.name);
  others.insert(others.end(), {"hands", "feet"});
  object.checkKeys(others);
  PostureChange change;
  for (const auto& [key, value] : object.members()) {
    auto groups = groupsOf(key);
    if (groups.empty()) continue;
    GroupValue read = readGroup(value, *groups.front());
    change.groups.emplace_back(std::move(groups), std::move(read));
  }
  return change;
}

}  // namespace depthmocap
