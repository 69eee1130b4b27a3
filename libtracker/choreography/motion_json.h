#pragma once
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace depthmocap {

// A value in a motion file and the place where it stands, which every error names.
class MotionJson {
 public:
  // Parses a file; Error if it is no JSON, no object or has a key twice.
  static nlohmann::ordered_json parse(std::string_view text, const std::string& name);

  // `owner` is the file, with the motion or part where there is one.
  MotionJson(const nlohmann::ordered_json& json, std::string owner, std::string pointer = {})
      : json_(&json), owner_(std::move(owner)), pointer_(std::move(pointer)) {}

  [[nodiscard]] const nlohmann::ordered_json& json() const { return *json_; }
  // "motions/exercise.json: motion squat: /steps/2/after"
  [[nodiscard]] std::string where() const { return pointer_.empty() ? owner_ : owner_ + ": " + pointer_; }
  [[noreturn]] void fail(const std::string& what, const std::string& advice = {}) const;

  [[nodiscard]] bool has(std::string_view key) const { return json_->is_object() && json_->contains(key); }
  // A member; Error if it is missing.
  [[nodiscard]] MotionJson at(const std::string& key) const;
  // The members of an object or the elements of an array, which must not be empty.
  [[nodiscard]] std::vector<std::pair<std::string, MotionJson>> members() const;
  [[nodiscard]] std::vector<MotionJson> elements() const;
  // Error naming the nearest of `known` if the object has another key. "about", a text for the reader, is always known.
  void checkKeys(const std::vector<std::string>& known) const;

  [[nodiscard]] std::string text() const;
  [[nodiscard]] int integer(int low, int high) const;
  // Error if `name` cannot name something new: other characters than a-z, 0-9 and _, or a meaning already.
  void checkNewName(const std::string& name) const;
  [[nodiscard]] std::string newName() const;

 private:
  [[nodiscard]] MotionJson child(const nlohmann::ordered_json& json, const std::string& key) const {
    return {json, owner_, pointer_ + "/" + key};
  }

  const nlohmann::ordered_json* json_;
  std::string owner_;
  std::string pointer_;  // to the value in the owner, as in RFC 6901
};

}  // namespace depthmocap
