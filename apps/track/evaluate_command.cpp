#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/commands.h"
#include "depthmocap/error.h"
#include "libtracker/clinical/evaluate_angles.h"
#include "libtracker/evaluation/evaluate_joints.h"
#include "libtracker/evaluation/evaluate_poses.h"

namespace depthmocap {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct EvaluateOptions {
  fs::path joints;
  fs::path truth;
  fs::path pose;
  fs::path truth_pose;
  fs::path angles;
  int person = 1;
  EvaluationOptions evaluation;
};

// JSON knows no NaN: a figure about nothing is null.
Json figure(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

template <typename Names, typename Values>
Json namedFigures(const Names& names, const Values& values, int first = 0) {
  Json object = Json::object();
  for (auto i = static_cast<std::size_t>(first); i < names.size(); ++i) {
    object[std::string(names[i])] = figure(values[static_cast<decltype(values.size())>(i)]);
  }
  return object;
}

// The file of a recording's truth folder, or `truth` itself if it is a file.
fs::path truthFile(const fs::path& truth, const char* name) {
  if (!fs::is_directory(truth)) return truth;
  fs::path file = truth / "truth" / name;
  if (!fs::exists(file)) {
    throw Error(std::string("this recording has no truth/") + name, truth.string(),
                "name a file in the same format with --truth or --truth-pose");
  }
  return file;
}

fs::path truthPoseFile(const EvaluateOptions& options) {
  if (!options.truth_pose.empty()) return options.truth_pose;
  if (fs::exists(options.truth) && !fs::is_directory(options.truth)) {
    throw CLI::ValidationError(options.pose.empty() ? "--angles" : "--pose",
                               "needs --truth-pose when --truth names a file");
  }
  return truthFile(options.truth, "pose.csv");
}

std::optional<PoseFigures> poseFigures(const EvaluateOptions& options) {
  if (options.pose.empty()) return std::nullopt;
  return evaluatePoses(readPoseFile(options.pose, options.person), readPoseFile(truthPoseFile(options)),
                       options.evaluation);
}

// By name, and over confidence: {"from": 0.75, "to": 1, "angles": n, "rms_deg": x}.
Json clinicalFigures(const AngleFigures& angles) {
  Json by_confidence = Json::array();
  for (std::size_t bin = 0; bin < AngleFigures::kBins; ++bin) {
    by_confidence.push_back({{"from", static_cast<double>(bin) / AngleFigures::kBins},
                             {"to", static_cast<double>(bin + 1) / AngleFigures::kBins},
                             {"angles", angles.angles_by_confidence[bin]},
                             {"rms_deg", figure(angles.rms_by_confidence_deg[bin])}});
  }
  return {{"compared", angles.compared},
          {"rms_deg", namedFigures(kClinicalAngleNames, angles.rms_deg)},
          {"bias_deg", namedFigures(kClinicalAngleNames, angles.bias_deg)},
          {"by_confidence", by_confidence}};
}

Json report(const JointFigures& joints, const std::optional<PoseFigures>& poses, const EvaluationOptions& options) {
  Json json;
  json["frames"] = joints.frames;
  json["compared"] = joints.compared;
  json["mean_joint_error_m"] = figure(joints.mean_error_m);
  json["per_joint_error_m"] = namedFigures(kJointNames, joints.error_m);
  json["map_10cm"] = figure(joints.mean_hit_rate);
  json["pck_10cm"] = namedFigures(kJointNames, joints.hit_rate);
  json["mean_bone_direction_error_deg"] = figure(joints.mean_bone_direction_error_deg);
  json["mean_joint_angle_error_deg"] = poses ? figure(poses->mean_angle_error_deg) : Json(nullptr);
  json["per_dof_error_deg"] = poses ? namedFigures(kDofNames, poses->error_deg, kFirstRotationDof) : Json::object();
  json["jitter_m_s2"] = figure(joints.jitter_m_s2);
  json["lost_fraction"] = figure(joints.lost_fraction);
  json["truth_jitter_m_s2"] = figure(joints.truth_jitter_m_s2);
  json["root_relative"] = options.root_relative;
  if (poses) {
    json["poses_compared"] = poses->compared;
    json["mean_root_position_error_m"] = figure(poses->mean_root_position_error_m);
  }
  return json;
}

void evaluate(const EvaluateOptions& options) {
  const std::optional<PoseFigures> poses = poseFigures(options);
  const JointFigures joints =
      evaluateJoints(readJointsFile(options.joints, options.person),
                     readJointsFile(truthFile(options.truth, "joints.csv")), options.evaluation);
  Json json = report(joints, poses, options.evaluation);
  if (!options.angles.empty()) {
    json["clinical_angles"] = clinicalFigures(evaluateAngles(readAnglesFile(options.angles, options.person),
                                                             readPoseFile(truthPoseFile(options)), options.evaluation));
  }
  std::cout << json.dump(2) << '\n';
}

}  // namespace

void addEvaluateCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("evaluate", "Compares a tracked recording with the truth; prints JSON.");
  const auto options = std::make_shared<EvaluateOptions>();
  command->add_option("--joints", options->joints, "Joints file of the tracker")->required();
  command->add_option("--truth", options->truth, "Recording with truth/joints.csv, or a joints file")->required();
  command->add_option("--pose", options->pose, "Pose file of the tracker: adds joint angles");
  command->add_option("--truth-pose", options->truth_pose, "True pose file; otherwise the recording's truth/pose.csv");
  command->add_option("--angles", options->angles, "Angles file of the tracker: adds clinical angles")
      ->type_name("A.csv");
  command->add_option("--person", options->person, "Of several people tracked, which one to compare")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--first", options->evaluation.first, "First frame number to compare");
  command->add_option("--last", options->evaluation.last, "Last frame number to compare");
  command->add_flag("--root-relative", options->evaluation.root_relative,
                    "Compare positions relative to the pelvis, for a truth whose place in the room is not trusted");
  command->footer(
      "A truth frame without a tracked pose counts as lost and as a miss.\n"
      "Example:\n"
      "  depthmocap replay recordings/walk --joints joints.csv --pose pose.csv\n"
      "  depthmocap evaluate --joints joints.csv --pose pose.csv --truth recordings/walk");
  command->callback([options] {
    if (!options->truth_pose.empty() && options->pose.empty() && options->angles.empty()) {
      throw CLI::RequiredError("--truth-pose: --pose or --angles");
    }
    evaluate(*options);
  });
}

}  // namespace depthmocap
