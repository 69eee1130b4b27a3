#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>

#include <fmt/format.h>

#include "libtracker/motion/asf_amc.h"
#include "libtracker/motion/text_scanner.h"

namespace depthmocap {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kMetresPerInch = 0.0254;
constexpr std::size_t kMaxBones = 1000;

struct AsfBone {
  std::string name;
  Vector3d direction = Vector3d::Zero();
  double length = 0;
  Vector3d axis = Vector3d::Zero();
  std::string axis_order = "xyz";
  std::vector<MotionChannel> channels;
  std::vector<std::string> children;
  int line = 0;
};

class AsfParser {
 public:
  explicit AsfParser(const std::filesystem::path& path) : text_(path, ",()", '#') { root_.name = "root"; }

  AsfSkeleton parse() {
    while (!text_.atEnd()) {
      const std::string section = lowerCase(text_.take("a section"));
      if (!section.starts_with(':'))
        text_.fail("a section such as :bonedata should stand here", "is this an ASF file?");
      text_.takeRestOfLine(words_);
      if (section == ":units") units();
      if (section == ":root") root();
      if (section == ":bonedata") boneData();
      if (section == ":hierarchy") hierarchy();
      // Other sections (:version, :name, :documentation, :skin, unknown ones) run to the next line that begins with
      // ':'.
      while (!text_.atEnd() && !text_.peek().starts_with(':')) text_.takeLine(words_);
    }
    return build();
  }

 private:
  // Takes one line of a section; false where the section or the file ends.
  bool lineOfSection() {
    if (text_.atEnd() || text_.peek().starts_with(':')) return false;
    text_.takeLine(words_);
    return true;
  }

  double numberAt(std::size_t i, const char* what) const {
    if (i >= words_.size()) text_.fail(std::string(what) + " is missing");
    return text_.number(words_[i], what);
  }

  Vector3d vectorAt(std::size_t i, const char* what) const {
    return {numberAt(i, what), numberAt(i + 1, what), numberAt(i + 2, what)};
  }

  void units() {
    while (lineOfSection()) {
      const std::string key = lowerCase(words_[0]);
      if (key == "length") {
        const double length = numberAt(1, "the unit of length");
        if (length <= 1e-6) text_.fail("the unit of length must be positive");
        metres_per_unit_ = kMetresPerInch / length;
      } else if (key == "angle") {
        const std::string unit = words_.size() > 1 ? lowerCase(words_[1]) : "";
        if (unit != "deg" && unit != "rad") text_.fail("the unit of angles must be deg or rad");
        degrees_ = unit == "deg";
      }
    }
  }

  std::vector<MotionChannel> channelsFrom(std::size_t first) const {
    static const std::map<std::string, MotionChannel> kNames = {
        {"tx", MotionChannel::Tx}, {"ty", MotionChannel::Ty}, {"tz", MotionChannel::Tz},   {"rx", MotionChannel::Rx},
        {"ry", MotionChannel::Ry}, {"rz", MotionChannel::Rz}, {"l", MotionChannel::Length}};
    std::vector<MotionChannel> channels;
    for (std::size_t i = first; i < words_.size(); ++i) {
      const auto found = kNames.find(lowerCase(words_[i]));
      if (found == kNames.end())
        text_.fail(fmt::format("'{}' is not a channel this program knows (tx .. rz, l)", words_[i]));
      if (std::count(channels.begin(), channels.end(), found->second) > 0) text_.fail("a channel is given twice");
      channels.push_back(found->second);
    }
    return channels;
  }

  void axisOrder(std::size_t i, AsfBone& bone) const {
    if (i >= words_.size()) return;
    bone.axis_order = lowerCase(words_[i]);
    std::string sorted = bone.axis_order;
    std::sort(sorted.begin(), sorted.end());
    if (sorted != "xyz") text_.fail(fmt::format("the axis order '{}' is not an order of X, Y and Z", words_[i]));
  }

  void root() {
    while (lineOfSection()) {
      const std::string key = lowerCase(words_[0]);
      if (key == "order") root_.channels = channelsFrom(1);
      if (key == "axis") axisOrder(1, root_);
      if (key == "position") root_position_ = vectorAt(1, "the root's position");
      if (key == "orientation") root_orientation_ = vectorAt(1, "the root's orientation");
    }
  }

  void boneData() {
    std::optional<AsfBone> bone;
    while (lineOfSection()) {
      const std::string key = lowerCase(words_[0]);
      if (key == "begin") {
        if (bone) text_.fail("a bone begins before the one before it ended");
        bone.emplace();
        bone->line = text_.line();
      } else if (key == "end") {
        if (!bone) text_.fail("an 'end' without 'begin'");
        add(*bone);
        bone.reset();
      } else if (bone) {
        boneLine(key, *bone);
      }
    }
    if (bone) text_.fail("the last bone has no 'end'", "is the file complete?");
  }

  void boneLine(const std::string& key, AsfBone& bone) {
    if (key == "name") {
      if (words_.size() < 2) text_.fail("the bone's name is missing");
      bone.name = words_[1];
    } else if (key == "direction") {
      bone.direction = vectorAt(1, "the bone's direction");
    } else if (key == "length") {
      bone.length = numberAt(1, "the bone's length");
      if (bone.length < 0) text_.fail("the bone's length is negative");
    } else if (key == "axis") {
      bone.axis = vectorAt(1, "the bone's axis");
      axisOrder(4, bone);
    } else if (key == "dof") {
      bone.channels = channelsFrom(1);
    }
    // Everything else (id, limits and its further lines, bodymass, cofmass, unknown keys) is not needed.
  }

  void add(const AsfBone& bone) {
    if (bone.name.empty()) text_.fail("a bone without a name");
    if (bone.name == "root" || bones_.contains(bone.name))
      text_.fail(fmt::format("the bone {} is given twice", bone.name));
    if (bone.length > 0 && bone.direction.norm() < 1e-6)
      text_.fail(fmt::format("the bone {} has no direction", bone.name));
    if (bones_.size() >= kMaxBones) text_.fail("too many bones");
    bones_.emplace(bone.name, bone);
  }

  AsfBone& boneNamed(std::string_view name) {
    if (name == "root") return root_;
    const auto found = bones_.find(std::string(name));
    if (found == bones_.end())
      text_.fail(fmt::format("the hierarchy names a bone '{}' that :bonedata does not have", name));
    return found->second;
  }

  void hierarchy() {
    std::set<std::string> attached;
    while (lineOfSection()) {
      const std::string key = lowerCase(words_[0]);
      if (key == "begin" || key == "end") continue;
      AsfBone& parent = boneNamed(words_[0]);
      for (std::size_t i = 1; i < words_.size(); ++i) {
        const AsfBone& child = boneNamed(words_[i]);
        if (&child == &root_ || !attached.insert(child.name).second) {
          text_.fail(fmt::format("the bone {} has two parents", child.name));
        }
        parent.children.push_back(child.name);
      }
    }
  }

  [[nodiscard]] Matrix3d rotation(const Vector3d& angles, const std::string& order) const {
    const double unit = *degrees_ ? std::numbers::pi / 180.0 : 1.0;
    Matrix3d R = Matrix3d::Identity();
    for (std::size_t i = 0; i < 3; ++i) {
      const int axis = order[i] - 'x';
      R = Eigen::AngleAxisd(unit * angles[static_cast<Eigen::Index>(i)], Vector3d::Unit(axis)).toRotationMatrix() * R;
    }
    return R;
  }

  AsfSkeleton build() {
    if (!degrees_) text_.fail(":units does not say whether angles are deg or rad");
    if (bones_.empty()) text_.fail("there is no :bonedata");
    if (root_.channels.empty()) text_.fail(":root has no order");
    AsfSkeleton skeleton;
    skeleton.metres_per_unit = metres_per_unit_;
    skeleton.degrees = *degrees_;
    append(root_, -1, Vector3d::Zero(), skeleton);
    skeleton.motions[0].position = metres_per_unit_ * root_position_;
    skeleton.motions[0].orientation = rotation(root_orientation_, root_.axis_order);
    // Breadth first: the list grows while its bones' children are attached.
    for (std::size_t i = 0; i < skeleton.bones.size(); ++i) {
      const Vector3d tip = skeleton.bones[i].tip;
      for (const std::string& child : boneNamed(skeleton.bones[i].name).children) {
        append(bones_.at(child), static_cast<int>(i), tip, skeleton);
      }
    }
    if (skeleton.bones.size() != bones_.size() + 1) text_.fail(":hierarchy does not attach every bone to the root");
    return skeleton;
  }

  void append(const AsfBone& bone, int parent, const Vector3d& offset, AsfSkeleton& skeleton) const {
    MotionBone result;
    result.name = bone.name;
    result.parent = parent;
    result.offset = offset;
    result.has_tip = parent >= 0;
    if (bone.length > 0) result.tip = bone.direction.normalized() * (bone.length * metres_per_unit_);
    skeleton.bones.push_back(result);
    AsfSkeleton::Motion motion;
    motion.channels = bone.channels;
    motion.axis = rotation(bone.axis, bone.axis_order);
    skeleton.motions.push_back(motion);
  }

  TextScanner text_;
  std::vector<std::string_view> words_;
  double metres_per_unit_ = kMetresPerInch;
  std::optional<bool> degrees_;
  AsfBone root_;
  Vector3d root_position_ = Vector3d::Zero();
  Vector3d root_orientation_ = Vector3d::Zero();
  std::map<std::string, AsfBone> bones_;
};

}  // namespace

AsfSkeleton readAsf(const std::filesystem::path& path) {
  return AsfParser(path).parse();
}

}  // namespace depthmocap
