#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/learn/other_option.h"
#include "apps/program/learning.h"
#include "apps/terminal/motion_options.h"
#include "apps/terminal/progress.h"
#include "apps/terminal/stop_request.h"
#include "depthmocap/error.h"
#include "forest/render/synthesize.h"
#include "libtracker/body/builtin_body.h"
#include "libtracker/body/clothing.h"
#include "libtracker/body/makehuman_model.h"
#include "libtracker/choreography/procedural_motions.h"
#include "libtracker/motion/motion_files.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::string_view kProcedural = "procedural:";
constexpr std::string_view kMakeHuman = "makehuman:";
// Of the average adult: where --height or --weight is not given.
constexpr double kManStature_m = 1.75;
constexpr double kWomanStature_m = 1.62;

struct SynthesizeOptions {
  std::string motion;
  LoadOptions load;
  fs::path out;
  std::optional<double> height_m;
  std::optional<double> weight_kg;
  std::string sex = "m";
  std::string body = "builtin";
  std::string clothes = "none";
  std::string camera = "kinect1";
  std::string size;
  std::string noise = "on";
  std::string scene = "none";
  double yaw_deg = 0;
  double distance_m = StagingConfig{}.distance_m;
  double camera_height_m = StagingConfig{}.camera_height_m;
  double tilt_deg = 0;
  std::vector<std::string> others;
  std::int64_t first = 0;
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  std::uint64_t seed = 1;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

MotionClip readMotion(const std::string& motion, const SynthesizeOptions& o) {
  if (motion.starts_with(kProcedural)) return proceduralMotion(motion.substr(kProcedural.size()), o.seed);
  RetargetResult result = retargetMotionFile(motion, o.load);
  printMotionWarnings(motion, result.warnings);
  return std::move(result.clip);
}

// Frames first..last, both included.
void cutMotion(MotionClip& clip, std::int64_t first, std::int64_t last) {
  const auto count = static_cast<std::int64_t>(clip.poses.size());
  const std::int64_t end = std::min(last, count - 1) + 1;
  if (first >= end) {
    throw Error(fmt::format("no frame between --first {} and --last {}", first, last), "motion " + clip.name,
                fmt::format("it has frames 0 to {}", count - 1));
  }
  clip.poses.assign(clip.poses.begin() + first, clip.poses.begin() + end);
}

BodyShape shapeOf(const SynthesizeOptions& o) {
  BodyShape shape;
  shape.sex = o.sex == "f" ? Sex::Female : Sex::Male;
  shape.stature_m = o.height_m.value_or(o.sex == "f" ? kWomanStature_m : kManStature_m);
  shape.weight_kg = o.weight_kg.value_or(kAverageBodyMassIndex * shape.stature_m * shape.stature_m);
  return shape;
}

double weightOf(const BodySurface& body) {
  constexpr double kLitres = 1000.0;
  return enclosedVolume(body.vertices, body.triangles) * kLitres * kBodyDensityKgPerLitre;
}

// MakeHuman's weight is a macro between 0 and 1: the one whose volume weighs what is asked for, or the nearest limit.
BodySurface makeHumanBody(const fs::path& folder, const BodyShape& wanted) {
  constexpr int kBisections = 8;
  const MakeHumanModel model(folder);
  MakeHumanShape shape;
  shape.male = wanted.sex == Sex::Male ? 1.0 : 0.0;
  shape.stature_m = wanted.stature_m;
  double low = 0;
  double high = 1;
  for (int i = 0; i < kBisections; ++i) {
    shape.weight = 0.5 * (low + high);
    (weightOf(model.make(shape)) < wanted.weight_kg ? low : high) = shape.weight;
  }
  return model.make(shape);
}

BodySurface makeBody(const SynthesizeOptions& o) {
  BodySurface body = o.body.starts_with(kMakeHuman) ? makeHumanBody(o.body.substr(kMakeHuman.size()), shapeOf(o))
                                                    : makeBuiltinBody(shapeOf(o));
  if (o.clothes == "random") {
    Random random(o.seed);
    dress(body, sampleClothing(random));
  }
  return body;
}

CameraModel cameraOf(const SynthesizeOptions& o, SensorKind sensor) {
  const CameraModel whole = sensorCamera(sensor);
  const CameraModel half = sensorCamera(sensor, true);
  const auto sizeOf = [](const CameraModel& camera) { return fmt::format("{}x{}", camera.width, camera.height); };
  if (o.size.empty() || o.size == sizeOf(whole)) return whole;
  // Kinect v2 has no such mode; a half-size image of the others is what decimating programs make.
  if (o.size == sizeOf(half) && sensor != SensorKind::Kinect2) return half;
  throw CLI::ValidationError(
      "--size",
      fmt::format("{} delivers {}, not {}", o.camera,
                  sensor == SensorKind::Kinect2 ? sizeOf(whole) : fmt::format("{} or {}", sizeOf(whole), sizeOf(half)),
                  o.size));
}

SynthesisConfig configOf(const SynthesizeOptions& o) {
  SynthesisConfig config;
  config.sensor = *sensorNamed(o.camera);
  config.camera = cameraOf(o, config.sensor);
  config.noise = o.noise == "on";
  config.scene = *sceneNamed(o.scene);
  config.staging.yaw = o.yaw_deg * kDegree;
  config.staging.distance_m = o.distance_m;
  config.staging.half_view = 0.5 * config.camera.width / config.camera.fx;
  config.staging.max_distance_m = namedCamera(config.sensor).reach_m;
  config.staging.camera_height_m = o.camera_height_m;
  config.camera_tilt = o.tilt_deg * kDegree;
  config.seed = o.seed;
  config.threads = o.threads;
  return config;
}

// In the scene `bystander` somebody keeps clear of the actor, whose body and motion are the seed's.
OtherPerson bystanderOf(const SynthesizeOptions& o, const SynthesisConfig& config) {
  constexpr double kApart_m = 0.65;
  constexpr std::array<std::string_view, 4> kMotions = {"talk", "idle", "walk", "sit_and_talk"};
  Random random(o.seed, 1);
  BodyShape shape;
  shape.sex = random.uniform() < 0.5 ? Sex::Female : Sex::Male;
  shape.stature_m = random.uniform(1.5, 1.9);
  shape.weight_kg = random.uniform(19, 29) * shape.stature_m * shape.stature_m;
  const std::string motion = std::string(kProcedural) + std::string(kMotions[random.below(kMotions.size())]);
  OtherPerson bystander{readMotion(motion, o), makeBuiltinBody(shape), config.staging};
  bystander.staging.yaw = random.uniform(-1.5, 1.5);
  bystander.staging.distance_m = std::max(1.0, o.distance_m + random.uniform(-0.4, 0.8));
  bystander.apart_m = kApart_m;
  return bystander;
}

std::vector<OtherPerson> othersOf(const SynthesizeOptions& o, const SynthesisConfig& config) {
  std::vector<OtherPerson> others;
  for (const std::string& text : o.others) {
    const OtherOption option = parseOther(text);
    // The whole of the own path is walked, also where that leads out of the view.
    constexpr double kEverywhere = 100.0;
    OtherPerson other{readMotion(option.motion, o), makeBuiltinBody(option.shape), config.staging};
    cutMotion(other.clip, option.first, std::numeric_limits<std::int64_t>::max());
    other.staging.yaw = option.yaw_deg * kDegree;
    other.staging.distance_m = option.distance_m;
    other.staging.half_view = kEverywhere;
    other.aside_m = option.aside_m;
    others.push_back(std::move(other));
  }
  if (others.empty() && config.scene == SceneKind::Bystander) others.push_back(bystanderOf(o, config));
  return others;
}

std::string noteOf(const SynthesizeOptions& o, const MotionClip& clip) {
  const BodyShape shape = shapeOf(o);
  return fmt::format("synthetic: motion {}, {} of {:.2f} m and {:.0f} kg, camera {:.2f} m above the floor, noise {}",
                     clip.name, o.sex == "f" ? "a woman" : "a man", shape.stature_m, shape.weight_kg, o.camera_height_m,
                     o.noise);
}

void synthesize(const SynthesizeOptions& o) {
  SynthesisConfig config = configOf(o);
  MotionClip clip = readMotion(o.motion, o);
  cutMotion(clip, o.first, o.last);
  config.note = noteOf(o, clip);
  const BodySurface body = makeBody(o);
  config.others = othersOf(o, config);
  {
    const StopRequest on_ctrl_c;
    Progress progress("rendering", clip.poses.size());
    synthesizeRecording(clip, body, config, o.out, [&](std::size_t done) {
      if (StopRequest::made()) throw Error("stopped before the end; nothing was written", o.out.string());
      progress.update(done);
    });
  }
  std::cerr << "rendered " << clip.poses.size() << " frames to " << o.out.string() << '\n';
}

void addBodyOptions(CLI::App& command, SynthesizeOptions& o) {
  command.add_option("--height", o.height_m, "Stature of the actor [m] (default: 1.75, a woman 1.62)")
      ->check(CLI::Range(1.0, 2.2));
  command.add_option("--weight", o.weight_kg, "Weight of the actor [kg] (default: average for the stature)")
      ->check(CLI::Range(10.0, 160.0));
  command.add_option("--sex", o.sex, "Sex of the actor")->check(CLI::IsMember({"m", "f"}))->capture_default_str();
  command.add_option("--body", o.body, "builtin, or makehuman:DIR with MakeHuman's base mesh and targets")
      ->check([](const std::string& body) {
        return body == "builtin" || body.starts_with(kMakeHuman) ? "" : "must be builtin or makehuman:DIR";
      })
      ->capture_default_str();
  command.add_option("--clothes", o.clothes, "none, or random: everyday clothes and hair drawn from the seed")
      ->check(CLI::IsMember({"none", "random"}))
      ->capture_default_str();
}

std::vector<std::string> cameraNames() {
  std::vector<std::string> names;
  for (const NamedCamera& camera : namedCameras()) names.emplace_back(camera.name);
  return names;
}

void addViewOptions(CLI::App& command, SynthesizeOptions& o) {
  command.add_option("--camera", o.camera, "Sensor")->check(CLI::IsMember(cameraNames()))->capture_default_str();
  command.add_option("--size", o.size, "Image size: the camera's own, or half of it in both directions (not kinect2)")
      ->type_name("WxH");
  command.add_option("--noise", o.noise, "Noise of the sensor")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  command
      .add_option("--scene", o.scene,
                  "What stands around the actor: nothing, a few boxes (room), or a furnished room (the others)")
      ->check(CLI::IsMember(std::vector<std::string>(kSceneNames.begin(), kSceneNames.end())))
      ->capture_default_str();
  command.add_option("--yaw", o.yaw_deg, "Heading in the first frame [deg]; 0 faces the camera, 90 to its right")
      ->capture_default_str();
  command
      .add_option("--distance", o.distance_m,
                  "Camera to the middle of the path [m]; a long path is moved back and shortened into view")
      ->check(CLI::Range(0.3, 10.0))
      ->capture_default_str();
  command.add_option("--camera-height", o.camera_height_m, "Camera above the floor [m]")
      ->check(CLI::Range(0.1, 5.0))
      ->capture_default_str();
  command.add_option("--tilt", o.tilt_deg, "How far the camera looks down [deg]")
      ->check(CLI::Range(-45.0, 45.0))
      ->capture_default_str();
}

void addOthersOption(CLI::App& command, SynthesizeOptions& o) {
  command
      .add_option(
          "--other", o.others,
          "Somebody else in the view, up to five times: MOTION[,KEY=VALUE...] with distance and aside [m], yaw [deg], "
          "height [m], weight [kg], sex (m or f), first (frame)")
      ->type_name("OTHER")
      ->allow_extra_args(false)
      ->check([](const std::string& text) {
        try {
          (void)parseOther(text);
          return std::string();
        } catch (const Error& error) {
          return std::string(error.what());
        }
      })
      ->expected(1, static_cast<int>(kMostOthers));
}

// Ends the command line there and then, as --help does: --motion and --out are not needed.
void listMotions() {
  for (const std::string& name : proceduralMotionNames()) std::cout << kProcedural << name << '\n';
  throw CLI::Success();
}

}  // namespace

void addSynthesizeCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(kSynthesizeCommand.name, kSynthesizeCommand.help);
  const auto options = std::make_shared<SynthesizeOptions>();
  SynthesizeOptions& o = *options;
  command->add_option("--motion", o.motion, "AMC or BVH file, or procedural:NAME for one of the program's own")
      ->type_name("FILE")
      ->required();
  command->add_flag_callback("--list-motions", listMotions, "Prints the program's own motions, one a line");
  addMotionOptions(*command, o.load);
  command->add_option("--out", o.out, "Folder to write")->type_name("REC")->required();
  addBodyOptions(*command, o);
  addViewOptions(*command, o);
  addOthersOption(*command, o);
  command->add_option("--first", o.first, "First frame of the motion, from 0")->check(CLI::NonNegativeNumber);
  command->add_option("--last", o.last, "Last frame of the motion")->check(CLI::NonNegativeNumber);
  command->add_option("--seed", o.seed, "Seed of noise, room, clothes and procedural motion")->capture_default_str();
  command->add_option("--threads", o.threads, "Threads; the result does not depend on it")->check(CLI::Range(1, 256));
  command->footer(
      "Example:\n"
      "  depthmocap synthesize --motion procedural:walk --sex f --height 1.65 --out walk\n"
      "  depthmocap synthesize --motion 16.amc --asf 16.asf --camera kinect2 --scene room --yaw 30 --out room");
  command->callback([options] { synthesize(*options); });
}

}  // namespace depthmocap
