#include "libtracker/choreography/motion_json.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "depthmocap/error.h"
#include "libtracker/core/json_file.h"
#include "libtracker/core/nearest_name.h"

namespace depthmocap {
namespace {

using nlohmann::ordered_json;

// Names that always mean the same: of numbers, of poses, of the groups of a posture, of a hand's place and of the gait.
constexpr std::array<std::string_view, 18> kTaken = {
    "pi",   "variant", "time",  "standing",  "last",       "before", "pelvis", "spine",        "head",
    "left", "right",   "hands", "left_foot", "right_foot", "feet",   "swap",   "random_reach", "style"};

bool isNameCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
}

}  // namespace

ordered_json MotionJson::parse(std::string_view text, const std::string& name) {
  return parseOrderedJson(text, name);
}

void MotionJson::fail(const std::string& what, const std::string& advice) const {
  throw Error(what, where(), advice);
}

MotionJson MotionJson::at(const std::string& key) const {
  if (!json_->is_object()) fail("must be an object");
  if (!json_->contains(key)) fail("\"" + key + "\" is missing");
  return child(json_->at(key), key);
}

std::vector<std::pair<std::string, MotionJson>> MotionJson::members() const {
  if (!json_->is_object()) fail("must be an object");
  if (json_->empty()) fail("is empty", "leave it out or fill it");
  std::vector<std::pair<std::string, MotionJson>> all;
  for (const auto& [key, value] : json_->items()) all.emplace_back(key, child(value, key));
  return all;
}

std::vector<MotionJson> MotionJson::elements() const {
  if (!json_->is_array()) fail("must be a list");
  if (json_->empty()) fail("is empty", "leave it out or fill it");
  std::vector<MotionJson> all;
  for (std::size_t i = 0; i < json_->size(); ++i) all.push_back(child((*json_)[i], std::to_string(i)));
  return all;
}

void MotionJson::checkKeys(const std::vector<std::string>& known) const {
  for (const auto& [key, value] : members()) {
    if (key == "about") {
      static_cast<void>(value.text());
    } else if (std::find(known.begin(), known.end(), key) == known.end()) {
      fail("\"" + key + "\" is not known here", "did you mean \"" + nearestName(key, known) + "\"?");
    }
  }
}

std::string MotionJson::text() const {
  if (!json_->is_string()) fail("must be a text");
  return json_->get<std::string>();
}

int MotionJson::integer(int low, int high) const {
  const double value = json_->is_number() ? json_->get<double>() : NAN;
  if (!(value >= low && value <= high && value == std::floor(value))) {
    fail("must be a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  }
  return static_cast<int>(value);
}

void MotionJson::checkNewName(const std::string& name) const {
  const bool plain = std::all_of(name.begin(), name.end(), isNameCharacter);
  if (name.empty() || !plain || (name[0] >= '0' && name[0] <= '9')) {
    fail("\"" + name + "\" is no name", "it must be made of a-z, 0-9 and _");
  }
  if (std::find(kTaken.begin(), kTaken.end(), name) != kTaken.end()) {
    fail("\"" + name + "\" has a meaning already", "choose another name");
  }
}

std::string MotionJson::newName() const {
  std::string name = text();
  checkNewName(name);
  return name;
}

}  // namespace depthmocap
