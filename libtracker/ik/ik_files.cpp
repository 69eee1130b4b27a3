#include "libtracker/ik/ik_files.h"

#include <algorithm>
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

}  // namespace

std::vector<PoseTargets> readTargetsFile(const std::filesystem::path& path) {
  CsvReader csv(path);
  csv.readHeader({"pose_id", "joint", "x", "y", "z"});
  std::vector<PoseTargets> poses;
  std::unordered_map<std::string, std::size_t> index_of;
  while (csv.next()) {
    const std::string id = idOf(csv);
    const auto joint = jointNamed(csv.field(1));
    if (!joint) {
      csv.fail(fmt::format("there is no such joint; joints are {}", fmt::join(kJointNames, " ")));
    }
    const auto [at, is_new] = index_of.try_emplace(id, poses.size());
    if (is_new) poses.push_back({id, {}});
    const std::string refused = poses[at->second].targets.add(*joint, {csv.number(2), csv.number(3), csv.number(4)});
    if (!refused.empty()) csv.fail(refused);
  }
  if (poses.empty()) throw Error("holds no target", path.string(), "add rows pose_id,joint,x,y,z");
  return poses;
}

void writeSolvedPoses(const std::vector<PoseTargets>& poses, const std::vector<IkResult>& results,
                      const Skeleton& skeleton, const std::filesystem::path& path) {
  DMC_CHECK(poses.size() == results.size());
  AtomicFile file(path);
  file.write(header());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const IkResult& result = results[i];
    const JointPositions joints = jointPositions(skeleton, result.q);
    DMC_CHECK(joints.allFinite());
    std::string row = fmt::format("{},{}.000000,{}", poses[i].id, i, trackStateName(TrackState::Tracking));
    const auto out = std::back_inserter(row);
    for (int joint = 0; joint < kJointCount; ++joint) {
      const int given = poses[i].targets.has(static_cast<Joint>(joint)) ? 1 : 0;
      fmt::format_to(out, ",{:.6f},{:.6f},{:.6f},{}.000", joints(0, joint), joints(1, joint), joints(2, joint), given);
    }
    for (const double value : result.q) fmt::format_to(out, ",{:.6f}", value);
    fmt::format_to(out, ",{:.6f}\n", result.residual_m);
    file.write(row);
  }
  file.commit();
}

}  // namespace depthmocap
