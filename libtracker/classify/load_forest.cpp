#include <algorithm>
#include <bit>
#include <cstring>
#include <span>
#include <utility>

#include <zlib.h>

#include "depthmocap/error.h"
#include "libtracker/classify/forest.h"
#include "libtracker/classify/forest_file.h"
#include "libtracker/classify/forest_layout.h"
#include "libtracker/core/read_file.h"

namespace depthmocap {
namespace {

using Bytes = std::span<const std::uint8_t>;
using Probe = std::array<std::int16_t, 2>;

constexpr std::size_t kMaxPacking = 1032;               // zlib's best ratio
constexpr std::size_t kMostFileBytes = mebibytes(128);  // packed; that of 1.8 million nodes has 9 MB

// Bytes that are taken from the front; taking more than there are is an Error.
class Reader {
 public:
  Reader(Bytes bytes, std::string where) : bytes_(bytes), where_(std::move(where)) {}
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(what, where_, "copy it again or train a new one: depthmocap forest train");
  }
  [[noreturn]] void failDamaged(const std::string& how) const { fail("the forest file is damaged: " + how); }
  const std::uint8_t* take(std::size_t count) {
    if (count > left()) fail("the forest file is truncated");
    at_ += count;
    return bytes_.data() + (at_ - count);
  }
  template <typename T>
  T get() {
    T value;
    std::memcpy(&value, take(sizeof(T)), sizeof(T));
    return value;
  }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

 private:
  Bytes bytes_;
  std::string where_;
  std::size_t at_ = 0;
};

bool bitAt(const std::uint8_t* bits, std::size_t i) {
  return ((bits[i / 8] >> (i % 8)) & 1U) != 0;
}

// Calls visit(i - first) for each bit i in [first, end) that is 1, in order; zeros are skipped by whole words.
template <typename Visit>
void forEachSetBit(const std::uint8_t* bits, std::size_t first, std::size_t end, Visit&& visit) {
  constexpr std::size_t kWordBits = 64;
  std::size_t i = first;
  for (; i < end && i % 8 != 0; ++i) {
    if (bitAt(bits, i)) visit(i - first);
  }
  for (; i + kWordBits <= end; i += kWordBits) {
    std::uint64_t word = 0;
    std::memcpy(&word, bits + i / 8, sizeof word);
    for (; word != 0; word &= word - 1) visit(i - first + static_cast<std::size_t>(std::countr_zero(word)));
  }
  for (; i < end; ++i) {
    if (bitAt(bits, i)) visit(i - first);
  }
}

std::vector<std::uint16_t> getColumn(Reader& reader, std::size_t count) {
  const std::uint8_t* low = reader.take(count);
  const std::uint8_t* high = reader.take(count);
  std::vector<std::uint16_t> column(count);
  for (std::size_t i = 0; i < count; ++i) column[i] = static_cast<std::uint16_t>(low[i] | (high[i] << 8U));
  return column;
}

std::vector<Probe> getProbes(Reader& reader) {
  const auto count = reader.get<std::uint32_t>();
  if (count == 0 || count > kMaxProbes) reader.failDamaged("impossible number of probes");
  const std::uint8_t* raw = reader.take(count * sizeof(Probe));
  std::vector<Probe> probes(count);
  std::memcpy(probes.data(), raw, count * sizeof(Probe));
  return probes;
}

// The splits in order; their children are set.
std::vector<ForestNode> getSplits(Reader& reader, const std::vector<std::size_t>& of_level, std::size_t split_count) {
  std::vector<std::vector<Probe>> probes;
  for (std::size_t level = 0; level < of_level.size(); ++level) probes.push_back(getProbes(reader));
  const auto u = getColumn(reader, split_count);
  const auto v = getColumn(reader, split_count);
  const auto threshold = getColumn(reader, split_count);
  std::vector<ForestNode> splits;
  for (std::size_t level = 0; level < of_level.size(); ++level) {
    for (std::size_t i = 0; i < of_level[level]; ++i) {
      const std::size_t k = splits.size();
      const std::vector<Probe>& known = probes[level];
      if (u[k] >= known.size() || v[k] >= known.size()) reader.failDamaged("a probe that its level has not");
      splits.push_back({known[u[k]], known[v[k]], static_cast<float>(static_cast<std::int16_t>(threshold[k])) * 0.001F,
                        static_cast<std::int32_t>(2 * k + 1)});
    }
  }
  return splits;
}

void getLeaves(Reader& reader, std::size_t count, std::size_t facings, ForestTree& tree) {
  tree.leaves.resize(count * facings);
  std::vector<std::uint8_t> has_probability(count, 0);
  const std::uint8_t* bits = reader.take(bytesOfBits(count * facings * kPartCount));
  for (std::size_t column = 0; column < facings * kPartCount; ++column) {
    LeafRow* const rows = tree.leaves.data() + column / kPartCount;
    forEachSetBit(bits, column * count, (column + 1) * count, [&](std::size_t leaf) {
      const auto value = reader.get<std::uint8_t>();
      if (value == 0) reader.failDamaged("a probability of 0 among the others");
      rows[leaf * facings][column % kPartCount] = value;
      has_probability[leaf] = 1;
    });
  }
  if (std::find(has_probability.begin(), has_probability.end(), 0) != has_probability.end()) {
    reader.failDamaged("a leaf without probability");
  }
}

ForestTree getTree(Reader& reader, std::size_t node_count, std::size_t facings) {
  const std::size_t split_count = node_count / 2;
  const std::uint8_t* bits = reader.take(bytesOfBits(node_count));
  const auto of_level = splitsOfLevels(node_count, [&](std::size_t n) { return bitAt(bits, n); });
  std::size_t reached = 0;
  for (const std::size_t count : of_level) reached += count;
  if (reached != split_count) reader.failDamaged("nodes and splits do not make a tree");
  const std::vector<ForestNode> splits = getSplits(reader, of_level, split_count);
  ForestTree tree;
  tree.nodes.resize(node_count);
  std::size_t split = 0;
  for (std::size_t n = 0; n < node_count; ++n) {
    const bool is_split = bitAt(bits, n);
    if (is_split && split == split_count) reader.failDamaged("too many splits");
    if (is_split) {
      tree.nodes[n] = splits[split++];
    } else {
      tree.nodes[n].child = -static_cast<std::int32_t>(n - split);
    }
  }
  getLeaves(reader, split_count + 1, facings, tree);
  return tree;
}

std::vector<std::uint8_t> unpacked(Reader& reader, std::size_t packed_bytes, std::size_t raw_bytes) {
  if (raw_bytes / kMaxPacking > packed_bytes) reader.failDamaged("impossible counts");
  std::vector<std::uint8_t> raw(raw_bytes);
  uLongf size = raw.size();
  const int status = uncompress(raw.data(), &size, reader.take(packed_bytes), packed_bytes);
  if (status != Z_OK || size != raw_bytes) reader.failDamaged("its data do not unpack");
  return raw;
}

struct Header {
  std::uint32_t trees = 0;
  std::uint32_t facings = 0;
  std::uint32_t origin_bytes = 0;
  std::uint64_t packed_bytes = 0;
  std::uint64_t raw_bytes = 0;
};

Header getHeader(Reader& reader, Bytes file, const std::string& where) {
  if (file.size() < kForestMagic.size() || std::memcmp(file.data(), kForestMagic.data(), kForestMagic.size()) != 0) {
    throw Error("this is not a forest file", where, "name a file made by depthmocap forest train");
  }
  reader.take(kForestMagic.size());
  const auto version = reader.get<std::uint32_t>();
  if (version != kForestVersion) {
    throw Error("forest file of version " + std::to_string(version) + ", this program reads version " +
                    std::to_string(kForestVersion),
                where, "use the program that made it or train a new forest");
  }
  Header h;
  h.trees = reader.get<std::uint32_t>();
  h.facings = reader.get<std::uint32_t>();
  h.origin_bytes = reader.get<std::uint32_t>();
  h.packed_bytes = reader.get<std::uint64_t>();
  h.raw_bytes = reader.get<std::uint64_t>();
  const auto expected = reader.get<std::uint32_t>();
  const std::uint8_t* body = file.data() + (file.size() - reader.left());
  if (crc32_z(crc32_z(0, nullptr, 0), body, reader.left()) != expected) {
    reader.fail("the forest file is damaged or truncated: wrong checksum");
  }
  if (h.trees == 0 || h.trees > kMaxTrees) reader.failDamaged("impossible number of trees");
  if (h.facings != 1 && h.facings != kFacingCount) reader.failDamaged("impossible number of facings");
  if (h.origin_bytes > kMaxOriginBytes) reader.failDamaged("impossible origin");
  return h;
}

Forest decode(Bytes file, const std::string& where) {
  Reader reader(file, where);
  const Header h = getHeader(reader, file, where);
  Forest forest;
  forest.facings = static_cast<int>(h.facings);
  forest.origin.assign(reinterpret_cast<const char*>(reader.take(h.origin_bytes)), h.origin_bytes);
  std::vector<std::size_t> node_counts(h.trees);
  std::size_t nodes = 0;
  std::size_t most_bytes = 0;
  for (std::size_t& count : node_counts) {
    count = reader.get<std::uint32_t>();
    if (count > kMaxNodes || count % 2 == 0) reader.failDamaged("impossible number of nodes");
    nodes += count;
    most_bytes += maxTreeBytes(count, h.facings);
  }
  if (nodes > kMaxNodes) reader.failDamaged("more nodes than any forest");
  if (h.packed_bytes != reader.left()) reader.fail("the forest file is truncated or has bytes too many");
  if (h.raw_bytes > most_bytes) reader.failDamaged("more data than its nodes need");
  const std::vector<std::uint8_t> raw = unpacked(reader, h.packed_bytes, h.raw_bytes);
  Reader trees(raw, where);
  for (const std::size_t count : node_counts) forest.trees.push_back(getTree(trees, count, h.facings));
  if (trees.left() != 0) reader.failDamaged("more data than its nodes need");
  return forest;
}

}  // namespace

Forest loadForest(const std::filesystem::path& path) {
  const std::string file = readFile(path, "the forest file", kMostFileBytes);
  return decode({reinterpret_cast<const std::uint8_t*>(file.data()), file.size()}, path.string());
}

}  // namespace depthmocap
