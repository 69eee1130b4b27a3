#include "apps/ik/request.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/json_file.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

using nlohmann::json;

constexpr const char* kWhere = "request";
constexpr std::array<std::string_view, 6> kKeys = {"targets", "prior", "solver", "weights", "start", "hold"};
// Of a joint against the others; more would leave the others nothing to say.
constexpr double kLargestWeight = 1000.0;

json parsed(const std::string& body) {
  json request = parseJson(body, kWhere);
  for (const auto& [key, value] : request.items()) {
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
      throw Error(fmt::format("there is no key '{}'", key), kWhere, fmt::format("keys are {}", fmt::join(kKeys, ", ")));
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

// Micrometres and microradians are enough.
double rounded(double value) {
  return std::round(value * 1e6) / 1e6;
}

json listOf(const Eigen::Vector3d& p) {
  return {rounded(p.x()), rounded(p.y()), rounded(p.z())};
}

}  // namespace

IkRequests::IkRequests(const IkCommandOptions& options) : skeleton_(ikSkeleton(options)) {
  const auto learned = ikLearnedPoses(options);
  for (int prior = 0; prior < kIkPriorCount; ++prior) {
    IkConfig config;
    config.prior = static_cast<IkPrior>(prior);
    lm_.emplace_back(skeleton_, config, learned);
  }
  for (const IkMethod method : {IkMethod::Jacobian, IkMethod::Ccd, IkMethod::Fabrik}) {
    IkConfig config;
    config.method = method;
    classic_.emplace_back(skeleton_, config, nullptr);
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
  if (method != IkMethod::Lm && (pose_before || request.contains("weights"))) {
    throw Error("start and weights need the solver lm", kWhere);
  }
  const IkSolver& solver =
      method == IkMethod::Lm ? lm_[static_cast<std::size_t>(prior)] : classic_[static_cast<std::size_t>(method) - 1];
  const auto start = std::chrono::steady_clock::now();
  const IkResult result = pose_before ? solver.solve(targets, *pose_before) : solver.solve(targets);
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  const JointPositions positions = jointPositions(skeleton_, result.q);
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
  return json{{"joints", joints},
              {"rotations", rotations},
              {"root", listOf(result.q.head<3>())},
              {"pose", pose},
              {"residual_m", rounded(result.residual_m)},
              {"ms", time.count()}}
      .dump();
}

}  // namespace depthmocap
