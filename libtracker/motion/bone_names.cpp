#include "libtracker/motion/bone_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/json_file.h"
#include "libtracker/motion/text_scanner.h"

namespace depthmocap {
namespace {

// Names of a part without its side, best first: of "upleg" and "hip" in one file, the hip is something else.
using Names = std::span<const std::string_view>;
constexpr std::string_view kHumerus[] = {"humerus", "upperarm", "uparm",     "uarm",    "bicep",
                                         "arm",     "shldr",    "shldrbend", "shoulder"};
constexpr std::string_view kRadius[] = {"radius", "forearm", "forearmbend", "lowerarm", "lowarm", "farm", "elbow"};
constexpr std::string_view kWrist[] = {"wrist"};
constexpr std::string_view kHand[] = {"hand"};
constexpr std::string_view kFingerBase[] = {"fingerbase"};
constexpr std::string_view kFemur[] = {"femur", "upleg", "upperleg", "thigh", "thighbend", "hip", "leg"};
constexpr std::string_view kTibia[] = {"tibia", "lowerleg", "lowleg", "shin", "calf", "knee", "leg"};
constexpr std::string_view kFoot[] = {"ankle", "foot"};
constexpr std::string_view kToe[] = {"toes", "toebase", "toe", "ball", "foot"};
constexpr std::string_view kHead[] = {"head"};
constexpr std::string_view kCrown[] = {"headtopend"};

enum class BodySide { None, Left, Right };

// A name's reading: the side, and what is left of it.
struct Reading {
  BodySide side = BodySide::None;
  std::string part;
};

// Lower-case chunks between blanks, dots, dashes and underscores, without the name space ("mixamorig:"), trailing
// numbers and words that only say that it is a joint; how many of these were left away.
std::vector<std::string> chunksOf(std::string_view name, std::size_t& left_away) {
  const auto space = name.find_last_of(":|");
  if (space != std::string_view::npos) name.remove_prefix(space + 1);
  std::vector<std::string> chunks(1);
  for (const char c : name) {
    if (c == ' ' || c == '_' || c == '-' || c == '.') {
      chunks.emplace_back();
    } else {
      chunks.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  std::erase(chunks, "");
  constexpr std::array<std::string_view, 5> kSilent = {"jnt", "joint", "bone", "bn", "bind"};
  const auto silent = [&](const std::string& chunk) {
    return chunk.find_first_not_of("0123456789") == std::string::npos ||
           std::find(kSilent.begin(), kSilent.end(), chunk) != kSilent.end();
  };
  while (chunks.size() > 1 && silent(chunks.back())) {
    chunks.pop_back();
    ++left_away;
  }
  return chunks;
}

std::string joined(const std::vector<std::string>& chunks, std::size_t first) {
  std::string all;
  for (std::size_t i = first; i < chunks.size(); ++i) all += chunks[i];
  return all;
}

// The side that a chunk is or holds; what is left of the chunk.
Reading sideOfChunk(const std::string& chunk) {
  if (chunk == "l") return {BodySide::Left, ""};
  if (chunk == "r") return {BodySide::Right, ""};
  for (const auto& [word, side] :
       {std::pair<std::string_view, BodySide>{"left", BodySide::Left}, {"right", BodySide::Right}}) {
    const auto at = chunk.find(word);
    if (at == std::string::npos) continue;
    const std::string after = chunk.substr(at + word.size());
    return {side, after.empty() ? chunk.substr(0, at) : after};
  }
  return {BodySide::None, chunk};
}

class NameReader {
 public:
  NameReader(const std::vector<MotionBone>& bones, const BoneMap& map, const std::string& where)
      : bones_(bones), map_(map), where_(where) {
    for (const MotionBone& bone : bones) readings_.push_back(readingsOf(bone.name));
  }

  NamedBones read() const {
    NamedBones named;
    named.head = find(BodySide::None, "head", kHead);
    named.crown = find(BodySide::None, "crown", kCrown);
    named.left = side(BodySide::Left, "left_");
    named.right = side(BodySide::Right, "right_");
    if (named.head < 0) named.head = endOfSpine(named);
    return named;
  }

  static constexpr std::array<std::string_view, 7> kSideParts = {"upper_arm", "lower_arm", "hand", "upper_leg",
                                                                 "lower_leg", "foot",      "toe"};

 private:
  // All readings of a name, those that leave less of it away first: a prefix before the side or the part may be
  // anything.
  static std::vector<Reading> readingsOf(const std::string& name) {
    std::size_t left_away = 0;
    std::vector<std::string> chunks = chunksOf(name, left_away);
    std::vector<Reading> readings(left_away);  // empty ones, so that "arm" comes before "arm_joint"
    BodySide side = BodySide::None;
    for (std::size_t i = chunks.size(); i-- > 0 && side == BodySide::None;) {
      const Reading reading = sideOfChunk(chunks[i]);
      side = reading.side;
      if (side == BodySide::None) continue;
      chunks[i] = reading.part;
      // "J_Bip_L_UpperArm": what stands before the side is a prefix, unless nothing stands behind it.
      if (!joined(chunks, i).empty()) chunks.erase(chunks.begin(), chunks.begin() + static_cast<std::ptrdiff_t>(i));
    }
    std::erase(chunks, "");
    for (std::size_t first = 0; first < chunks.size(); ++first) {
      const std::string part = joined(chunks, first);
      readings.push_back({side, part});
      // "lhumerus", "LThigh": one letter stands for the side.
      if (side == BodySide::None && part.size() > 1 && part[0] == 'l')
        readings.push_back({BodySide::Left, part.substr(1)});
      if (side == BodySide::None && part.size() > 1 && part[0] == 'r')
        readings.push_back({BodySide::Right, part.substr(1)});
      const std::string plain = part.substr(0, part.find_last_not_of("0123456789") + 1);
      if (plain != part && !plain.empty()) readings.push_back({side, plain});
    }
    // Helpers of a rig ("ik_foot_l", "upperarm_twist_01_l") are no bones of the body.
    constexpr std::array<std::string_view, 8> kHelpers = {"ik", "fk", "twist", "roll", "ctrl", "pole", "mch", "target"};
    const bool helper = std::any_of(chunks.begin(), chunks.end(), [&](const std::string& chunk) {
      return std::find(kHelpers.begin(), kHelpers.end(), chunk) != kHelpers.end();
    });
    return helper ? std::vector<Reading>{} : readings;
  }

  // Of the best name that there is, the bone that needs the fewest chunks left away; of equals the first. Only bones
  // below `ancestor` (-1: all).
  [[nodiscard]] int find(BodySide side, const std::string& key, Names names, int ancestor = -1) const {
    if (const auto given = map_.find(key); given != map_.end()) return boneOfMap(given->first, given->second);
    for (const std::string_view name : names) {
      int best = -1;
      std::size_t best_rank = 0;
      for (std::size_t b = 0; b < bones_.size(); ++b) {
        if (ancestor >= 0 && !isBelow(static_cast<int>(b), ancestor)) continue;
        const auto& readings = readings_[b];
        const auto found = std::find_if(readings.begin(), readings.end(),
                                        [&](const Reading& r) { return r.side == side && r.part == name; });
        const auto rank = static_cast<std::size_t>(found - readings.begin());
        if (found == readings.end() || (best >= 0 && rank >= best_rank)) continue;
        best = static_cast<int>(b);
        best_rank = rank;
      }
      if (best >= 0) return best;
    }
    return -1;
  }

  [[nodiscard]] int boneOfMap(const std::string& key, const std::string& name) const {
    for (std::size_t b = 0; b < bones_.size(); ++b) {
      if (bones_[b].name == name) return static_cast<int>(b);
    }
    throw Error(fmt::format("the bone map's {} is '{}', which the file does not have", key, name), where_);
  }

  // False for no bone (-1): a file may have one arm.
  [[nodiscard]] bool isBelow(int bone, int ancestor) const {
    for (int b = bone < 0 ? -1 : parentOf(bone); b >= 0; b = parentOf(b)) {
      if (b == ancestor) return true;
    }
    return false;
  }
  [[nodiscard]] int parentOf(int bone) const { return bones_[static_cast<std::size_t>(bone)].parent; }

  // Where no bone is named head (Rigify's is spine.006): from the bone that carries both arms, up the branch with the
  // most bones that carries neither, to its end or to where it divides. -1 if there is none.
  [[nodiscard]] int endOfSpine(const NamedBones& named) const {
    int thorax = named.left.humerus;
    while (thorax >= 0 && !isBelow(named.right.humerus, thorax)) thorax = parentOf(thorax);
    const auto carries = [&](int bone, int limb) { return bone == limb || isBelow(limb, bone); };
    int end = -1;
    for (int from = thorax; from >= 0;) {
      std::vector<int> branches;
      for (int b = 0; b < static_cast<int>(bones_.size()); ++b) {
        if (parentOf(b) != from || carries(b, named.left.humerus) || carries(b, named.right.humerus)) continue;
        if (!carries(b, named.left.femur) && !carries(b, named.right.femur)) branches.push_back(b);
      }
      if (branches.empty() || (from != thorax && branches.size() > 1)) break;
      from = *std::max_element(branches.begin(), branches.end(), [&](int a, int b) { return weight(a) < weight(b); });
      end = from;
    }
    return end;
  }

  // How many bones hang on one.
  [[nodiscard]] std::ptrdiff_t weight(int bone) const {
    std::ptrdiff_t count = 0;
    for (int b = 0; b < static_cast<int>(bones_.size()); ++b) count += isBelow(b, bone) ? 1 : 0;
    return count;
  }

  [[nodiscard]] NamedBones::Side side(BodySide of, const std::string& prefix) const {
    NamedBones::Side s;
    // A bone above: "LeftShoulder" is a collar where a "LeftArm" carries the forearm.
    s.humerus = find(of, prefix + "upper_arm", kHumerus);
    s.radius = s.humerus < 0 ? -1 : find(of, prefix + "lower_arm", kRadius, s.humerus);
    s.wrist = s.radius < 0 ? -1 : find(of, prefix + "wrist", kWrist, s.radius);
    s.hand = s.radius < 0 ? -1 : find(of, prefix + "hand", kHand, s.radius);
    s.finger_base = find(of, prefix + "finger_base", kFingerBase);
    s.femur = find(of, prefix + "upper_leg", kFemur);
    s.tibia = s.femur < 0 ? -1 : find(of, prefix + "lower_leg", kTibia, s.femur);
    // "LeftLeg" is a shin below a thigh, and a thigh above a knee.
    if (s.tibia < 0) {
      s.femur = find(of, prefix + "upper_leg", Names(kFemur).subspan(std::size(kFemur) - 1));
      s.tibia = s.femur < 0 ? -1 : find(of, prefix + "lower_leg", kTibia, s.femur);
    }
    s.foot = s.tibia < 0 ? -1 : find(of, prefix + "foot", kFoot, s.tibia);
    s.toe = s.foot < 0 ? -1 : find(of, prefix + "toe", kToe, s.foot);
    if (s.toe == s.foot) s.toe = -1;
    return s;
  }

  const std::vector<MotionBone>& bones_;
  const BoneMap& map_;
  const std::string& where_;
  std::vector<std::vector<Reading>> readings_;
};

}  // namespace

BoneMap readBoneMap(const std::filesystem::path& path) {
  std::vector<std::string> parts = {"head"};
  for (const std::string_view part : NameReader::kSideParts) {
    for (const char* side : {"left_", "right_"}) parts.push_back(side + std::string(part));
  }
  BoneMap map;
  const nlohmann::json object = readJsonFile(path);
  for (const auto& [part, bone] : object.items()) {
    if (std::find(parts.begin(), parts.end(), part) == parts.end()) {
      throw Error(fmt::format("'{}' is no part of the body", part), path.string(),
                  fmt::format("known: {}", fmt::join(parts, " ")));
    }
    map[part] = jsonString(object, part, path.string());
  }
  return map;
}

NamedBones namedBones(const std::vector<MotionBone>& bones, const BoneMap& map, const std::string& where) {
  return NameReader(bones, map, where).read();
}

}  // namespace depthmocap
