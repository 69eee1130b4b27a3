// Times of the tracker's stages, each fast path beside its plain sibling, so that one run gives ratios: times of two
// runs on a busy machine do not compare. Run it alone: build/tests/tracker_benchmark
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "depthmocap/tracker.h"
#include "libtracker/classify/classify.h"
#include "libtracker/classify/forest.h"
#include "libtracker/classify/forest_classifier.h"
#include "libtracker/classify/forest_file.h"
#include "libtracker/posedb/pose_search.h"
#include "libtracker/recording/recording.h"
#include "libtracker/solve/map_solver.h"
#include "libtracker/tracker/tracker_config.h"
#include "tests/moving_body.h"

namespace depthmocap {
namespace {

const std::string kShare = std::string(DEPTHMOCAP_SHARE) + "/";

const ForestClassifier& classifier() {
  static const ForestClassifier loaded(loadForest(kShare + "general.forest"));
  return loaded;
}

const Models& models() {
  static const Models loaded = Models::load(kShare + "general.forest", kShare + "default.posedb");
  return loaded;
}

// All frames of a bundled recording.
struct Walk {
  CameraModel camera;
  std::vector<DepthFrame> frames;
  Walk() {
    const auto reader = openRecording(std::string(DEPTHMOCAP_SOURCE_DIR) + "/recordings/walk");
    camera = reader->info().camera;
    frames.resize(reader->frameCount());
    for (std::size_t i = 0; i < frames.size(); ++i) reader->read(i, frames[i]);
  }
};

const Walk& walk() {
  static const Walk recording;
  return recording;
}

MaskImage maskOf(const DepthImage& depth) {
  MaskImage mask(depth.width, depth.height, 0);
  for (std::size_t i = 0; i < mask.data.size(); ++i) mask.data[i] = depth.data[i] > 0 ? 1 : 0;
  return mask;
}

void classifyOneFrame(benchmark::State& state, bool simd, int threads) {
  const DepthFrame& frame = walk().frames.front();
  const MaskImage mask = maskOf(frame.depth);
  ClassifyConfig config;
  config.simd = simd;
  config.threads = threads;
  ClassifyMemory memory;
  ClassifiedPixels pixels;
  const Forest& forest = classifier().forest();  // loaded before the clock runs
  for (auto _ : state) classify(forest, frame.depth, mask, walk().camera.fx, config, memory, pixels);
  state.counters["pixels"] = static_cast<double>(pixels.pixels.size());
}
BENCHMARK_CAPTURE(classifyOneFrame, simd_1_thread, true, 1)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(classifyOneFrame, simd_2_threads, true, 2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(classifyOneFrame, plain_1_thread, false, 1)->Unit(benchmark::kMillisecond)->UseRealTime();

void classifyByDefinition(benchmark::State& state) {
  const DepthFrame& frame = walk().frames.front();
  const MaskImage mask = maskOf(frame.depth);
  ClassifiedPixels pixels;
  const Forest& forest = classifier().forest();
  for (auto _ : state) classifyReference(forest, frame.depth, mask, walk().camera.fx, {}, pixels);
}
BENCHMARK(classifyByDefinition)->Unit(benchmark::kMillisecond);

void searchPoses(benchmark::State& state, bool exhaustive) {
  const MovingBody body;
  PoseSearch search(*models().database, body.skeleton, body.model, {});
  PoseQuery query;
  query.markers = body.markers(models().database->pose(models().database->poses.size() / 2));
  std::vector<PoseNeighbour> neighbours;
  for (auto _ : state) {
    exhaustive ? search.searchExhaustive(query, 50, neighbours) : search.search(query, 50, neighbours);
  }
}
BENCHMARK_CAPTURE(searchPoses, flann, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(searchPoses, exhaustive, true)->Unit(benchmark::kMillisecond);

void solvePose(benchmark::State& state, bool reference) {
  const MovingBody body;
  Random random(7);
  const Pose before = MovingBody::motion(1, 0.2);
  const MarkerSet seen = body.noisyMarkers(MovingBody::motion(1, 0.25), 0.02, 2, random);
  const MapInput input{body.skeleton, body.model, seen, nullptr, &before, &before};
  MapSolver solver{measuredWeights()};
  for (auto _ : state) {
    Pose q = before;
    benchmark::DoNotOptimize(reference ? solver.solveReference(input, q) : solver.solve(input, q));
  }
}
BENCHMARK_CAPTURE(solvePose, tree, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(solvePose, ceres_lbfgs, true)->Unit(benchmark::kMillisecond);

// The whole tracker, one iteration a frame; the paper's method beside ours.
void trackFrame(benchmark::State& state, TrackerConfig config, int threads) {
  config.threads = threads;
  auto tracker = std::make_unique<Tracker>(models(), walk().camera, config);
  std::size_t next = 0;
  for (auto _ : state) {
    if (next == walk().frames.size()) {
      state.PauseTiming();
      tracker = std::make_unique<Tracker>(models(), walk().camera, config);
      next = 0;
      state.ResumeTiming();
    }
    benchmark::DoNotOptimize(tracker->process(walk().frames[next++]));
  }
}
BENCHMARK_CAPTURE(trackFrame, full_2_threads, TrackerConfig{}, 2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(trackFrame, full_1_thread, TrackerConfig{}, 1)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(trackFrame, paper_2_threads, paperConfig(), 2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace depthmocap

BENCHMARK_MAIN();
