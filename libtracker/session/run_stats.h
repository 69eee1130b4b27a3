#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "depthmocap/tracked_frame.h"
#include "libtracker/session/durations.h"
#include "libtracker/session/live_figures.h"

namespace depthmocap {

inline constexpr std::size_t kStageCount = 6;  // of StageTimes

// What a tracking run did and how long its stages took (../contract: "Stats").
class RunStats {
 public:
  explicit RunStats(Durations::Keep keep = Durations::Keep::All) : read_(keep), write_(keep) {}
  // Everybody in one frame (not empty). A frame is tracked where anybody is; times are the sum over the people.
  void addFrame(std::span<const TrackedFrame* const> people);
  void addRead(double ms) { read_.add(ms); }
  void addWrite(double ms) { write_.add(ms); }
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
  double stature_m_ = 0;                     // of the first person
  std::vector<std::size_t> tracked_people_;  // frames, one per person
  std::optional<LiveFigures> live_;
  std::uint64_t iterations_ = 0;  // of the solver
  Durations read_;
  Durations write_;
  std::array<Durations, kStageCount> stages_{read_, read_, read_, read_, read_, read_};
};

}  // namespace depthmocap
