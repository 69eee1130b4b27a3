#include "libtracker/session/run_stats.h"

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include <sys/resource.h>

#include "libtracker/core/atomic_file.h"

namespace depthmocap {
namespace {

using nlohmann::ordered_json;

// In the order of RunStats::stages_.
constexpr std::array<std::pair<const char*, double StageTimes::*>, kStageCount> kStages = {
    {{"segment", &StageTimes::segment},
     {"classify", &StageTimes::classify},
     {"markers", &StageTimes::markers},
     {"prior", &StageTimes::prior},
     {"solve", &StageTimes::solve},
     {"total", &StageTimes::total}}};

ordered_json summaryOf(const Durations& durations) {
  const Durations::Summary s = durations.summary();
  return {{"p50", s.p50}, {"p95", s.p95}, {"p99", s.p99}, {"mean", s.mean}, {"max", s.max}};
}

ordered_json liveSummary(const LiveFigures& live) {
  return {{"source", live.source},     {"received", live.received},         {"skipped", live.replaced},
          {"missing", live.missing},   {"damaged", live.damaged},           {"returns", live.returns},
          {"recorded", live.recorded}, {"not_recorded", live.not_recorded}, {"latency_ms", summaryOf(live.latency)}};
}

double peakRssMb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace

void RunStats::addFrame(const TrackedFrame& frame) {
  ++frames_;
  tracked_ += frame.state == TrackState::Tracking ? 1 : 0;
  coasting_ += frame.state == TrackState::Coasting ? 1 : 0;
  lost_ += frame.state == TrackState::Lost ? 1 : 0;
  reinitialised_ += frame.reinitialised ? 1 : 0;
  stature_m_ = frame.stature_m;
  for (std::size_t i = 0; i < kStages.size(); ++i) stages_[i].add(frame.ms.*kStages[i].second);
  iterations_ += static_cast<std::uint64_t>(frame.solver_iterations);
}

void RunStats::write(const std::filesystem::path& path, double wall_s, bool adapted) const {
  ordered_json stages;
  for (std::size_t i = 0; i < kStages.size(); ++i) stages[kStages[i].first] = summaryOf(stages_[i]);
  stages["read"] = summaryOf(read_);
  stages["write"] = summaryOf(write_);
  ordered_json stats = {
      {"frames", frames_},
      {"tracked", tracked_},
      {"coasting", coasting_},
      {"lost", lost_},
      {"reinitialised", reinitialised_},
      {"unreadable", unreadable_},
      {"wall_s", wall_s},
      {"stage_ms", stages},
      {"solver_iterations_mean", frames_ > 0 ? static_cast<double>(iterations_) / static_cast<double>(frames_) : 0.0},
      {"stature_m", stature_m_},
      {"size_adapted", adapted},
      {"peak_rss_mb", peakRssMb()},
      {"version", DEPTHMOCAP_VERSION}};
  if (live_) stats["live"] = liveSummary(*live_);
  writeFileAtomically(path, stats.dump(2) + "\n");
}

}  // namespace depthmocap
