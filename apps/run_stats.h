#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/live_figures.h"
#include "libtracker/tracker/tracked_frame.h"

namespace depthmocap {

// What a tracking run did and how long its stages took (../contract: "Stats").
class RunStats {
 public:
  void addFrame(const TrackedFrame& frame);
  void addRead(double ms) { read_ms_.push_back(ms); }
  void addWrite(double ms) { write_ms_.push_back(ms); }
  void addUnreadable() { ++unreadable_; }
  // Adds "live" to what is written.
  void setLive(const LiveFigures& figures) { live_ = figures; }
  // Written whole or not at all. `adapted`: no actor file was given and the size was fitted while tracking.
  void write(const std::filesystem::path& path, double wall_s, bool adapted) const;
  [[nodiscard]] std::size_t frames() const { return frames_; }
  [[nodiscard]] std::size_t tracked() const { return tracked_; }

 private:
  std::size_t frames_ = 0;
  std::size_t tracked_ = 0;
  std::size_t lost_ = 0;
  std::size_t coasting_ = 0;
  std::size_t reinitialised_ = 0;
  std::size_t unreadable_ = 0;
  double stature_m_ = 0;
  std::optional<LiveFigures> live_;
  std::vector<StageTimes> ms_;
  std::vector<int> iterations_;
  std::vector<double> read_ms_;
  std::vector<double> write_ms_;
};

}  // namespace depthmocap
