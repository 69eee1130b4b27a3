#pragma once
#include <array>
#include <string_view>
#include <vector>

#include "libtracker/clinical/angles_file.h"

namespace depthmocap {

// What somebody does, found in the course of hips and feet.
enum class MovementKind { LeftStep, RightStep, Jump, SitToStand };
inline constexpr std::array<std::string_view, 4> kMovementNames = {"left step", "right step", "jump", "sit to stand"};

struct MovementEvent {
  MovementKind kind = MovementKind::LeftStep;
  double start_s = 0;  // a step: when the foot was put down
  double end_s = 0;    // a step: the same
};

// Steps: a foot is put down where it is farthest before the pelvis (Zeni, Richards, Higginson 2008) and near the floor.
// Jumps: both soles are off the floor, which is where the lower one mostly is. Sit to stand: the hips leave a low place
// where they rested and the knees straighten. By start; each person's rows of one file. Lost frames interrupt.
std::vector<MovementEvent> findMovements(const std::vector<AnglesRow>& rows);

}  // namespace depthmocap
