#include "libtracker/choreography/step_numbers.h"

#include <algorithm>
#include <array>

namespace depthmocap {
namespace {

struct StyleField {
  std::string_view name;
  double GaitStyle::*number;
};

constexpr std::array kStyleFields = {
    StyleField{"cycle_s", &GaitStyle::cycle_s},
    StyleField{"duty", &GaitStyle::duty},
    StyleField{"half_width", &GaitStyle::half_width},
    StyleField{"toe_out", &GaitStyle::toe_out},
    StyleField{"passes_early", &GaitStyle::passes_early},
    StyleField{"swing_carry", &GaitStyle::swing_carry},
    StyleField{"clearance", &GaitStyle::clearance},
    StyleField{"foot_roll", &GaitStyle::foot_roll},
    StyleField{"foot_pitch", &GaitStyle::foot_pitch},
    StyleField{"bounce", &GaitStyle::bounce},
    StyleField{"crouch", &GaitStyle::crouch},
    StyleField{"sway", &GaitStyle::sway},
    StyleField{"pelvis_turn", &GaitStyle::pelvis_turn},
    StyleField{"pelvis_list", &GaitStyle::pelvis_list},
    StyleField{"lean", &GaitStyle::lean},
    StyleField{"spine_bend", &GaitStyle::spine_bend},
    StyleField{"shoulder_turn", &GaitStyle::shoulder_turn},
    StyleField{"arm_swing", &GaitStyle::arm_swing},
    StyleField{"arm_forward", &GaitStyle::arm_forward},
    StyleField{"arm_out", &GaitStyle::arm_out},
    StyleField{"elbow", &GaitStyle::elbow},
    StyleField{"elbow_swing", &GaitStyle::elbow_swing},
    StyleField{"head_nod", &GaitStyle::head_nod},
    StyleField{"always_active", &GaitStyle::always_active},
};

}  // namespace

double Numbers::get(const std::string& name, double otherwise) const {
  const auto found = values_.find(name);
  return found == values_.end() ? otherwise : found->second;
}

const NumberNames& playNumbers() {
  static const NumberNames names = {{}, {"tempo", "spread", "angle_spread", "heel_rise", "hops"}};
  return names;
}

const NumberNames& flightNumbers() {
  static const NumberNames names = {{"height"}, {"start_s", "tuck", "forward", "sideways", "turn"}};
  return names;
}

const NumberNames& orbitNumbers() {
  static const NumberNames names = {{"out", "up", "forward", "round_s", "rounds"},
                                    {"up_frequency", "up_phase", "both", "apart", "follow"}};
  return names;
}

const NumberNames& strokesNumbers() {
  static const NumberNames names = {{"width", "height", "stroke_s"}, {"follow"}};
  return names;
}

const NumberNames& styleNumbers() {
  static const NumberNames names = [] {
    NumberNames all;
    for (const StyleField& field : kStyleFields) all.optional.emplace_back(field.name);
    all.optional.emplace_back("running");
    return all;
  }();
  return names;
}

std::optional<double> findStyleNumber(const GaitStyle& style, std::string_view name) {
  if (name == "running") return style.running ? 1.0 : 0.0;
  const auto* const found = std::find_if(kStyleFields.begin(), kStyleFields.end(),
                                         [&](const StyleField& field) { return field.name == name; });
  if (found == kStyleFields.end()) return std::nullopt;
  return style.*found->number;
}

void changeStyle(const Numbers& numbers, GaitStyle& style) {
  for (const StyleField& field : kStyleFields) {
    style.*field.number = numbers.get(std::string(field.name), style.*field.number);
  }
  style.running = numbers.get("running", style.running ? 1.0 : 0.0) != 0.0;
}

}  // namespace depthmocap
