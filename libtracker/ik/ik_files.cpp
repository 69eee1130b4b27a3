#include "libtracker/ik/ik_files.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <unordered_map>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "depthmocap/track_state.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/check.h"
#include "libtracker/core/csv.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

constexpr std::size_t kLongestId = 100;
// What lies farther out in a picture is a mistake, and would leave the range of numbers.
constexpr double kFarthestPixel = 1e6;

std::string idOf(const CsvReader& csv) {
  const std::string_view id = csv.field(0);
  if (id.empty()) csv.fail("pose_id is empty");
  const auto printable = [](char c) { return c > ' ' && c <= '~'; };
  if (id.size() > kLongestId || !std::all_of(id.begin(), id.end(), printable)) {
    csv.fail(fmt::format("pose_id must be up to {} printable characters without blanks", kLongestId));
  }
  return std::string(id);
}

std::string header() {
  std::string text = "pose_id,time_s,state";
  for (const std::string_view joint : kJointNames) text += fmt::format(",{0}_x,{0}_y,{0}_z,{0}_c", joint);
  return text + fmt::format(",{},residual_m\n", fmt::join(kDofNames, ","));
}

Joint jointOf(const CsvReader& csv) {
  const auto joint = jointNamed(csv.field(1));
  if (!joint) csv.fail(fmt::format("there is no such joint; joints are {}", fmt::join(kJointNames, " ")));
  return *joint;
}

double weightOf(const CsvReader& csv, std::size_t column) {
  if (column >= csv.fieldCount() || csv.field(column).empty()) return 1.0;
  const double weight = csv.number(column);
  if (weight < 0) csv.fail("weight must be at least 0");
  return weight;
}

// Whether v grows upwards: joints that are high in the T-pose have larger v, over all poses.
bool growsUp(const std::vector<PoseImageTargets>& poses) {
  const JointPositions t_pose = jointPositions(makeSkeleton(BoneLengths{}), Pose::Zero());
  double sum = 0;
  for (const PoseImageTargets& pose : poses) {
    double v_mean = 0;
    double spread = 0;
    for (const auto& target : pose.targets.targets) {
      v_mean += target.uv.y() / static_cast<double>(pose.targets.targets.size());
    }
    double covariance = 0;
    for (const auto& target : pose.targets.targets) {
      covariance += (target.uv.y() - v_mean) * t_pose(1, static_cast<int>(target.joint));
      spread += std::abs(target.uv.y() - v_mean);
    }
    if (spread > 0) sum += covariance / spread;  // each pose counts alike, however large it is in its picture
  }
  return sum >= 0;
}

// The entry of this pose; a new one for the first of its rows.
template <typename Targets>
Targets& entryOf(const std::string& id, std::unordered_map<std::string, std::size_t>& index_of,
                 std::vector<Targets>& poses) {
  const auto [at, is_new] = index_of.try_emplace(id, poses.size());
  if (is_new) poses.push_back({id, {}});
  return poses[at->second];
}

}  // namespace

std::vector<PoseTargets> readTargetsFile(const std::filesystem::path& path) {
  CsvReader csv(path);
  csv.readHeader({"pose_id", "joint", "x", "y", "z"});
  std::vector<PoseTargets> poses;
  std::unordered_map<std::string, std::size_t> index_of;
  while (csv.next()) {
    const std::string id = idOf(csv);
    const Joint joint = jointOf(csv);
    auto& pose = entryOf(id, index_of, poses);
    const std::string refused = pose.targets.add(joint, {csv.number(2), csv.number(3), csv.number(4)});
    if (!refused.empty()) csv.fail(refused);
  }
  if (poses.empty()) throw Error("holds no target", path.string(), "add rows pose_id,joint,x,y,z");
  return poses;
}

std::vector<PoseImageTargets> readImageTargetsFile(const std::filesystem::path& path, Projection projection,
                                                   VAxis v_axis) {
  CsvReader csv(path);
  csv.readHeader({"pose_id", "joint", "u", "v"});
  constexpr std::size_t kWeightColumn = 4;
  const bool has_weight = csv.fieldCount() > kWeightColumn && csv.field(kWeightColumn) == "weight";
  std::vector<PoseImageTargets> poses;
  std::unordered_map<std::string, std::size_t> index_of;
  while (csv.next()) {
    const std::string id = idOf(csv);
    const Joint joint = jointOf(csv);
    auto& pose = entryOf(id, index_of, poses);
    auto& targets = pose.targets.targets;
    for (const auto& other : targets) {
      if (other.joint == joint) csv.fail(fmt::format("joint '{}' is given twice for one pose", csv.field(1)));
    }
    const Eigen::Vector2d uv(csv.number(2), csv.number(3));
    const double weight = has_weight ? weightOf(csv, kWeightColumn) : 1.0;
    if (uv.cwiseAbs().maxCoeff() > kFarthestPixel) csv.fail("is no place in a picture");
    if (weight > 0) targets.push_back({joint, uv, weight});
  }
  if (poses.empty()) throw Error("holds no target", path.string(), "add rows pose_id,joint,u,v");
  for (const PoseImageTargets& pose : poses) {
    if (pose.targets.targets.size() >= kLeastImageTargets) continue;
    throw Error(fmt::format("pose '{}' has {} joints with a weight; a picture needs {}", pose.id,
                            pose.targets.targets.size(), kLeastImageTargets),
                path.string());
  }
  const bool is_down = v_axis == VAxis::Down || (v_axis == VAxis::Auto && !growsUp(poses));
  if (projection == Projection::Orthographic && is_down) {
    for (PoseImageTargets& pose : poses) {
      for (auto& target : pose.targets.targets) target.uv.y() = -target.uv.y();
    }
  }
  return poses;
}

void writeSolvedPoses(const std::vector<SolvedPose>& poses, const Skeleton& skeleton,
                      const std::filesystem::path& path) {
  AtomicFile file(path);
  file.write(header());
  for (const SolvedPose& pose : poses) {
    const JointPositions joints = jointPositions(skeleton, pose.result.q);
    DMC_CHECK(joints.allFinite());
    std::string row = fmt::format("{},{:.6f},{}", pose.id, pose.time_s, trackStateName(TrackState::Tracking));
    const auto out = std::back_inserter(row);
    for (int joint = 0; joint < kJointCount; ++joint) {
      const int given = pose.given[static_cast<std::size_t>(joint)] ? 1 : 0;
      fmt::format_to(out, ",{:.6f},{:.6f},{:.6f},{}.000", joints(0, joint), joints(1, joint), joints(2, joint), given);
    }
    for (const double value : pose.result.q) fmt::format_to(out, ",{:.6f}", value);
    fmt::format_to(out, ",{:.6f}\n", pose.result.residual_m);
    file.write(row);
  }
  file.commit();
}

}  // namespace depthmocap
