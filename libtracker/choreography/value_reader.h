#pragma once
#include <string>
#include <vector>

#include "libtracker/choreography/motion_json.h"
#include "libtracker/choreography/motion_script.h"
#include "libtracker/choreography/step_numbers.h"

namespace depthmocap {

// Values of motion files; whatever is wrong is an Error that names the place.

// A number or a formula.
Expression readExpression(const MotionJson& value);
// The numbers of an object by name. `others` are keys that it may have beside them.
NamedNumbers readNumbers(const MotionJson& object, const NumberNames& names,
                         const std::vector<std::string>& others = {});
// What a group of a posture is set to.
GroupValue readGroup(const MotionJson& value, const PostureGroup& group);
// The groups that an object sets. `others` are keys that it may have beside them.
PostureChange readChange(const MotionJson& object, std::vector<std::string> others = {});

}  // namespace depthmocap
