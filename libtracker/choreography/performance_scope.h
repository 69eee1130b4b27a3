#pragma once
#include <map>
#include <string>
#include <string_view>

#include "libtracker/choreography/motion_script.h"
#include "libtracker/choreography/step_numbers.h"

namespace depthmocap {

// The index of a list of `size` at `value`; Error naming `where` if there is none.
std::size_t chosenIndex(double value, std::size_t size, const std::string& where);

// What the names in a motion file mean while it is performed: numbers, hands, poses, the keys so far and the gait.
// A name with dots is a number of a posture: "pelvis.y" of the one that is being made, "seat.pelvis.y" of a pose;
// "last" and "before" are the last key and the one before it. "variant" is the variant, "time" the time of the last
// key.
class PerformanceScope {
 public:
  PerformanceScope(const Places& places, int variant, Random& random);
  PerformanceScope(const PerformanceScope&) = delete;
  PerformanceScope& operator=(const PerformanceScope&) = delete;
  ~PerformanceScope() = default;

  void let(const std::string& name, double value) { numbers_[name] = value; }
  void let(const std::string& name, const std::variant<Expression, GroupValue>& value);
  void setPose(const std::string& name, const KeyPose& pose) { poses_[name] = pose; }
  // Null if there is no such pose.
  [[nodiscard]] const KeyPose* findPose(const std::string& name) const;

  [[nodiscard]] double number(const Expression& expression);
  [[nodiscard]] Numbers numbers(const NamedNumbers& list);
  [[nodiscard]] HandTarget hand(const GroupValue& value);
  void change(const PostureChange& change, KeyPose& posture);

  KeySequence& keys() { return keys_; }
  GaitStyle& style() { return style_; }

 private:
  [[nodiscard]] std::optional<double> find(std::string_view name) const;
  [[nodiscard]] std::optional<double> findInPosture(std::string_view name) const;
  using Changes = std::vector<std::pair<std::size_t, double>>;
  [[nodiscard]] Changes resolve(const GroupValue& value, const PostureGroup& group);
  [[nodiscard]] Changes copied(const GroupCopy& copy, const PostureGroup& group);

  ExpressionScope expressions_;
  Places hands_;
  std::map<std::string, double, std::less<>> numbers_;
  std::map<std::string, KeyPose, std::less<>> poses_;
  KeySequence keys_;
  GaitStyle style_;
  KeyPose* posture_ = nullptr;  // the one that is being made
};

}  // namespace depthmocap
