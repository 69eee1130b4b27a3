#pragma once
#include <string_view>

namespace depthmocap {

// What the tracker knows about a frame. Coasting: the pose is carried on by the prior without enough evidence.
enum class TrackState { Tracking, Coasting, Lost };

constexpr std::string_view trackStateName(TrackState state) {
  switch (state) {
    case TrackState::Tracking:
      return "tracking";
    case TrackState::Coasting:
      return "coasting";
    case TrackState::Lost:
      return "lost";
  }
  return "lost";
}

}  // namespace depthmocap
