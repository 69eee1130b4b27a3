#include "apps/run_stats.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include <sys/resource.h>

#include "libtracker/core/atomic_file.h"

namespace depthmocap {
namespace {

using nlohmann::ordered_json;

// Nearest-rank percentiles [ms].
ordered_json summary(std::vector<double> ms) {
  if (ms.empty()) return {{"p50", 0.0}, {"p95", 0.0}, {"p99", 0.0}, {"mean", 0.0}};
  std::sort(ms.begin(), ms.end());
  const auto rank = [&](double share) {
    return ms[static_cast<std::size_t>(std::lround(share * static_cast<double>(ms.size() - 1)))];
  };
  const double mean = std::accumulate(ms.begin(), ms.end(), 0.0) / static_cast<double>(ms.size());
  return {{"p50", rank(0.50)}, {"p95", rank(0.95)}, {"p99", rank(0.99)}, {"mean", mean}};
}

ordered_json summary(const std::vector<StageTimes>& times, double StageTimes::*stage) {
  std::vector<double> ms;
  ms.reserve(times.size());
  for (const StageTimes& t : times) ms.push_back(t.*stage);
  return summary(std::move(ms));
}

ordered_json liveSummary(const LiveFigures& live) {
  return {{"source", live.source},     {"received", live.received},         {"skipped", live.replaced},
          {"missing", live.missing},   {"damaged", live.damaged},           {"returns", live.returns},
          {"recorded", live.recorded}, {"not_recorded", live.not_recorded}, {"latency_ms", summary(live.latency_ms)}};
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
  ms_.push_back(frame.ms);
  iterations_.push_back(frame.solver_iterations);
}

void RunStats::write(const std::filesystem::path& path, double wall_s, bool adapted) const {
  ordered_json stages;
  stages["segment"] = summary(ms_, &StageTimes::segment);
  stages["classify"] = summary(ms_, &StageTimes::classify);
  stages["markers"] = summary(ms_, &StageTimes::markers);
  stages["prior"] = summary(ms_, &StageTimes::prior);
  stages["solve"] = summary(ms_, &StageTimes::solve);
  stages["total"] = summary(ms_, &StageTimes::total);
  stages["read"] = summary(read_ms_);
  stages["write"] = summary(write_ms_);
  const double iterations = std::accumulate(iterations_.begin(), iterations_.end(), 0.0);
  ordered_json stats = {{"frames", frames_},
                        {"tracked", tracked_},
                        {"coasting", coasting_},
                        {"lost", lost_},
                        {"reinitialised", reinitialised_},
                        {"unreadable", unreadable_},
                        {"wall_s", wall_s},
                        {"stage_ms", stages},
                        {"solver_iterations_mean", frames_ > 0 ? iterations / static_cast<double>(frames_) : 0.0},
                        {"stature_m", stature_m_},
                        {"size_adapted", adapted},
                        {"peak_rss_mb", peakRssMb()},
                        {"version", DEPTHMOCAP_VERSION}};
  if (live_) stats["live"] = liveSummary(*live_);
  writeFileAtomically(path, stats.dump(2) + "\n");
}

}  // namespace depthmocap
