// The classifier beside OpenCV's random trees on the same features, in one run: times of two runs on a busy machine do
// not compare. Run it alone: build/tests/classify_benchmark
#include <opencv2/ml.hpp>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "libtracker/classify/classify.h"
#include "libtracker/classify/forest.h"
#include "libtracker/classify/forest_file.h"
#include "libtracker/classify/label_image.h"
#include "libtracker/core/random.h"
#include "libtracker/recording/recording.h"

namespace depthmocap {
namespace {

constexpr int kFeatures = 400;       // that OpenCV's trees choose from
constexpr int kTrees = 3;            // as ours
constexpr int kDepth = 20;           // as ours
constexpr int kTrainPixels = 20000;  // OpenCV's training is too slow for more; smaller trees favour it

// A frame of the bundled recording, its actor, and our forest.
struct Scene {
  Forest forest = loadForest(std::string(DEPTHMOCAP_SHARE) + "/general.forest");
  CameraModel camera;
  DepthFrame frame;
  MaskImage mask;
  ClassifiedPixels pixels;

  Scene() {
    const auto reader = openRecording(std::string(DEPTHMOCAP_SOURCE_DIR) + "/recordings/walk");
    camera = reader->info().camera;
    reader->read(0, frame);
    mask = MaskImage(frame.depth.width, frame.depth.height, 0);
    for (std::size_t i = 0; i < mask.data.size(); ++i) mask.data[i] = frame.depth.data[i] > 0 ? 1 : 0;
    classify(forest, frame.depth, mask, camera.fx, {.stride = 1}, pixels);
  }
};

const Scene& scene() {
  static const Scene made;
  return made;
}

// The depth features of random nodes of our forest, the same ones for every pixel.
std::vector<ForestNode> chosenFeatures() {
  Random random(1);
  std::vector<ForestNode> features;
  const auto& nodes = scene().forest.trees[0].nodes;
  while (features.size() < kFeatures) {
    const ForestNode& node = nodes[random.below(static_cast<std::uint32_t>(nodes.size()))];
    if (node.child > 0) features.push_back(node);
  }
  return features;
}

void computeFeatures(const std::vector<ForestNode>& features, const ClassifiedPixels::Pixel& pixel, float* row) {
  const DepthImage& depth = scene().frame.depth;
  const float scale = probeScale(scene().camera.fx, pixel.depth_m);
  const auto probe = [&](const std::array<std::int16_t, 2>& offset) {
    const int x = pixel.x + wholePixels(static_cast<float>(offset[0]) * scale);
    const int y = pixel.y + wholePixels(static_cast<float>(offset[1]) * scale);
    return depth.contains(x, y) && depth.at(x, y) > 0 ? depth.at(x, y) : kBackgroundDepth_m;
  };
  for (std::size_t i = 0; i < features.size(); ++i) row[i] = probe(features[i].u) - probe(features[i].v);
}

// OpenCV's trees, taught what our forest says of the frame.
struct OpenCvTrees {
  std::vector<ForestNode> features = chosenFeatures();
  cv::Ptr<cv::ml::RTrees> trees = cv::ml::RTrees::create();

  OpenCvTrees() {
    const auto& pixels = scene().pixels.pixels;
    cv::Mat samples(kTrainPixels, kFeatures, CV_32F);
    cv::Mat parts(kTrainPixels, 1, CV_32S);
    Random random(2);
    for (int i = 0; i < kTrainPixels; ++i) {
      const auto& pixel = pixels[random.below(static_cast<std::uint32_t>(pixels.size()))];
      computeFeatures(features, pixel, samples.ptr<float>(i));
      parts.at<int>(i) = mostProbablePart(pixel);
    }
    trees->setMaxDepth(kDepth);
    trees->setMinSampleCount(2);
    trees->setTermCriteria({cv::TermCriteria::MAX_ITER, kTrees, 0});
    trees->train(cv::ml::TrainData::create(samples, cv::ml::ROW_SAMPLE, parts));
  }
};

void setRate(benchmark::State& state, std::size_t pixels) {
  state.counters["pixels"] = benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(pixels),
                                                benchmark::Counter::kIsRate);
}

void ours(benchmark::State& state, bool simd) {
  ClassifyMemory memory;
  ClassifiedPixels pixels;
  for (auto _ : state) {
    classify(scene().forest, scene().frame.depth, scene().mask, scene().camera.fx, {.stride = 1, .simd = simd}, memory,
             pixels);
    benchmark::DoNotOptimize(pixels.pixels.data());
  }
  setRate(state, pixels.pixels.size());
}
BENCHMARK_CAPTURE(ours, simd, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ours, plain, false)->Unit(benchmark::kMillisecond);

void oursByDefinition(benchmark::State& state) {
  ClassifiedPixels pixels;
  for (auto _ : state) {
    classifyReference(scene().forest, scene().frame.depth, scene().mask, scene().camera.fx, {.stride = 1}, pixels);
    benchmark::DoNotOptimize(pixels.pixels.data());
  }
  setRate(state, pixels.pixels.size());
}
BENCHMARK(oursByDefinition)->Unit(benchmark::kMillisecond);

// `with_features`: the time to compute what OpenCV's trees need counts as well; ours computes what it needs on its way.
void openCv(benchmark::State& state, bool with_features) {
  static const OpenCvTrees made;
  const auto& pixels = scene().pixels.pixels;
  const int count = 4096;
  cv::Mat rows(count, kFeatures, CV_32F);
  const auto compute = [&] {
    for (int i = 0; i < count; ++i) {
      computeFeatures(made.features, pixels[static_cast<std::size_t>(i) * pixels.size() / count], rows.ptr<float>(i));
    }
  };
  compute();
  cv::setNumThreads(1);
  cv::Mat votes;
  for (auto _ : state) {
    if (with_features) compute();
    made.trees->getVotes(rows, votes, 0);
    benchmark::DoNotOptimize(votes.data);
  }
  setRate(state, count);
}
BENCHMARK_CAPTURE(openCv, trees_alone, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(openCv, with_features, true)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace depthmocap

BENCHMARK_MAIN();
