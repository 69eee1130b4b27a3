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

void RunStats::addFrame(std::span<const TrackedFrame* const> people) {
  ++frames_;
  TrackState state = TrackState::Lost;
  StageTimes ms;
  bool fresh = false;
  tracked_people_.resize(people.size());
  for (std::size_t i = 0; i < people.size(); ++i) {
    const TrackedFrame& person = *people[i];
    if (person.state == TrackState::Tracking || state == TrackState::Lost) state = person.state;
    tracked_people_[i] += person.state == TrackState::Tracking ? 1 : 0;
    fresh |= person.reinitialised;
    iterations_ += static_cast<std::uint64_t>(person.solver_iterations);
    for (const auto& stage : kStages) ms.*stage.second += person.ms.*stage.second;
  }
  tracked_ += state == TrackState::Tracking ? 1 : 0;
  coasting_ += state == TrackState::Coasting ? 1 : 0;
  lost_ += state == TrackState::Lost ? 1 : 0;
  reinitialised_ += fresh ? 1 : 0;
  stature_m_ = people.front()->stature_m;
  for (std::size_t i = 0; i < kStages.size(); ++i) stages_[i].add(ms.*kStages[i].second);
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
  if (tracked_people_.size() > 1) stats["tracked_people"] = tracked_people_;
  if (live_) stats["live"] = liveSummary(*live_);
  writeFileAtomically(path, stats.dump(2) + "\n");
}

}  // namespace depthmocap
