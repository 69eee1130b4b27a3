#pragma once
#include <string_view>

namespace depthmocap {

// State of the track in one frame. Coasting: the pose is extrapolated, because the frame gives too little evidence.
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
