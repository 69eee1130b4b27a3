// The search for nearest poses against the exhaustive search of equation (3): recall and time by the number of
// candidates, over the queries of a tracked recording, and how often each size (K, B) of the local model is chosen.
// Prints JSON; see scripts/experiments and docs/lab/accuracy.md.
//
//   search_experiment REC --posedb DB [--candidates 64 128 ...]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/track/track_options.h"
#include "apps/track/tracker_setup.h"
#include "depthmocap/tracker.h"
#include "libtracker/posedb/pose_search.h"
#include "libtracker/prior/local_prior_builder.h"
#include "libtracker/recording/recording.h"
#include "libtracker/tracker/alignment.h"

namespace depthmocap {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;
using Neighbours = std::vector<PoseNeighbour>;

constexpr int kNeighbours = kMaxPriorNeighbours;  // the recall is that of these

double msSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// What the tracker asks the database for in each frame of a recording.
std::vector<PoseQuery> queriesOf(const std::filesystem::path& recording, const Models& models,
                                 const TrackerConfig& config) {
  const std::unique_ptr<RecordingReader> reader = openRecording(recording);
  Tracker tracker(models, reader->info().camera, config);
  std::vector<PoseQuery> queries;
  std::vector<Pose> poses;
  DepthFrame frame;
  for (std::size_t i = 0; i < reader->frameCount(); ++i) {
    reader->read(i, frame);
    const TrackedFrame& tracked = tracker.process(frame);
    if (tracked.state != TrackState::Tracking) {
      poses.clear();
      continue;
    }
    if (poses.size() >= 2) {
      PoseQuery& query = queries.emplace_back();
      query.markers = rotated(tracked.R_world_camera, tracked.markers_camera);
      query.has_history = true;
      query.q_prev = poses.back();
      query.q_prev2 = poses[poses.size() - 2];
      query.heading = poses.back()[kRootRy];
      query.scale = tracked.stature_m / config.policy.assumed_stature_m;
    }
    poses.push_back(tracked.q);
  }
  return queries;
}

struct Answers {
  std::vector<Neighbours> of_query;
  double ms = 0;  // a query, on average
};

template <typename Search>
Answers answersOf(const std::vector<PoseQuery>& queries, Search&& search) {
  Answers answers;
  answers.of_query.resize(queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i) search(queries[i], answers.of_query[i]);  // warm-up
  const auto start = Clock::now();
  for (std::size_t i = 0; i < queries.size(); ++i) search(queries[i], answers.of_query[i]);
  answers.ms = msSince(start) / static_cast<double>(std::max<std::size_t>(queries.size(), 1));
  return answers;
}

bool contains(const Neighbours& neighbours, std::uint32_t index) {
  return std::any_of(neighbours.begin(), neighbours.end(), [&](const auto& n) { return n.index == index; });
}

// Shares of the exact neighbours, and of the exact nearest pose, that were found.
json recall(const Answers& found, const Answers& exact, int candidates) {
  double neighbours = 0;
  double nearest = 0;
  for (std::size_t i = 0; i < exact.of_query.size(); ++i) {
    const Neighbours& wanted = exact.of_query[i];
    const auto hits = std::count_if(wanted.begin(), wanted.end(),
                                    [&](const auto& n) { return contains(found.of_query[i], n.index); });
    neighbours += static_cast<double>(hits) / static_cast<double>(wanted.size());
    nearest += contains(found.of_query[i], wanted.front().index) ? 1.0 : 0.0;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(exact.of_query.size(), 1));
  return {{"candidates", candidates}, {"recall", neighbours / count}, {"nearest", nearest / count}, {"ms", found.ms}};
}

json chosenModels(const PoseDatabase& database, const Answers& answers, const PriorConfig& config) {
  LocalPriorBuilder builder(config);
  LocalPrior prior;
  std::map<std::string, int> chosen;
  for (const Neighbours& neighbours : answers.of_query) {
    builder.build(database, neighbours, prior);
    ++chosen["K " + std::to_string(prior.neighbours) + ", B " + std::to_string(prior.dims)];
  }
  return chosen;
}

void measure(const std::filesystem::path& recording, const TrackOptions& options, const std::vector<int>& candidates) {
  const Models models = loadModels(options);
  const TrackerConfig config = trackerConfig(options);
  const std::vector<PoseQuery> queries = queriesOf(recording, models, config);
  if (queries.empty()) throw std::runtime_error("nobody was tracked in " + recording.string());
  const Actor actor = averageActor(config.policy.assumed_stature_m);
  PoseSearch reference(*models.database, actor.skeleton, actor.markers, config.search);
  const Answers exact =
      answersOf(queries, [&](const PoseQuery& q, Neighbours& n) { reference.searchExhaustive(q, kNeighbours, n); });
  json result{{"poses", models.database->size()}, {"queries", queries.size()}, {"exhaustive_ms", exact.ms}};
  for (const int count : candidates) {
    PoseSearchConfig search_config = config.search;
    search_config.candidates = count;
    PoseSearch search(*models.database, actor.skeleton, actor.markers, search_config);
    const Answers found =
        answersOf(queries, [&](const PoseQuery& q, Neighbours& n) { search.search(q, kNeighbours, n); });
    result["search"].push_back(recall(found, exact, count));
    if (count == config.search.candidates)
      result["chosen"] = chosenModels(*models.database, found, paperConfig().prior);
  }
  std::cout << result.dump(2) << '\n';
}

int run(int argc, char** argv) {
  CLI::App app{"Measures the search for nearest poses."};
  std::filesystem::path recording;
  std::vector<int> candidates = {64, 128, 256, 512, 1024, 2048, 4096};
  TrackOptions options;
  app.add_option("recording", recording)->required();
  app.add_option("--candidates", candidates, "Numbers of candidates to try");
  addTrackOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  measure(recording, options, candidates);
  return 0;
}

}  // namespace
}  // namespace depthmocap

int main(int argc, char** argv) {
  try {
    return depthmocap::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "search_experiment: " << error.what() << '\n';
    return 1;
  }
}
