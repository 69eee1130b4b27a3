#include "apps/ik/request.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include <fmt/format.h>

#include "apps/ik/bones.h"
#include "apps/ik/json_numbers.h"
#include "depthmocap/error.h"
#include "libtracker/core/json_file.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

using nlohmann::json;

constexpr const char* kWhere = "request";
// Of a joint against the others; more would leave the others nothing to say.
constexpr double kLargestWeight = 1000.0;
constexpr double kLargestPriorWeight_m = 1.0;  // as --weight of `ik`

json parsed(const std::string& body) {
  json request = parseJson(body, kWhere);
  for (const auto& [key, value] : request.items()) {
    if (std::ranges::find(IkRequests::kKeys, key) == IkRequests::kKeys.end()) {
      throw Error(fmt::format("there is no key '{}'", key), kWhere,
                  fmt::format("keys are {}", fmt::join(IkRequests::kKeys, ", ")));
    }
  }
  return request;
}

Joint jointOf(const std::string& name) {
  const auto joint = jointNamed(name);
  if (!joint) {
    throw Error(fmt::format("there is no joint '{}'", name), kWhere, fmt::format("{}", fmt::join(kJointNames, " ")));
  }
  return *joint;
}

void addWeights(const json& request, JointTargets& targets) {
  if (!request.contains("weights")) return;
  if (!request["weights"].is_object()) throw Error("weights must be an object of joints and numbers", kWhere);
  for (const auto& [name, weight] : request["weights"].items()) {
    const auto joint = static_cast<std::size_t>(jointOf(name));
    if (!targets.given[joint]) throw Error(fmt::format("'{}' has a weight but no target", name), kWhere);
    if (!weight.is_number() || !(weight.get<double>() > 0) || weight.get<double>() > kLargestWeight) {
      throw Error(fmt::format("the weight of '{}' must be above 0 and at most {}", name, kLargestWeight), kWhere);
    }
    targets.weight[joint] = weight.get<double>();
  }
}

// The pose of an earlier answer to go on from, where one is named.
std::optional<Pose> startOf(const json& request) {
  if (!request.contains("start")) return std::nullopt;
  const json& list = request["start"];
  const std::string rule = fmt::format("start must be the {} numbers of an answer's pose", kDofCount);
  if (!list.is_array() || list.size() != kDofCount) throw Error(rule, kWhere);
  Pose q;
  for (int i = 0; i < kDofCount; ++i) {
    const json& value = list[static_cast<std::size_t>(i)];
    if (!value.is_number() || !(std::abs(value.get<double>()) <= kFarthestTarget_m)) throw Error(rule, kWhere);
    q[i] = value.get<double>();
  }
  return clampedToLimits(q);
}

// Joints that stay where they are in the start.
void addHeld(const json& request, const Skeleton& skeleton, const std::optional<Pose>& start, JointTargets& targets) {
  if (!request.contains("hold")) return;
  if (!start) throw Error("hold needs a start", kWhere);
  if (!request["hold"].is_array()) throw Error("hold must be a list of joints", kWhere);
  const JointPositions joints = jointPositions(skeleton, *start);
  for (const json& name : request["hold"]) {
    if (!name.is_string()) throw Error("hold must be a list of joints", kWhere);
    const Joint joint = jointOf(name.get<std::string>());
    const std::string refused = targets.add(joint, joints.col(static_cast<int>(joint)));
    if (!refused.empty()) throw Error(refused, kWhere);
  }
}

JointTargets targetsOf(const json& request) {
  if (!request.contains("targets") || !request["targets"].is_object() || request["targets"].empty()) {
    throw Error("targets must be an object with at least one joint", kWhere);
  }
  JointTargets targets;
  for (const auto& [name, p] : request["targets"].items()) {
    const Joint joint = jointOf(name);
    const auto is_number = [](const json& value) { return value.is_number(); };
    if (!p.is_array() || p.size() != 3 || !std::all_of(p.begin(), p.end(), is_number)) {
      throw Error(fmt::format("the target of '{}' must be [x, y, z]", name), kWhere);
    }
    const std::string refused = targets.add(joint, {p[0].get<double>(), p[1].get<double>(), p[2].get<double>()});
    if (!refused.empty()) throw Error(refused, kWhere);
  }
  return targets;
}

std::string textOf(const json& request, const char* key) {
  if (!request.contains(key)) return {};
  if (!request[key].is_string()) throw Error(fmt::format("{} must be a text", key), kWhere);
  return request[key].get<std::string>();
}

std::optional<double> priorWeightOf(const json& request) {
  if (!request.contains("prior_weight_m")) return std::nullopt;
  const json& weight = request["prior_weight_m"];
  if (!weight.is_number() || !(weight.get<double>() >= 0) || weight.get<double>() > kLargestPriorWeight_m) {
    throw Error(fmt::format("prior_weight_m must be a number from 0 to {}", kLargestPriorWeight_m), kWhere);
  }
  return weight.get<double>();
}

std::optional<BoneConvention> boneConventionOf(const json& request) {
  if (!request.contains("bones")) return std::nullopt;
  const auto* const found = std::ranges::find(kBoneConventionNames, textOf(request, "bones"));
  if (found == kBoneConventionNames.end()) {
    throw Error(fmt::format("bones must be one of {}", fmt::join(kBoneConventionNames, ", ")), kWhere);
  }
  return static_cast<BoneConvention>(found - kBoneConventionNames.begin());
}

json answerOf(const Skeleton& skeleton, const IkResult& result) {
  const JointPositions positions = jointPositions(skeleton, result.q);
  json joints;
  for (int i = 0; i < kJointCount; ++i) {
    joints[std::string(kJointNames[static_cast<std::size_t>(i)])] = listOf(positions.col(i));
  }
  json pose = json::array();
  for (const double value : result.q) pose.push_back(rounded(value));
  json rotations;
  for (int i = 0; i < kBoneCount; ++i) {
    const Eigen::Quaterniond r(localRotation(static_cast<Bone>(i), result.q));
    rotations[std::string(kBoneNames[static_cast<std::size_t>(i)])] = {rounded(r.w()), rounded(r.x()), rounded(r.y()),
                                                                       rounded(r.z())};
  }
  return {{"joints", joints},
          {"rotations", rotations},
          {"root", listOf(result.q.head<3>())},
          {"pose", pose},
          {"residual_m", rounded(result.residual_m)}};
}

}  // namespace

IkRequests::IkRequests(const IkCommandOptions& options) : skeleton_(ikSkeleton(options)) {
  const auto learned = ikLearnedPoses(options);
  for (int prior = 0; prior < kIkPriorCount; ++prior) {
    IkConfig config;
    config.prior = static_cast<IkPrior>(prior);
    lm_.emplace_back(skeleton_, config, learned);
  }
  for (const IkMethod method : {IkMethod::Jacobian, IkMethod::Ccd, IkMethod::Fabrik, IkMethod::Latent}) {
    IkConfig config;
    config.method = method;
    others_.emplace_back(skeleton_, config, learned);
  }
}

std::string IkRequests::answer(const std::string& body) const {
  const json request = parsed(body);
  JointTargets targets = targetsOf(request);
  const std::optional<Pose> pose_before = startOf(request);
  addHeld(request, skeleton_, pose_before, targets);
  addWeights(request, targets);
  const std::string solver_name = textOf(request, "solver");
  const std::string prior_name = textOf(request, "prior");
  const IkMethod method = solver_name.empty() ? IkMethod::Lm : ikMethodNamed(solver_name);
  const IkPrior prior = prior_name.empty() ? defaultPrior(method) : ikPriorNamed(prior_name);
  if (method != IkMethod::Lm && prior != IkPrior::None) throw Error("a prior needs the solver lm", kWhere);
  const IkRun run{pose_before, priorWeightOf(request)};
  if (method != IkMethod::Lm && (run.start || run.weight_m || request.contains("weights"))) {
    throw Error("start, weights and prior_weight_m need the solver lm", kWhere);
  }
  const std::optional<BoneConvention> bones = boneConventionOf(request);
  const IkSolver& solver =
      method == IkMethod::Lm ? lm_[static_cast<std::size_t>(prior)] : others_[static_cast<std::size_t>(method) - 1];
  const auto start = std::chrono::steady_clock::now();
  const IkResult result = method == IkMethod::Lm ? solver.solve(targets, run) : solver.solve(targets);
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  json answer = answerOf(skeleton_, result);
  answer["ms"] = time.count();
  if (bones) answer["bones"] = bonesOf(*bones, skeleton_, result.q);
  return answer.dump();
}

}  // namespace depthmocap
