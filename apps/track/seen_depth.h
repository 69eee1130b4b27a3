#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "libtracker/session/frame_sink.h"

namespace depthmocap {

// Degrees that --turn needs for somebody to be found, if there are such; takes a moment.
using TurnSearch = std::function<std::optional<int>()>;

// What a run saw, to say why nobody was tracked, or somebody lying: the range of the depth, how much of the pictures
// was measured, and how people lay in them. Looks at a few hundred pixels of each frame.
class SeenDepth : public FrameSink {
 public:
  void onFrame(const SessionFrame& frame) override;
  // One sentence without a full stop: what was seen, the likely cause, what to do. Empty before the first frame.
  // `turn_that_helps`: asked where the depth itself is in order.
  [[nodiscard]] std::string explanation(const TurnSearch& turn_that_helps) const;
  // Degrees that --turn needs if the person stood, where the person lay across the pictures or head down most of the
  // time and no floor told which way is up.
  [[nodiscard]] std::optional<int> turnIfUpright() const;

 private:
  [[nodiscard]] double percentile(double share) const;  // [m]

  static constexpr int kBins = 400;  // from 1 mm to 300 m, each 3 % wider than the one before
  std::array<std::uint64_t, kBins> bins_{};
  std::uint64_t measured_ = 0;
  std::uint64_t pixels_ = 0;
  std::array<std::uint64_t, 4>
      tracked_{};  // frames, by the quarter turns that would bring the head up; without a floor
};

// Words about somebody who lies in pictures without a floor, which a turned camera makes of people who stand; or none.
std::string lyingText(const SeenDepth& seen);

// The last words of a run: how many of its frames were tracked and, where it was hardly any, why.
std::string trackedText(std::size_t tracked, std::size_t frames, const SeenDepth& seen,
                        const TurnSearch& turn_that_helps);

}  // namespace depthmocap
