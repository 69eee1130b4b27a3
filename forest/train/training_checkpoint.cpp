#include "forest/train/training_checkpoint.h"

#include <cstring>
#include <string_view>
#include <type_traits>

#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/read_file.h"

// "DMCTRAIN", a hash of all that follows, the length of the identity, the identity, the number of trees, and each
// tree's number of nodes and nodes as they are in memory: the file never leaves the machine.
namespace depthmocap {
namespace {

constexpr std::string_view kMagic = "DMCTRAIN";
constexpr std::size_t kMostBytes = mebibytes(1024);  // ten times that of the forest that comes with the library

using Node = TrainedTree::Node;
static_assert(std::is_trivially_copyable_v<Node>);

// FNV-1a
std::uint64_t hashOf(std::string_view bytes) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  for (const char c : bytes) hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x100000001B3ULL;
  return hash;
}

void putNumber(std::string& bytes, std::uint64_t n) {
  bytes.append(reinterpret_cast<const char*>(&n), sizeof n);
}

class Reader {
 public:
  Reader(std::string_view bytes, std::string where) : bytes_(bytes), where_(std::move(where)) {}
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(what, where_, "remove it or train without --resume");
  }
  std::string_view take(std::uint64_t count) {
    if (count > bytes_.size()) fail("the checkpoint is truncated");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  std::uint64_t number() {
    std::uint64_t n = 0;
    std::memcpy(&n, take(sizeof n).data(), sizeof n);
    return n;
  }
  [[nodiscard]] std::string_view left() const { return bytes_; }

 private:
  std::string_view bytes_;
  std::string where_;
};

}  // namespace

void saveCheckpoint(const std::filesystem::path& path, const std::string& identity,
                    const std::vector<TrainedTree>& trees) {
  std::string body;
  putNumber(body, identity.size());
  body += identity;
  putNumber(body, trees.size());
  for (const TrainedTree& tree : trees) {
    putNumber(body, tree.nodes.size());
    body.append(reinterpret_cast<const char*>(tree.nodes.data()), tree.nodes.size() * sizeof(Node));
  }
  std::string file(kMagic);
  putNumber(file, hashOf(body));
  writeFileAtomically(path, file + body);
}

std::vector<TrainedTree> loadCheckpoint(const std::filesystem::path& path, const std::string& identity) {
  if (!std::filesystem::exists(path)) return {};
  const std::string file = readFile(path, "the checkpoint", kMostBytes);
  Reader reader(file, path.string());
  if (reader.take(kMagic.size()) != kMagic) reader.fail("this is not a checkpoint");
  if (reader.number() != hashOf(reader.left())) reader.fail("the checkpoint is damaged or truncated");
  const std::string_view found = reader.take(reader.number());
  if (found != identity) {
    reader.fail("the checkpoint belongs to another training: \"" + std::string(found) + "\", not \"" + identity + "\"");
  }
  const std::uint64_t count = reader.number();
  if (count > reader.left().size()) reader.fail("the checkpoint is damaged");
  std::vector<TrainedTree> trees(count);
  for (TrainedTree& tree : trees) {
    const std::uint64_t node_count = reader.number();
    if (node_count > reader.left().size() / sizeof(Node)) reader.fail("the checkpoint is truncated");
    const std::string_view nodes = reader.take(node_count * sizeof(Node));
    if (nodes.empty()) continue;
    tree.nodes.resize(node_count);
    std::memcpy(static_cast<void*>(tree.nodes.data()), nodes.data(), nodes.size());
  }
  return trees;
}

}  // namespace depthmocap
