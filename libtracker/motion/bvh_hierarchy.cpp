#include "libtracker/motion/bvh_hierarchy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace depthmocap {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMaxBones = 1000;
constexpr int kMaxChannels = 9;  // position, rotation and scale

// "Xposition", "ZROTATION", "Xscale".
std::optional<BvhChannel> channelOf(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, BvhChannel>, 3> kKinds = {
      {{"position", 0}, {"rotation", kBvhRotation}, {"scale", kBvhScale}}};
  const std::string name = lowerCase(word);
  for (const auto& [kind, first] : kKinds) {
    if (name.size() == kind.size() + 1 && name.ends_with(kind) && name[0] >= 'x' && name[0] <= 'z') {
      return first + (name[0] - 'x');
    }
  }
  return std::nullopt;
}

class HierarchyParser {
 public:
  explicit HierarchyParser(TextScanner& text) : text_(text) {}

  BvhHierarchy parse() {
    if (lowerCase(text_.take("HIERARCHY")) != "hierarchy")
      text_.fail("the file does not begin with HIERARCHY", "is this a BVH file?");
    if (lowerCase(text_.take("ROOT")) != "root") text_.fail("the hierarchy does not begin with ROOT");
    tree();
    for (std::string key = next(); key != "motion"; key = next()) {
      if (key != "root") text_.fail(fmt::format("'{}' stands where MOTION should stand", key));
      tree();
    }
    return std::move(result_);
  }

 private:
  std::string next() { return lowerCase(text_.take("MOTION")); }

  MotionBone& bone(int index) { return result_.bones[static_cast<std::size_t>(index)]; }

  void tree() {
    beginBone(-1);
    int open = static_cast<int>(result_.bones.size()) - 1;  // the bone whose block is being read
    while (open >= 0) {
      const std::string key = lowerCase(text_.take("a line of the hierarchy"));
      if (key == "offset") {
        bone(open).offset = vector("an offset");
      } else if (key == "channels") {
        channels(open);
      } else if (key == "joint") {
        beginBone(open);
        open = static_cast<int>(result_.bones.size()) - 1;
      } else if (key == "end") {
        endSite(open);
      } else if (key == "}") {
        open = bone(open).parent;
      } else if (key == "{" || key == "motion") {
        text_.fail(fmt::format("'{}' does not belong here", key), "are the braces of the hierarchy complete?");
      } else {
        text_.takeRestOfLine(words_);
      }
    }
  }

  // Takes a name, which is the rest of the line with blanks as underscores, as other programs read it, and the '{'.
  std::string nameAndBrace() {
    std::string name;
    text_.takeRestOfLine(words_);
    for (const std::string_view word : words_) {
      if (word == "{") return name;
      if (!name.empty()) name += '_';
      name += word;
    }
    if (text_.take("'{'") != "{") text_.fail("'{' should stand here");
    return name;
  }

  void beginBone(int parent) {
    if (result_.bones.size() >= kMaxBones) text_.fail("too many joints");
    MotionBone bone;
    bone.parent = parent;
    bone.name = nameAndBrace();
    if (bone.name.empty()) text_.fail("a joint without a name");
    result_.bones.push_back(bone);
    result_.channels.emplace_back();
  }

  void endSite(int open) {
    if (!lowerCase(nameAndBrace()).starts_with("site")) text_.fail("'End' without 'Site'");
    for (;;) {
      const std::string key = lowerCase(text_.take("the End Site's offset"));
      if (key == "}") break;
      if (key == "offset") {
        bone(open).tip = vector("an offset");
        bone(open).has_tip = true;
      } else {
        text_.takeRestOfLine(words_);
      }
    }
  }

  Vector3d vector(const char* what) {
    Vector3d v;
    for (int i = 0; i < 3; ++i) v[i] = text_.takeNumber(what);
    return v;
  }

  void channels(int open) {
    auto& list = result_.channels[static_cast<std::size_t>(open)];
    if (!list.empty()) text_.fail("a joint has CHANNELS twice");
    const double count = text_.takeNumber("the number of channels");
    if (count < 0 || count > kMaxChannels || count != std::floor(count))
      text_.fail(fmt::format("the number of channels must be 0 to {}", kMaxChannels));
    for (int i = 0; i < static_cast<int>(count); ++i) {
      const auto channel = channelOf(text_.take("a channel"));
      if (!channel)
        text_.fail("an unknown channel", "known: Xposition .. Zposition, Xrotation .. Zrotation, Xscale .. Zscale");
      if (std::find(list.begin(), list.end(), *channel) != list.end()) text_.fail("a channel is given twice");
      list.push_back(*channel);
    }
    result_.channel_count += list.size();
  }

  TextScanner& text_;
  std::vector<std::string_view> words_;
  BvhHierarchy result_;
};

}  // namespace

BvhHierarchy readBvhHierarchy(TextScanner& text) {
  return HierarchyParser(text).parse();
}

std::vector<bool> largestTree(const std::vector<MotionBone>& bones) {
  std::vector<std::size_t> root(bones.size());
  std::vector<std::size_t> size(bones.size(), 0);
  for (std::size_t b = 0; b < bones.size(); ++b) {
    root[b] = bones[b].parent < 0 ? b : root[static_cast<std::size_t>(bones[b].parent)];
    ++size[root[b]];
  }
  const auto largest = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
  std::vector<bool> belongs;
  belongs.reserve(root.size());
  for (const std::size_t r : root) belongs.push_back(r == largest);
  return belongs;
}

}  // namespace depthmocap
