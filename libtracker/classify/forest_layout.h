#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "depthmocap/parts.h"

namespace depthmocap {

// The forest file, little-endian:
//
//   "DMCFORST"  u32 version  u32 trees  u32 facings  u32 origin bytes  u64 packed bytes  u64 unpacked bytes
//   u32 CRC-32 of all that follows
//   origin (UTF-8), u32 nodes of each tree, then one zlib stream of "packed bytes".
//
// Unpacked, the stream holds for each tree, nodes in breadth-first order:
//   - a bit per node, 1 = split, lowest bit of a byte first;
//   - for each level with splits the probes that they use: u32 how many, then i16 x and y [px * m] of each. The
//   features
//     of a level are pairs of few probes, so that a split needs two numbers of its level's list;
//   - of the splits, column by column, the first probe's number, the second one's and the threshold [mm], each 16 bits,
//     first every low byte, then every high byte, so that equal bytes pack well;
//   - of the leaves, facing by facing and part by part, a bit per leaf, 1 = its probability is not 0; then, in the same
//     order, a byte for each that is not: probability * 255.
// Breadth-first order makes child indices superfluous: the children of the k-th split are nodes 2 k + 1 and 2 k + 2,
// and the k-th leaf has distribution k.
static_assert(std::endian::native == std::endian::little, "the file is copied byte by byte");

inline constexpr std::array<char, 8> kForestMagic = {'D', 'M', 'C', 'F', 'O', 'R', 'S', 'T'};
inline constexpr std::uint32_t kForestVersion = 3;
inline constexpr std::uint32_t kMaxTrees = 64;
// Of all trees together: 2.3 times those of the forest that comes with the library, and some 400 MB while it is read.
inline constexpr std::uint32_t kMaxNodes = 1U << 22U;
inline constexpr std::uint32_t kMaxOriginBytes = 4096;
inline constexpr std::size_t kMaxProbes = 1U << 16U;  // of a level

constexpr std::size_t bytesOfBits(std::size_t bits) {
  return (bits + 7) / 8;
}

// The most bytes that a tree of so many nodes unpacks to.
constexpr std::size_t maxTreeBytes(std::size_t nodes, std::size_t facings) {
  const std::size_t splits = nodes / 2;
  const std::size_t probabilities = (splits + 1) * facings * kPartCount;
  return bytesOfBits(nodes) + splits * (4 + 2 * 4 + 3 * 2) + bytesOfBits(probabilities) + probabilities;
}

// The splits of each level, from a function that says of nodes 0, 1, .. in breadth-first order whether they split. Ends
// where all nodes are used up or a level has none.
template <typename IsSplit>
std::vector<std::size_t> splitsOfLevels(std::size_t nodes, IsSplit&& is_split) {
  std::vector<std::size_t> splits;
  for (std::size_t first = 0, end = 1; first < end && end <= nodes;) {
    std::size_t count = 0;
    for (std::size_t n = first; n < end; ++n) count += is_split(n) ? 1 : 0;
    if (count == 0) break;
    splits.push_back(count);
    first = end;
    end += 2 * count;
  }
  return splits;
}

}  // namespace depthmocap
