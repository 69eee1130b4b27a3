#include <cmath>
#include <map>

#include <zlib.h>

#include "libtracker/classify/forest.h"
#include "libtracker/classify/forest_file.h"
#include "libtracker/classify/forest_layout.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Probe = std::array<std::int16_t, 2>;

template <typename T>
void put(Bytes& bytes, T value) {
  const auto raw = std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value);
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

void putColumn(Bytes& bytes, const std::vector<std::uint16_t>& column) {
  for (const std::uint16_t value : column) bytes.push_back(static_cast<std::uint8_t>(value & 0xFFU));
  for (const std::uint16_t value : column) bytes.push_back(static_cast<std::uint8_t>(value >> 8U));
}

// Room for so many bits, all 0; where they begin.
std::size_t putZeros(Bytes& bytes, std::size_t bits) {
  const std::size_t at = bytes.size();
  bytes.resize(at + bytesOfBits(bits));
  return at;
}

void setBit(Bytes& bytes, std::size_t at, std::size_t bit) {
  bytes[at + bit / 8] = static_cast<std::uint8_t>(bytes[at + bit / 8] | (1U << (bit % 8)));
}

std::vector<const ForestNode*> breadthFirst(const ForestTree& tree) {
  const auto node = [&](std::int32_t i) { return &tree.nodes[static_cast<std::size_t>(i)]; };
  std::vector<const ForestNode*> order{node(0)};
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::int32_t child = order[i]->child;
    if (child > 0) order.insert(order.end(), {node(child), node(child + 1)});
  }
  return order;
}

std::uint16_t thresholdMillimetres(float threshold_m) {
  const float bounded = std::fmin(std::fmax(threshold_m * 1000.0F, -32768.0F), 32767.0F);
  return static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(bounded)));
}

void putSplits(Bytes& bytes, const std::vector<const ForestNode*>& splits, const std::vector<std::size_t>& of_level) {
  std::array<std::vector<std::uint16_t>, 3> columns;
  std::size_t first = 0;
  for (const std::size_t count : of_level) {
    std::map<Probe, std::uint16_t> number;
    for (std::size_t k = first; k < first + count; ++k) {
      number.try_emplace(splits[k]->u);
      number.try_emplace(splits[k]->v);
    }
    DMC_CHECK(number.size() <= kMaxProbes);
    put(bytes, static_cast<std::uint32_t>(number.size()));
    std::uint16_t next = 0;
    for (auto& [probe, place] : number) {
      place = next++;
      for (const std::int16_t value : probe) put(bytes, value);
    }
    for (std::size_t k = first; k < first + count; ++k) {
      columns[0].push_back(number.at(splits[k]->u));
      columns[1].push_back(number.at(splits[k]->v));
      columns[2].push_back(thresholdMillimetres(splits[k]->threshold_m));
    }
    first += count;
  }
  for (const auto& column : columns) putColumn(bytes, column);
}

void putLeaves(Bytes& bytes, const ForestTree& tree, const std::vector<std::size_t>& leaves, std::size_t facings) {
  const std::size_t bits = putZeros(bytes, leaves.size() * facings * kPartCount);
  std::size_t bit = 0;
  for (std::size_t column = 0; column < facings * kPartCount; ++column) {
    for (const std::size_t leaf : leaves) {
      const std::uint8_t value = tree.leaves[leaf * facings + column / kPartCount][column % kPartCount];
      if (value != 0) {
        setBit(bytes, bits, bit);
        bytes.push_back(value);
      }
      ++bit;
    }
  }
}

void putTree(Bytes& bytes, const ForestTree& tree, std::size_t facings) {
  const std::vector<const ForestNode*> order = breadthFirst(tree);
  const std::size_t bits = putZeros(bytes, order.size());
  std::vector<const ForestNode*> splits;
  std::vector<std::size_t> leaves;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (order[i]->child > 0) {
      setBit(bytes, bits, i);
      splits.push_back(order[i]);
    } else {
      leaves.push_back(static_cast<std::size_t>(-order[i]->child));
    }
  }
  putSplits(bytes, splits, splitsOfLevels(order.size(), [&](std::size_t n) { return order[n]->child > 0; }));
  putLeaves(bytes, tree, leaves, facings);
}

Bytes packed(const Bytes& raw) {
  Bytes result(compressBound(raw.size()));
  uLongf size = result.size();
  DMC_CHECK(compress2(result.data(), &size, raw.data(), raw.size(), Z_BEST_COMPRESSION) == Z_OK);
  result.resize(size);
  return result;
}

Bytes encode(const Forest& forest) {
  // A long origin is cut: it only says to people where a forest comes from, and hours of training stand behind it.
  const std::string origin = forest.origin.substr(0, kMaxOriginBytes);
  Bytes body(origin.begin(), origin.end());
  Bytes raw;
  for (const ForestTree& tree : forest.trees) {
    put(body, static_cast<std::uint32_t>(tree.nodes.size()));
    putTree(raw, tree, static_cast<std::size_t>(forest.facings));
  }
  const Bytes stream = packed(raw);
  body.insert(body.end(), stream.begin(), stream.end());
  Bytes file(kForestMagic.begin(), kForestMagic.end());
  put(file, kForestVersion);
  put(file, static_cast<std::uint32_t>(forest.trees.size()));
  put(file, static_cast<std::uint32_t>(forest.facings));
  put(file, static_cast<std::uint32_t>(origin.size()));
  put(file, static_cast<std::uint64_t>(stream.size()));
  put(file, static_cast<std::uint64_t>(raw.size()));
  put(file, static_cast<std::uint32_t>(crc32_z(crc32_z(0, nullptr, 0), body.data(), body.size())));
  file.insert(file.end(), body.begin(), body.end());
  return file;
}

}  // namespace

void saveForest(const Forest& forest, const std::filesystem::path& path) {
  checkForest(forest);
  DMC_CHECK(forest.trees.size() <= kMaxTrees);
  const Bytes file = encode(forest);
  writeFileAtomically(path, {reinterpret_cast<const char*>(file.data()), file.size()});
}

}  // namespace depthmocap
