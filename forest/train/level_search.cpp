#include "forest/train/level_search.h"

#include <algorithm>
#include <numeric>

#include "forest/train/crop_probe.h"
#include "libtracker/core/parallel.h"

namespace depthmocap {
namespace {

constexpr std::uint64_t kOffsetStream = 0x4F46;
constexpr std::uint64_t kFeatureStream = 0x4645;
constexpr std::uint32_t kFeaturesPerTask = 64;  // their histograms stay in the second-level cache
constexpr std::size_t kFullCandidates = 1024;   // samples from which on a node tries all candidates

// At most `limit` of the samples, evenly spread over them.
void selectEvenly(const std::vector<std::uint32_t>& samples, std::size_t limit, std::vector<std::uint32_t>& rows) {
  const std::size_t count = std::min(samples.size(), limit);
  for (std::size_t i = 0; i < count; ++i) rows.push_back(samples[i * samples.size() / count]);
}

std::uint32_t candidatesFor(std::size_t sample_count, int candidates) {
  const auto all = static_cast<std::size_t>(candidates);
  const std::size_t share = all * std::min(sample_count, kFullCandidates) / kFullCandidates;
  return static_cast<std::uint32_t>(std::max({share, all / 4, std::size_t{1}}));
}

}  // namespace

struct LevelSearch::Batch {
  struct Node {
    std::int32_t node;
    std::size_t begin, end;  // rows
  };
  std::vector<Node> nodes;
  std::vector<std::uint32_t> rows;      // sample of each row, node after node
  std::vector<std::uint32_t> by_image;  // rows in the order of their samples
};

struct LevelSearch::Task {
  std::size_t node;  // in the batch
  std::uint32_t first_feature, end_feature;
};

LevelSearch::LevelSearch(ImageStore& images, const TrainingSamples& samples, const TreeOptions& options, int threads)
    : images_(images), samples_(samples), options_(options), threads_(threads), entropy_(options.node_samples + 1) {}

void LevelSearch::readImageProbes(const ImageCrop& crop, const Batch& batch, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    const std::uint32_t row = batch.by_image[i];
    const auto& sample = samples_.samples[batch.rows[row]];
    readProbesOfPixel(crop, sample.x, sample.y, offsets_, probes_mm_.data() + row * offsets_.size());
  }
}

void LevelSearch::readProbes(Batch& batch) {
  batch.by_image.resize(batch.rows.size());
  std::iota(batch.by_image.begin(), batch.by_image.end(), 0U);
  std::sort(batch.by_image.begin(), batch.by_image.end(),
            [&](std::uint32_t a, std::uint32_t b) { return batch.rows[a] < batch.rows[b]; });
  std::vector<std::size_t> image_begin;  // in by_image
  const auto imageOf = [&](std::size_t i) { return samples_.image[batch.rows[batch.by_image[i]]]; };
  for (std::size_t i = 0; i < batch.by_image.size(); ++i) {
    if (i == 0 || imageOf(i) != imageOf(i - 1)) image_begin.push_back(i);
  }
  image_begin.push_back(batch.by_image.size());
  probes_mm_.resize(batch.rows.size() * offsets_.size());
  parallelFor(threads_, image_begin.size() - 1, [&](std::size_t k) {
    ImageCrop scratch;
    readImageProbes(images_.get(imageOf(image_begin[k]), scratch), batch, image_begin[k], image_begin[k + 1]);
  });
}

Split LevelSearch::searchTask(const Batch& batch, const Task& task, std::uint64_t seed) {
  const Batch::Node& node = batch.nodes[task.node];
  thread_local SplitHistogram histogram;
  thread_local std::vector<CandidateFeature> features;
  features.clear();
  for (std::uint32_t f = task.first_feature; f < task.end_feature; ++f) {
    Random random(seed + f, kFeatureStream + static_cast<std::uint64_t>(node.node));
    features.push_back(drawCandidate(options_.features, random));
  }
  histogram.reset(features);
  PartCounts total{};
  for (std::size_t row = node.begin; row < node.end; ++row) {
    const std::uint8_t part = samples_.samples[batch.rows[row]].part_index;
    ++total[part];
    histogram.add(probes_mm_.data() + row * offsets_.size(), part);
  }
  Split best;
  for (std::size_t f = 0; f < features.size(); ++f) {
    Split split = bestThreshold(histogram.of(f), total, options_.min_leaf, entropy_);
    split.feature = task.first_feature + f;
    if (split.gain > best.gain) best = split;
  }
  return best;
}

void LevelSearch::searchBatch(Batch& batch, std::uint64_t seed, std::vector<NodeSplit>& splits) {
  readProbes(batch);
  std::vector<Task> tasks;
  for (std::size_t n = 0; n < batch.nodes.size(); ++n) {
    const auto count = candidatesFor(batch.nodes[n].end - batch.nodes[n].begin, options_.candidates);
    for (std::uint32_t f = 0; f < count; f += kFeaturesPerTask)
      tasks.push_back({n, f, std::min(count, f + kFeaturesPerTask)});
  }
  std::vector<Split> found(tasks.size());
  parallelFor(threads_, tasks.size(), [&](std::size_t i) { found[i] = searchTask(batch, tasks[i], seed); });
  std::vector<Split> best(batch.nodes.size());
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (found[i].gain > best[tasks[i].node].gain) best[tasks[i].node] = found[i];
  }
  for (std::size_t n = 0; n < batch.nodes.size(); ++n) {
    NodeSplit& split = splits.emplace_back();
    split.node = batch.nodes[n].node;
    split.gain = best[n].gain;
    if (split.gain < 0) continue;
    Random random(seed + best[n].feature, kFeatureStream + static_cast<std::uint64_t>(split.node));
    const CandidateFeature feature = drawCandidate(options_.features, random);
    split.split.u = offsets_[feature.first];
    split.split.v = offsets_[feature.second];
    split.split.threshold_m = static_cast<float>(thresholdMillimetres(best[n].bin, feature)) * 0.001F;
  }
}

std::vector<NodeSplit> LevelSearch::search(const std::vector<OpenNode>& open, std::uint64_t seed, int level) {
  Random random(seed + static_cast<std::uint64_t>(level), kOffsetStream);
  offsets_ = drawOffsets(options_.features, random);
  std::vector<NodeSplit> splits;
  Batch batch;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const std::size_t begin = batch.rows.size();
    selectEvenly(open[i].samples, options_.node_samples, batch.rows);
    batch.nodes.push_back({open[i].node, begin, batch.rows.size()});
    const bool full = batch.rows.size() + options_.node_samples > options_.batch_samples;
    if (!full && i + 1 < open.size()) continue;
    searchBatch(batch, seed, splits);
    batch = {};
  }
  return splits;
}

}  // namespace depthmocap
