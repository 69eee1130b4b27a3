// The forest file, little-endian:
//
//   "DMCFORST"  u32 version  u32 trees  u32 facings  u32 origin bytes  u64 packed bytes  u32 CRC-32 of all that follows
//   origin (UTF-8), u32 nodes of each tree, then one zlib stream.
//
// The stream holds for each tree, nodes in breadth-first order, column by column, so that equal columns pack well: a
// bit per node, 1 = split; of the splits u.x, u.y, v.x, v.y [px * m] and the threshold [mm], all i16, first every low
// byte, then every high byte; of the leaves the 15 probabilities * 255 of each facing, part by part. Breadth-first
// order makes child indices superfluous: the children of the k-th split are nodes 2 k + 1 and 2 k + 2, and the k-th
// leaf has distribution k.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>

#include <zlib.h>

#include "libtracker/classify/forest.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/check.h"
#include "libtracker/core/error.h"

namespace depthmocap {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is copied byte by byte");

constexpr std::array<char, 8> kMagic = {'D', 'M', 'C', 'F', 'O', 'R', 'S', 'T'};
constexpr std::uint32_t kVersion = 2;           // written
constexpr std::uint32_t kVersionOneFacing = 1;  // read too: without the number of facings, which is 1
constexpr std::uint32_t kMaxTrees = 64;
constexpr std::uint32_t kMaxNodes = 1U << 23U;
constexpr std::uint32_t kMaxOriginBytes = 4096;
constexpr std::size_t kMaxPacking = 1032;  // zlib's best ratio

using Bytes = std::vector<std::uint8_t>;

template <typename T>
void put(Bytes& bytes, T value) {
  const auto raw = std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value);
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

std::uint32_t checksum(const std::uint8_t* data, std::size_t size) {
  return static_cast<std::uint32_t>(crc32_z(crc32_z(0, nullptr, 0), data, size));
}

// ---- writing
// -------------------------------------------------------------------------------------------------------------

std::vector<std::int32_t> breadthFirstOrder(const ForestTree& tree) {
  std::vector<std::int32_t> order{0};
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::int32_t child = tree.nodes[static_cast<std::size_t>(order[i])].child;
    if (child > 0) order.insert(order.end(), {child, child + 1});
  }
  return order;
}

void putColumn(Bytes& bytes, const std::vector<std::int16_t>& column) {
  for (const std::int16_t value : column) bytes.push_back(static_cast<std::uint8_t>(value & 0xFF));
  for (const std::int16_t value : column) bytes.push_back(static_cast<std::uint8_t>((value >> 8) & 0xFF));
}

std::int16_t thresholdMillimetres(float threshold_m) {
  return static_cast<std::int16_t>(std::lround(std::fmin(std::fmax(threshold_m * 1000.0F, -32768.0F), 32767.0F)));
}

void putTree(Bytes& bytes, const ForestTree& tree, std::size_t facings) {
  const std::vector<std::int32_t> order = breadthFirstOrder(tree);
  const auto node = [&](std::int32_t i) -> const ForestNode& { return tree.nodes[static_cast<std::size_t>(i)]; };
  const std::size_t bits = bytes.size();
  bytes.resize(bits + (order.size() + 7) / 8);
  std::array<std::vector<std::int16_t>, 5> columns;
  std::vector<std::size_t> leaves;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const ForestNode& n = node(order[i]);
    if (n.child <= 0) {
      leaves.push_back(static_cast<std::size_t>(-n.child));
      continue;
    }
    bytes[bits + i / 8] = static_cast<std::uint8_t>(bytes[bits + i / 8] | (1U << (i % 8)));
    const std::array<std::int16_t, 5> row = {n.u[0], n.u[1], n.v[0], n.v[1], thresholdMillimetres(n.threshold_m)};
    for (std::size_t c = 0; c < row.size(); ++c) columns[c].push_back(row[c]);
  }
  for (const auto& column : columns) putColumn(bytes, column);
  for (std::size_t column = 0; column < facings * kPartCount; ++column) {
    for (const std::size_t leaf : leaves) {
      bytes.push_back(tree.leaves[leaf * facings + column / kPartCount][column % kPartCount]);
    }
  }
}

Bytes packed(const Bytes& raw) {
  Bytes result(compressBound(raw.size()));
  uLongf size = result.size();
  DMC_CHECK(compress2(result.data(), &size, raw.data(), raw.size(), Z_BEST_COMPRESSION) == Z_OK);
  result.resize(size);
  return result;
}

Bytes encode(const Forest& forest) {
  Bytes body(forest.origin.begin(), forest.origin.end());
  Bytes raw;
  for (const ForestTree& tree : forest.trees) {
    put(body, static_cast<std::uint32_t>(tree.nodes.size()));
    putTree(raw, tree, static_cast<std::size_t>(forest.facings));
  }
  const Bytes stream = packed(raw);
  body.insert(body.end(), stream.begin(), stream.end());
  Bytes file(kMagic.begin(), kMagic.end());
  put(file, kVersion);
  put(file, static_cast<std::uint32_t>(forest.trees.size()));
  put(file, static_cast<std::uint32_t>(forest.facings));
  put(file, static_cast<std::uint32_t>(forest.origin.size()));
  put(file, static_cast<std::uint64_t>(stream.size()));
  put(file, checksum(body.data(), body.size()));
  file.insert(file.end(), body.begin(), body.end());
  return file;
}

// ---- reading
// -------------------------------------------------------------------------------------------------------------

// Bytes that are taken from the front; taking more than there are is an Error.
class Reader {
 public:
  Reader(const Bytes& bytes, std::string where) : bytes_(bytes), where_(std::move(where)) {}
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(what, where_, "copy it again or train a new one: depthmocap forest train");
  }
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
  const Bytes& bytes_;
  std::string where_;
  std::size_t at_ = 0;
};

std::size_t rawBytes(std::size_t nodes, std::size_t facings) {
  const std::size_t splits = nodes / 2;
  return (nodes + 7) / 8 + splits * 5 * 2 + (splits + 1) * facings * kPartCount;
}

std::vector<std::int16_t> getColumn(Reader& reader, std::size_t count) {
  const std::uint8_t* low = reader.take(count);
  const std::uint8_t* high = reader.take(count);
  std::vector<std::int16_t> column(count);
  for (std::size_t i = 0; i < count; ++i) column[i] = static_cast<std::int16_t>(low[i] | (high[i] << 8));
  return column;
}

void getLeaves(Reader& reader, std::size_t count, std::size_t facings, ForestTree& tree) {
  tree.leaves.resize(count * facings);
  std::vector<bool> has_probability(count, false);
  for (std::size_t column = 0; column < facings * kPartCount; ++column) {
    const std::uint8_t* values = reader.take(count);
    for (std::size_t leaf = 0; leaf < count; ++leaf) {
      tree.leaves[leaf * facings + column / kPartCount][column % kPartCount] = values[leaf];
      if (values[leaf] != 0) has_probability[leaf] = true;
    }
  }
  if (std::find(has_probability.begin(), has_probability.end(), false) != has_probability.end()) {
    reader.fail("the forest file is damaged: a leaf without probability");
  }
}

ForestTree getTree(Reader& reader, std::size_t node_count, std::size_t facings) {
  ForestTree tree;
  tree.nodes.resize(node_count);
  const std::size_t split_count = node_count / 2;
  const std::uint8_t* bits = reader.take((node_count + 7) / 8);
  std::array<std::vector<std::int16_t>, 5> columns;
  for (auto& column : columns) column = getColumn(reader, split_count);
  std::size_t splits = 0;
  for (std::size_t i = 0; i < node_count; ++i) {
    if (i > 2 * splits) reader.fail("the forest file is damaged: a node without a parent");
    ForestNode& node = tree.nodes[i];
    if (((bits[i / 8] >> (i % 8)) & 1U) == 0) {
      node.child = -static_cast<std::int32_t>(i - splits);
      continue;
    }
    if (splits == split_count) reader.fail("the forest file is damaged: too many splits");
    node.u = {columns[0][splits], columns[1][splits]};
    node.v = {columns[2][splits], columns[3][splits]};
    node.threshold_m = static_cast<float>(columns[4][splits]) * 0.001F;
    node.child = static_cast<std::int32_t>(2 * splits + 1);
    ++splits;
  }
  if (splits != split_count) reader.fail("the forest file is damaged: too few splits");
  getLeaves(reader, split_count + 1, facings, tree);
  return tree;
}

Bytes unpacked(Reader& reader, std::size_t packed_bytes, std::size_t raw_bytes) {
  if (raw_bytes / kMaxPacking > packed_bytes) reader.fail("the forest file is damaged: impossible counts");
  Bytes raw(raw_bytes);
  uLongf size = raw.size();
  const int status = uncompress(raw.data(), &size, reader.take(packed_bytes), packed_bytes);
  if (status != Z_OK || size != raw_bytes) reader.fail("the forest file is damaged: its data do not unpack");
  return raw;
}

Forest decode(const Bytes& file, const std::string& where) {
  Reader reader(file, where);
  if (file.size() < kMagic.size() || std::memcmp(file.data(), kMagic.data(), kMagic.size()) != 0) {
    throw Error("this is not a forest file", where, "name a file made by depthmocap forest train");
  }
  reader.take(kMagic.size());
  const auto version = reader.get<std::uint32_t>();
  if (version != kVersion && version != kVersionOneFacing) {
    throw Error(
        "forest file of version " + std::to_string(version) + ", this program reads up to " + std::to_string(kVersion),
        where, "use the program that made it or train a new forest");
  }
  const auto tree_count = reader.get<std::uint32_t>();
  const auto facings = version == kVersionOneFacing ? 1U : reader.get<std::uint32_t>();
  const auto origin_bytes = reader.get<std::uint32_t>();
  const auto packed_bytes = reader.get<std::uint64_t>();
  const auto expected = reader.get<std::uint32_t>();
  if (checksum(file.data() + (file.size() - reader.left()), reader.left()) != expected) {
    reader.fail("the forest file is damaged or truncated: wrong checksum");
  }
  if (tree_count == 0 || tree_count > kMaxTrees) reader.fail("the forest file is damaged: impossible number of trees");
  if (facings != 1 && facings != kFacingCount) reader.fail("the forest file is damaged: impossible number of facings");
  if (origin_bytes > kMaxOriginBytes) reader.fail("the forest file is damaged: impossible origin");
  Forest forest;
  forest.facings = static_cast<int>(facings);
  forest.origin.assign(reinterpret_cast<const char*>(reader.take(origin_bytes)), origin_bytes);
  std::vector<std::size_t> node_counts(tree_count);
  std::size_t raw_bytes = 0;
  for (std::size_t& count : node_counts) {
    count = reader.get<std::uint32_t>();
    if (count > kMaxNodes || count % 2 == 0) reader.fail("the forest file is damaged: impossible number of nodes");
    raw_bytes += rawBytes(count, facings);
  }
  if (packed_bytes != reader.left()) reader.fail("the forest file is truncated or has bytes too many");
  const Bytes raw = unpacked(reader, packed_bytes, raw_bytes);
  Reader trees(raw, where);
  for (const std::size_t count : node_counts) forest.trees.push_back(getTree(trees, count, facings));
  return forest;
}

}  // namespace

Forest loadForest(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in || !std::filesystem::is_regular_file(path)) {
    throw Error("cannot open the forest file", path.string(), "check the name given with --forest");
  }
  Bytes file(static_cast<std::size_t>(in.tellg()));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(file.data()), static_cast<std::streamsize>(file.size()));
  if (!in) throw Error("cannot read the forest file", path.string(), "check the disk");
  return decode(file, path.string());
}

void saveForest(const Forest& forest, const std::filesystem::path& path) {
  checkForest(forest);
  DMC_CHECK(forest.trees.size() <= kMaxTrees && forest.origin.size() <= kMaxOriginBytes);
  const Bytes file = encode(forest);
  writeFileAtomically(path, {reinterpret_cast<const char*>(file.data()), file.size()});
}

}  // namespace depthmocap
