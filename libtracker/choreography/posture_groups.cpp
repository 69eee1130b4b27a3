#include "libtracker/choreography/posture_groups.h"

#include <algorithm>
#include <utility>

namespace depthmocap {
namespace {

std::vector<double*> numbersOfHand(HandTarget& h) {
  return {&h.out, &h.up, &h.forward, &h.elbow};
}
std::vector<double*> numbersOfFoot(FootKey& f) {
  return {&f.out, &f.forward, &f.lift, &f.pitch, &f.toe_out, &f.ground, &f.knee_out};
}

}  // namespace

std::optional<std::size_t> PostureGroup::find(std::string_view field) const {
  const auto found = std::find(fields.begin(), fields.end(), field);
  if (found == fields.end()) return std::nullopt;
  return static_cast<std::size_t>(found - fields.begin());
}

const std::vector<PostureGroup>& postureGroups() {
  static const std::vector<std::string_view> hand = {"out", "up", "forward", "elbow"};
  static const std::vector<std::string_view> foot = {"out",     "forward", "lift",    "pitch",
                                                     "toe_out", "ground",  "knee_out"};
  static const std::vector<PostureGroup> groups = {
      {"pelvis",
       {"x", "z", "y", "heading", "lean", "tilt", "held"},
       [](KeyPose& k) {
         PelvisState& p = k.pelvis;
         return std::vector<double*>{&p.x, &p.z, &p.y, &p.heading, &p.lean, &p.tilt, &p.held};
       }},
      {"spine",
       {"bend", "twist", "side"},
       [](KeyPose& k) {
         return std::vector<double*>{&k.spine.bend, &k.spine.twist, &k.spine.side};
       }},
      {"head",
       {"nod", "side", "turn"},
       [](KeyPose& k) {
         return std::vector<double*>{&k.head.nod, &k.head.side, &k.head.turn};
       }},
      {"left", hand, [](KeyPose& k) { return numbersOfHand(k.left); }},
      {"right", hand, [](KeyPose& k) { return numbersOfHand(k.right); }},
      {"left_foot", foot, [](KeyPose& k) { return numbersOfFoot(k.left_foot); }},
      {"right_foot", foot, [](KeyPose& k) { return numbersOfFoot(k.right_foot); }},
  };
  return groups;
}

const PostureGroup* findPostureGroup(std::string_view name) {
  const auto& groups = postureGroups();
  const auto found = std::find_if(groups.begin(), groups.end(), [&](const auto& group) { return group.name == name; });
  return found == groups.end() ? nullptr : &*found;
}

void swapSides(KeyPose& pose) {
  std::swap(pose.left, pose.right);
  std::swap(pose.left_foot, pose.right_foot);
}

}  // namespace depthmocap
