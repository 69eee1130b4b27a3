#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "libtracker/choreography/expression.h"
#include "libtracker/choreography/posture_groups.h"

namespace depthmocap {

// A motion file as read and checked: what motion_reader.h makes and motion_player.h performs. The words are those of
// docs/reference/motions.md. Everything is evaluated in the order in which the file has it, because every draw moves
// the random stream on.

struct GroupValue;

// Numbers of a group that are given one by one; the others stay.
using GroupNumbers = std::vector<std::pair<std::size_t, Expression>>;
// The whole group from somewhere else: a place for a hand, a group of this posture or of another ("seat.left_foot").
struct GroupCopy {
  std::string name;
  std::string where;  // in the file, for errors
};
struct GroupChoice {
  Expression index;
  std::vector<GroupValue> of;
  std::string where;
};
struct GroupValue {
  std::variant<GroupNumbers, GroupCopy, GroupChoice> value;
};

// Changes of a posture. A value may go to two groups: both hands, both feet.
struct PostureChange {
  std::vector<std::pair<std::vector<const PostureGroup*>, GroupValue>> groups;
  std::optional<Expression> swap;  // left stands for right
};

using NamedNumbers = std::vector<std::pair<std::string, Expression>>;

struct Step;
using Steps = std::vector<Step>;

struct LetStep {
  std::vector<std::pair<std::string, std::variant<Expression, GroupValue>>> values;  // a number or a hand
};
struct PoseStep {
  std::string name, from;
  PostureChange change;
};
struct KeyStep {
  Expression after_s;
  std::string from;
  PostureChange change;
};
struct SetStep {
  PostureChange change;
};
struct RepeatStep {
  Expression count;
  std::string as;
  Steps steps;
};
struct ChoiceStep {
  Expression index;
  bool is_condition;  // anything but 0 is 1
  std::vector<Steps> of;
};
struct PartStep {
  std::shared_ptr<const Steps> steps;
};
struct PlayStep {
  NamedNumbers numbers;
};
struct FlightStep {
  NamedNumbers numbers;
};
struct OrbitStep {
  GroupValue center;
  NamedNumbers numbers;
};
struct StrokesStep {
  GroupValue center;
  NamedNumbers numbers;
  std::vector<std::pair<Expression, Expression>> points;
};
struct StyleStep {
  NamedNumbers numbers;
};
struct WalkStep {
  std::string path;
  NamedNumbers numbers;
};

struct Step {
  std::variant<LetStep, PoseStep, KeyStep, SetStep, RepeatStep, ChoiceStep, PartStep, PlayStep, FlightStep, OrbitStep,
               StrokesStep, StyleStep, WalkStep>
      action;
  std::string where;  // in the file, for errors
};

using Places = std::map<std::string, HandTarget, std::less<>>;
using Parts = std::map<std::string, std::shared_ptr<const Steps>>;

struct MotionScript {
  std::string name;
  int variants = 1;  // odd ones (0, 1, ...) are performed mirrored
  Steps steps;
  std::string where;
};

struct MotionFile {
  Places places;  // with those of the shared file
  Parts parts;    // likewise
  std::vector<MotionScript> motions;
};

}  // namespace depthmocap
