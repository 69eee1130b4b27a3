#pragma once
#include <optional>
#include <vector>

#include "depthmocap/models.h"
#include "libtracker/session/frame_sink.h"
#include "libtracker/tracker/tracker_config.h"

namespace depthmocap {

// Where nobody was tracked: whether somebody is there once the pictures are turned, because the camera hung on its side
// or upside down. Keeps a few frames.
class TurnTrial : public FrameSink {
 public:
  void onFrame(const SessionFrame& frame) override;
  // Degrees clockwise (0 to 270) for the pictures as they were before they were turned by `turned_deg`, with which most
  // of the kept frames are tracked, if it is more than half of them and far
  // more than were tracked as they came. `camera` of the kept frames; takes as long as
  // tracking two dozen frames.
  [[nodiscard]] std::optional<int> turnThatHelps(const Models& models, const CameraModel& camera,
                                                 const TrackerConfig& config, int turned_deg) const;

 private:
  std::vector<DepthFrame> kept_;
  std::size_t tracked_ = 0;  // of them, as they came
};

}  // namespace depthmocap
