#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace depthmocap {

// What stands around the actor.
enum class SceneKind {
  None,
  Room,  // a few boxes within four walls, none near the actor: the scene of the measurements before furnished rooms
  // Furnished rooms, with what the name says at the actor:
  Sofa,
  Bed,
  Chair,
  Table,
  BehindSofa,  // a sofa between actor and camera
  Cluttered,
  Corner,     // two walls meet close behind the actor
  Empty,      // nobody is there
  Bystander,  // a second person, who is in the truth
};

inline constexpr std::array<std::string_view, 11> kSceneNames = {
    "none", "room", "sofa", "bed", "chair", "table", "behind_sofa", "cluttered", "corner", "empty", "bystander"};

constexpr std::optional<SceneKind> sceneNamed(std::string_view name) {
  for (std::size_t i = 0; i < kSceneNames.size(); ++i) {
    if (kSceneNames[i] == name) return static_cast<SceneKind>(i);
  }
  return std::nullopt;
}

}  // namespace depthmocap
