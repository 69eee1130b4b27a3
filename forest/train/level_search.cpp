#include "forest/train/level_search.h"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "forest/train/crop_probe.h"
#include "libtracker/core/parallel.h"

namespace depthmocap {
namespace {

constexpr std::uint64_t kOffsetStream = 0x4F46;
constexpr std::uint64_t kFeatureStream = 0x4645;
constexpr std::uint32_t kFeaturesPerTask = 32;  // their histograms stay in the second-level cache
constexpr std::size_t kFullCandidates = 1024;   // samples from which on a node tries all candidates
constexpr std::size_t kFeatureCounts = std::size_t{kBinCount} * kClassCount;  // of one histogram
// Samples from which on the sums of histograms are fewer bytes than the probes, roughly, with room for their memory.
constexpr std::uint32_t kLargeNode = 16384;

std::uint32_t candidatesFor(std::size_t sample_count, int candidates) {
  const auto all = static_cast<std::size_t>(candidates);
  const std::size_t share = all * std::min(sample_count, kFullCandidates) / kFullCandidates;
  return static_cast<std::uint32_t>(std::max({share, all / 4, std::size_t{1}}));
}

void append(Communicator::Bytes& bytes, const void* from, std::size_t size) {
  const auto* first = static_cast<const std::byte*>(from);
  bytes.insert(bytes.end(), first, first + size);
}

}  // namespace

struct LevelSearch::Batch {
  struct Range {
    std::size_t begin, end;  // rows
  };
  struct Node {
    std::int32_t node;
    std::uint32_t row_count;    // on all ranks
    int owner;                  // the rank that searches it; kEveryRank: each, by the sum of the histograms
    std::vector<Range> ranges;  // of its rows here
  };
  static constexpr int kEveryRank = -1;
  std::vector<Node> nodes;
  std::vector<std::uint32_t> samples;    // of each row read here, node after node
  std::vector<std::uint8_t> classes;     // of each row
  std::vector<std::uint16_t> probes_mm;  // [row][offset]
  std::size_t row_count = 0;             // on all ranks
};

struct LevelSearch::Task {
  std::size_t node;  // in the batch
  std::uint32_t first_feature, end_feature;
  Split best;
};

LevelSearch::LevelSearch(ImageStore& images, const TrainingSamples& samples, Communicator& ranks,
                         const TreeOptions& options, int threads)
    : images_(images),
      samples_(samples),
      ranks_(ranks),
      options_(options),
      threads_(threads),
      entropy_(options.node_samples + 1) {}

// Of the node's samples at most node_samples, evenly spread over all of them; those that are here become rows. `before`
// of its samples are on the ranks before this one.
void LevelSearch::addNode(const OpenNode& open, std::uint32_t before, Batch& batch) const {
  Batch::Node node{open.node, std::min(open.all, options_.node_samples), 0, {}};
  const bool is_large = ranks_.size() > 1 && node.row_count > kLargeNode;
  node.owner = is_large ? Batch::kEveryRank : open.node % ranks_.size();
  const std::size_t begin = batch.samples.size();
  const auto end = before + static_cast<std::uint64_t>(open.samples.size());
  const std::uint64_t count = node.row_count;
  for (std::uint64_t i = (before * count + open.all - 1) / open.all; i < count; ++i) {
    const std::uint64_t place = i * open.all / count;
    if (place >= end) break;
    if (place >= before) batch.samples.push_back(open.samples[place - before]);
  }
  node.ranges.push_back({begin, batch.samples.size()});
  batch.row_count += count;
  batch.nodes.push_back(std::move(node));
}

void LevelSearch::readImageProbes(const ImageCrop& crop, std::span<const std::uint32_t> rows, Batch& batch) const {
  for (const std::uint32_t row : rows) {
    const auto& sample = samples_.samples[batch.samples[row]];
    batch.classes[row] = samples_.classOf(batch.samples[row]);
    readProbesOfPixel(crop, sample.x, sample.y, offsets_, batch.probes_mm.data() + row * offsets_.size());
  }
}

void LevelSearch::readProbes(Batch& batch) {
  std::vector<std::uint32_t> by_image(batch.samples.size());  // rows in the order of their samples
  std::iota(by_image.begin(), by_image.end(), 0U);
  std::sort(by_image.begin(), by_image.end(),
            [&](std::uint32_t a, std::uint32_t b) { return batch.samples[a] < batch.samples[b]; });
  const auto imageOf = [&](std::size_t i) { return samples_.image[batch.samples[by_image[i]]]; };
  std::vector<std::size_t> image_begin;  // in by_image
  for (std::size_t i = 0; i < by_image.size(); ++i) {
    if (i == 0 || imageOf(i) != imageOf(i - 1)) image_begin.push_back(i);
  }
  const std::size_t images = image_begin.size();
  image_begin.push_back(by_image.size());
  batch.classes.resize(batch.samples.size());
  batch.probes_mm.resize(batch.samples.size() * offsets_.size());
  parallelFor(threads_, images, [&](std::size_t k) {
    ImageCrop scratch;
    const ImageCrop& crop = images_.get(imageOf(image_begin[k]), scratch);
    readImageProbes(crop, std::span(by_image).subspan(image_begin[k], image_begin[k + 1] - image_begin[k]), batch);
  });
}

// The rows of the small nodes go to the ranks that search them.
void LevelSearch::shareSmallNodes(Batch& batch) const {
  const std::size_t row_bytes = offsets_.size() * sizeof(std::uint16_t);
  std::vector<Communicator::Bytes> outgoing(static_cast<std::size_t>(ranks_.size()));
  const auto isForeign = [&](const Batch::Node& node) {
    return node.owner != Batch::kEveryRank && node.owner != ranks_.rank();
  };
  for (Batch::Node& node : batch.nodes) {
    if (!isForeign(node)) continue;
    auto& bytes = outgoing[static_cast<std::size_t>(node.owner)];
    const auto [begin, end] = node.ranges.front();
    const auto count = static_cast<std::uint32_t>(end - begin);
    append(bytes, &count, sizeof(count));
    append(bytes, batch.classes.data() + begin, count);
    append(bytes, batch.probes_mm.data() + begin * offsets_.size(), count * row_bytes);
    node.ranges.clear();
  }
  for (const Communicator::Bytes& bytes : ranks_.exchange(outgoing)) {
    const std::byte* from = bytes.data();
    if (bytes.empty()) continue;
    for (Batch::Node& node : batch.nodes) {
      if (node.owner != ranks_.rank()) continue;
      std::uint32_t count = 0;
      std::memcpy(&count, from, sizeof(count));
      const std::size_t begin = batch.classes.size();
      batch.classes.resize(begin + count);
      batch.probes_mm.resize((begin + count) * offsets_.size());
      std::memcpy(batch.classes.data() + begin, from + sizeof(count), count);
      std::memcpy(batch.probes_mm.data() + begin * offsets_.size(), from + sizeof(count) + count, count * row_bytes);
      from += sizeof(count) + count * (1 + row_bytes);
      node.ranges.push_back({begin, begin + count});
    }
  }
}

CandidateFeature LevelSearch::featureOf(std::int32_t node, std::uint32_t feature) const {
  Random random(seed_ + feature, kFeatureStream + static_cast<std::uint64_t>(node));
  return drawCandidate(options_.features, random);
}

std::vector<LevelSearch::Task> LevelSearch::tasksOf(const Batch& batch, int owner) const {
  std::vector<Task> tasks;
  for (std::size_t n = 0; n < batch.nodes.size(); ++n) {
    if (batch.nodes[n].owner != owner) continue;
    const auto count = candidatesFor(batch.nodes[n].row_count, options_.candidates);
    for (std::uint32_t f = 0; f < count; f += kFeaturesPerTask)
      tasks.push_back({n, f, std::min(count, f + kFeaturesPerTask), {}});
  }
  return tasks;
}

// Of the node's rows that are here.
void LevelSearch::fillHistogram(const Batch& batch, const Task& task, SplitHistogram& histogram) const {
  const Batch::Node& node = batch.nodes[task.node];
  thread_local std::vector<CandidateFeature> features;
  features.clear();
  for (std::uint32_t f = task.first_feature; f < task.end_feature; ++f) features.push_back(featureOf(node.node, f));
  histogram.reset(features);
  for (const auto [begin, end] : node.ranges) {
    for (std::size_t row = begin; row < end; ++row) {
      histogram.add(batch.probes_mm.data() + row * offsets_.size(), batch.classes[row]);
    }
  }
}

void LevelSearch::searchHistograms(const std::uint32_t* counts, Task& task) const {
  ClassCounts total{};
  for (std::size_t i = 0; i < kFeatureCounts; ++i) total[i % kClassCount] += counts[i];
  for (std::uint32_t f = task.first_feature; f < task.end_feature; ++f, counts += kFeatureCounts) {
    Split split = bestThreshold(counts, total, options_.min_leaf, options_.facing_weight, entropy_);
    split.feature = f;
    if (split.gain > task.best.gain) task.best = split;
  }
}

// Nodes whose rows are all here.
std::vector<LevelSearch::Task> LevelSearch::searchOwnNodes(const Batch& batch) const {
  std::vector<Task> tasks = tasksOf(batch, ranks_.rank());
  parallelFor(threads_, tasks.size(), [&](std::size_t i) {
    thread_local SplitHistogram histogram;
    fillHistogram(batch, tasks[i], histogram);
    searchHistograms(histogram.counts().data(), tasks[i]);
  });
  return tasks;
}

// Nodes whose rows are everywhere.
std::vector<LevelSearch::Task> LevelSearch::searchLargeNodes(const Batch& batch) const {
  std::vector<Task> tasks = tasksOf(batch, Batch::kEveryRank);
  std::vector<std::uint32_t> counts(tasks.size() * kFeaturesPerTask * kFeatureCounts, 0);
  const auto countsOf = [&](std::size_t task) { return counts.data() + task * kFeaturesPerTask * kFeatureCounts; };
  parallelFor(threads_, tasks.size(), [&](std::size_t i) {
    thread_local SplitHistogram histogram;
    fillHistogram(batch, tasks[i], histogram);
    std::copy(histogram.counts().begin(), histogram.counts().end(), countsOf(i));
  });
  ranks_.sum(counts);
  parallelFor(threads_, tasks.size(), [&](std::size_t i) { searchHistograms(countsOf(i), tasks[i]); });
  return tasks;
}

void LevelSearch::searchBatch(Batch& batch, std::vector<NodeSplit>& splits) {
  readProbes(batch);
  shareSmallNodes(batch);
  std::vector<Split> best(batch.nodes.size());
  const auto keepBest = [&](const std::vector<Task>& tasks) {
    for (const Task& task : tasks) {
      if (task.best.gain > best[task.node].gain) best[task.node] = task.best;
    }
  };
  keepBest(searchOwnNodes(batch));
  keepBest(searchLargeNodes(batch));
  tellAll(batch, best);
  for (std::size_t n = 0; n < batch.nodes.size(); ++n) {
    NodeSplit& split = splits.emplace_back();
    split.node = batch.nodes[n].node;
    split.gain = best[n].gain;
    if (split.gain < 0) continue;
    const CandidateFeature feature = featureOf(split.node, best[n].feature);
    split.split.u = offsets_[feature.first];
    split.split.v = offsets_[feature.second];
    split.split.threshold_m = static_cast<float>(thresholdMillimetres(best[n].bin, feature)) * 0.001F;
  }
}

// Each node's split from the rank that has searched it, the first one's where all have.
void LevelSearch::tellAll(const Batch& batch, std::vector<Split>& best) const {
  std::vector<std::int64_t> told(3 * best.size(), 0);
  for (std::size_t n = 0; n < best.size(); ++n) {
    if (std::max(batch.nodes[n].owner, 0) != ranks_.rank()) continue;
    told[3 * n] = best[n].gain;
    told[3 * n + 1] = best[n].feature;
    told[3 * n + 2] = best[n].bin;
  }
  ranks_.sum(told);
  for (std::size_t n = 0; n < best.size(); ++n) {
    best[n] = {told[3 * n], static_cast<std::uint32_t>(told[3 * n + 1]), static_cast<int>(told[3 * n + 2])};
  }
}

std::vector<NodeSplit> LevelSearch::search(const std::vector<OpenNode>& open, std::uint64_t seed, int level) {
  seed_ = seed;
  Random random(seed + static_cast<std::uint64_t>(level), kOffsetStream);
  offsets_ = drawOffsets(options_.features, random);
  std::vector<std::uint32_t> before;  // samples of each node on the ranks before this one
  before.reserve(open.size());
  for (const OpenNode& node : open) before.push_back(static_cast<std::uint32_t>(node.samples.size()));
  ranks_.sumBefore(before);
  std::vector<NodeSplit> splits;
  Batch batch;
  for (std::size_t i = 0; i < open.size(); ++i) {
    addNode(open[i], before[i], batch);
    const bool full = batch.row_count + options_.node_samples > options_.batch_samples;
    if (!full && i + 1 < open.size()) continue;
    searchBatch(batch, splits);
    batch = {};
  }
  return splits;
}

}  // namespace depthmocap
