#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "libtracker/choreography/key_poses.h"

namespace depthmocap {

// The numbers of a KeyPose by name, as motion files write them: "pelvis" "y", "left_foot" "lift".
struct PostureGroup {
  std::string_view name;
  std::vector<std::string_view> fields;
  std::vector<double*> (*numbers)(KeyPose&);  // in the order of `fields`

  // Index of a field; nothing if there is no such field.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view field) const;
};

// Every group; the lists of names and numbers have one order.
const std::vector<PostureGroup>& postureGroups();
// Null if there is no such group.
const PostureGroup* findPostureGroup(std::string_view name);

// Puts left for right, arms and feet; the trunk stays as it is.
void swapSides(KeyPose& pose);

}  // namespace depthmocap
