#include "calibration/calibrator.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "calibration/fit_limbs.h"
#include "calibration/pose_observation.h"
#include "calibration/tpose_prior.h"
#include "depthmocap/error.h"
#include "depthmocap/world_frame.h"
#include "libtracker/actor/make_actor.h"
#include "libtracker/classify/forest_classifier.h"
#include "libtracker/classify/forest_file.h"
#include "libtracker/classify/room_classifier.h"
#include "libtracker/core/check.h"
#include "libtracker/core/config_fields.h"
#include "libtracker/core/parallel.h"
#include "libtracker/core/shipped_files.h"
#include "libtracker/markers/find_markers.h"
#include "libtracker/segment/segment.h"
#include "libtracker/tracker/alignment.h"

namespace depthmocap {
namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).

// [markers] Least of the 15 that a good frame shows.
constexpr int kFewestParts = 13;
// Share of the plainest one's pixels: who has less does not count.
constexpr double kRivalShare = 0.35;
// Share of the frames with a T-pose: from here on two people are in view.
constexpr double kTwoPeopleShare = 0.3;
// [m] A second person is at least this tall.
constexpr double kMinRivalHeight_m = 1.0;
// [px] Least classified of an actor.
constexpr std::size_t kFewestPixels = 300;
// [px] Each kStride_px-th pixel is looked at in x and y, as by the tracker.
constexpr int kStride_px = 2;
// A larger relative difference from the given stature is the camera's: calibrations of bare rendered bodies are about 1
// % off at most (scripts/measure-calibration).
constexpr double kScaleTolerance = 0.02;
// Least confidence of a fit that is believed: good fits have 0.6 and more, rough old recordings 0.4.
constexpr double kLeastConfidence = 0.2;
// [frames] Fewest that a calibration without a T-pose needs.
constexpr std::size_t kFewestPoses = 4;
// [m] Stature of the average body that the T-pose forest was trained with.
constexpr double kAverageStature_m = 1.69;

const TPoseVerdict kTwoPeople{TPoseFault::TwoPeople, "two people are in view: only one may be", 0};
const TPoseVerdict kTwoTPoses{TPoseFault::TwoPeople, "two people stand in a T-pose: only one may", 0};

// A good frame, kept until the solve.
struct GoodFrame {
  DepthFrame frame;
  MaskImage mask;
  BodyOutline outline;
  std::vector<CloudPoint> cloud;  // T-pose forest
  MarkerSet markers_world;        // of the tracker's forest
  std::optional<Eigen::Vector4d> floor_world;
  double deviation = 0;  // [rad]
};

// The actor's pixels in the upright world [m].
std::vector<Eigen::Vector3f> actorPoints(const DepthImage& depth, const MaskImage& mask, const CameraModel& camera) {
  const Eigen::Matrix3d R_world_camera = uprightWorldFromCamera();
  std::vector<Eigen::Vector3f> points;
  for (int y = 0; y < depth.height; y += kStride_px) {
    for (int x = 0; x < depth.width; x += kStride_px) {
      const auto depth_m = static_cast<double>(depth.at(x, y));
      if (mask.at(x, y) == 0 || depth_m <= 0) continue;
      points.push_back((R_world_camera * camera.unproject(x, y, depth_m)).cast<float>());
    }
  }
  return points;
}

// Where the camera measures otherwise than the given stature by more than a calibration can be wrong, its scale is.
Actor withStature(const Actor& actor, double stature_m) {
  const double factor = stature_m / actor.stature_m();
  Actor result = scaledActor(actor, factor);
  if (std::abs(factor - 1.0) > kScaleTolerance) {
    ActorMeasurement measured = *result.measured;
    measured.depth_scale = factor;
    result.measured = std::make_shared<const ActorMeasurement>(std::move(measured));
  }
  return result;
}

}  // namespace

void CalibratorConfig::validate() const {
  check.validate();
  checkConfig(frames >= 1, "CalibratorConfig", "frames", frames, "at least 1");
  checkConfig(!stature_m || (*stature_m >= 1.0 && *stature_m <= 2.3), "CalibratorConfig", "stature_m",
              stature_m.value_or(0), "from 1.0 to 2.3");
  checkConfig(points_per_part >= 5, "CalibratorConfig", "points_per_part", points_per_part, "at least 5");
  checkConfig(threads >= 1, "CalibratorConfig", "threads", threads, "at least 1");
}

struct Calibrator::Impl {
  Impl(std::shared_ptr<const CalibratorModels> m, const CameraModel& c, const CalibratorConfig& cfg)
      : models(std::move(m)),
        camera(c),
        config(cfg),
        segmenter(SegmentConfig{}),
        finder(MarkerConfig{}),
        tpose_memory(models->tpose->newMemory()),
        general_memory(models->general->newMemory()) {
    classify_config.stride = kStride_px;
    classify_config.threads = config.threads;
  }

  TPoseVerdict judge(const DepthFrame& frame);
  void segment(const DepthImage& depth);
  void findPeople(const DepthImage& depth);
  TPoseVerdict chooseActor();
  void classifyScaled(const DepthImage& depth, const MaskImage& mask, double stature_m);
  MarkerSet findMarkers(double stature_m);
  void keep(GoodFrame good);
  [[nodiscard]] PoseObservation observationOf(const GoodFrame& good, const ShapeVector& shape) const;
  using Start = std::function<ShapeVector(const BodyTemplate&)>;
  Actor fit(const std::vector<const GoodFrame*>& frames, const std::vector<PoseObservation>& others);
  Actor fitBetterTemplate(const std::vector<const GoodFrame*>& frames, const std::vector<PoseObservation>& others,
                          const Start& start, const FittedLimbs* limbs, Pose& q);
  void refuseTwoPeople() const;
  [[noreturn]] void refuse() const;
  [[nodiscard]] Actor believed(const Actor& actor) const;

  const std::shared_ptr<const CalibratorModels> models;
  const CameraModel camera;
  const CalibratorConfig config;
  const Eigen::Matrix3d R_world_camera = uprightWorldFromCamera();
  ClassifyConfig classify_config;
  RoomClassifier::Memory room_memory;
  RoomMap map;
  Segmenter segmenter;
  MarkerFinder finder;

  Segmentation segmentation;
  struct Somebody {
    const PersonRegion* region;  // in `segmentation`
    BodyOutline outline;
  };
  std::vector<Somebody> people;        // of the frame, the plainest first
  const Somebody* standing = nullptr;  // of them; null: nobody stands in a T-pose
  bool had_company = false;            // in a good frame
  const std::unique_ptr<PartClassifier::Memory> tpose_memory;
  const std::unique_ptr<PartClassifier::Memory> general_memory;
  ClassifiedPixels pixels;
  DepthImage scaled_depth;
  std::vector<GoodFrame> good;
  int good_count = 0;
  int frame_count = 0;
  std::map<TPoseFault, std::pair<int, std::string>> faults;  // how often, and the last advice
  Shown shown;
};

TPoseVerdict Calibrator::Impl::judge(const DepthFrame& frame) {
  segment(frame.depth);
  findPeople(frame.depth);
  if (people.empty()) return {TPoseFault::Nobody, "nobody is in view", 0};
  if (config.any_pose) {
    ++good_count;
    return people.size() > 1 ? kTwoPeople : TPoseVerdict{TPoseFault::None, {}, 0};
  }
  TPoseVerdict verdict = chooseActor();
  if (!verdict.good()) return verdict;
  GoodFrame candidate;
  candidate.outline = standing->outline;
  candidate.mask = standing->region->mask;
  const double stature = candidate.outline.height();
  classifyScaled(frame.depth, candidate.mask, stature);
  candidate.cloud = cloudOf(pixels, camera);
  if (findMarkers(stature).seenCount() < kFewestParts) {
    return {TPoseFault::PartsMissing, "not all body parts are recognised: stand freely, away from furniture", 0};
  }
  models->general->classify(frame.depth, candidate.mask, camera, classify_config, *general_memory, pixels);
  candidate.markers_world = findMarkers(stature);
  candidate.frame = frame;
  candidate.deviation = verdict.deviation;
  if (segmentation.floor_camera) {
    Eigen::Vector4d floor = *segmentation.floor_camera;
    floor.head<3>() = R_world_camera * floor.head<3>();
    candidate.floor_world = floor;
  }
  had_company |= people.size() > 1;
  keep(std::move(candidate));
  return verdict;
}

// Whoever is there, the plainest first.
void Calibrator::Impl::segment(const DepthImage& depth) {
  const SegmentConfig range;
  const auto look = [&](const DepthImage& seen) -> const RoomMap& {
    models->room->classify(seen, camera, range.min_depth_m, range.max_depth_m, config.threads, room_memory, map);
    return map;
  };
  segmenter.segment(depth, camera, look, ExpectedPeople(kMostPeople), segmentation);
}

void Calibrator::Impl::findPeople(const DepthImage& depth) {
  people.clear();
  standing = nullptr;
  for (const PersonRegion& region : segmentation.people) {
    const std::vector<Eigen::Vector3f> points = actorPoints(depth, region.mask, camera);
    if (points.size() < kFewestPixels) continue;
    const BodyOutline outline = measureOutline(points);
    const bool is_first = people.empty();
    const bool is_large = !is_first && region.pixel_count >= kRivalShare * people.front().region->pixel_count;
    if (is_first || (is_large && outline.height() > kMinRivalHeight_m)) people.push_back({&region, outline});
  }
}

// The only one who stands in a T-pose; if nobody does, what the plainest one is to change.
TPoseVerdict Calibrator::Impl::chooseActor() {
  TPoseVerdict chosen;
  for (const Somebody& somebody : people) {
    const TPoseVerdict verdict = checkTPose(somebody.region->mask, somebody.outline, config.check);
    if (verdict.good() && standing != nullptr) return kTwoTPoses;
    if (verdict.good()) standing = &somebody;
    if (verdict.good() || &somebody == &people.front()) chosen = verdict;
  }
  return chosen;
}

// The parts of a T-pose. The forest knows small and tall people as exceptions, and draws their parts towards those of
// the average: so it is shown everybody at the average size, the whole scene scaled about the camera.
void Calibrator::Impl::classifyScaled(const DepthImage& depth, const MaskImage& mask, double stature_m) {
  const auto scale = static_cast<float>(kAverageStature_m / stature_m);
  scaled_depth = depth;
  for (float& value : scaled_depth.data) value *= scale;
  models->tpose->classify(scaled_depth, mask, camera, classify_config, *tpose_memory, pixels);
  for (auto& pixel : pixels.pixels) pixel.depth_m /= scale;
}

// Markers of the classified pixels.
MarkerSet Calibrator::Impl::findMarkers(double stature_m) {
  MarkerSet markers_camera;
  const auto radii = averagePartRadii(makeSkeleton(averageBoneLengths(stature_m)));
  finder.find(pixels, camera, radii, nullptr, markers_camera);
  return rotated(R_world_camera, markers_camera);
}

// Keeps the frames closest to a T-pose.
void Calibrator::Impl::keep(GoodFrame candidate) {
  ++good_count;
  good.push_back(std::move(candidate));
  if (static_cast<int>(good.size()) <= config.frames) return;
  good.erase(std::max_element(good.begin(), good.end(),
                              [](const auto& a, const auto& b) { return a.deviation < b.deviation; }));
}

PoseObservation Calibrator::Impl::observationOf(const GoodFrame& g, const ShapeVector& shape) const {
  PoseObservation observation;
  observation.cloud = thinned(g.cloud, config.points_per_part);
  observation.markers_world = g.markers_world;
  const Eigen::Vector3d left = (g.outline.left_hand - g.outline.right_hand).normalized();
  observation.boundaries = tposeBoundaries(g.cloud, left, Eigen::Vector3d::UnitY());
  observation.ends = tposeEnds(g.mask, camera, g.markers_world, g.floor_world ? &*g.floor_world : nullptr);
  setTPosePrior(boneLengths(shape), g.outline, observation);
  return observation;
}

Actor Calibrator::Impl::fit(const std::vector<const GoodFrame*>& frames, const std::vector<PoseObservation>& others) {
  const GoodFrame& first = *frames.front();
  std::vector<std::vector<CloudPoint>> clouds;
  clouds.reserve(frames.size());
  for (const GoodFrame* frame : frames) clouds.push_back(frame->cloud);
  shown.limbs = fitLimbs(clouds, first.outline);
  Pose q;
  const auto start = [&](const BodyTemplate& body) { return startShape(body, first.outline, shown.limbs); };
  Actor actor = fitBetterTemplate(frames, others, start, &shown.limbs, q);
  shown.frame = first.frame;
  shown.mask = first.mask;
  shown.q = q;
  return actor;
}

// The man's or the woman's body, whichever fits better; `q` is the pose of the first frame.
Actor Calibrator::Impl::fitBetterTemplate(const std::vector<const GoodFrame*>& frames,
                                          const std::vector<PoseObservation>& others, const Start& start,
                                          const FittedLimbs* limbs, Pose& q) {
  const std::array<const BodyTemplate*, 2> templates = {&BodyTemplate::ofSex(Sex::Male),
                                                        &BodyTemplate::ofSex(Sex::Female)};
  std::array<JointSolution, 2> solutions;
  parallelFor(config.threads, templates.size(), [&](std::size_t i) {
    const ShapeVector shape = start(*templates[i]);
    std::vector<PoseObservation> observations;
    for (const GoodFrame* frame : frames) {
      observations.push_back(observationOf(*frame, shape));
      observations.back().weight = 1.0 / static_cast<double>(frames.size());
    }
    observations.insert(observations.end(), others.begin(), others.end());
    solutions[i] = solveJointly(*templates[i], models->space, observations, shape, config.solve);
  });
  const std::size_t best = solutions[1].cost < solutions[0].cost ? 1 : 0;
  const JointSolution& solution = solutions[best];
  ActorMeasurement measured;
  measured.sex = best == 0 ? Sex::Male : Sex::Female;
  measured.shape = solution.shape;
  measured.fit.tpose_frames = static_cast<int>(frames.size());
  measured.fit.other_frames = static_cast<int>(others.size());
  measured.fit.surface_m = solution.rms_surface_m;
  measured.fit.marker_m = solution.rms_marker_m;
  measured.fit.confidence = fitConfidence(solution);
  if (limbs != nullptr) setRadii(*limbs, measured);
  Actor actor = measuredActor(measured);
  actor.markers = solution.markers;
  q = solution.poses.front();
  return actor;
}

void Calibrator::Impl::refuseTwoPeople() const {
  const auto two = faults.find(TPoseFault::TwoPeople);
  if (two == faults.end() || two->second.first <= kTwoPeopleShare * (two->second.first + good_count)) return;
  throw Error(config.any_pose ? "two people are in view" : "two people stand in a T-pose", "calibration",
              "let only the actor stand before the camera");
}

// The actor, scaled to the stature that is given; throws where the fit says that it is none.
Actor Calibrator::Impl::believed(const Actor& actor) const {
  if (actor.measured->fit.confidence < kLeastConfidence) {
    throw Error(
        fmt::format("the body that fits best lies {:.0f} mm off the depth points: this is no T-pose, or no bare "
                    "view of a person",
                    1000 * actor.measured->fit.surface_m),
        "calibration", "record again, without long coats and away from furniture");
  }
  if (actor.stature_m() < config.check.min_stature_m || actor.stature_m() > config.check.max_stature_m) {
    throw Error(fmt::format("what is in view is {:.2f} m tall: no adult's size", actor.stature_m()), "calibration",
                "let only the actor stand before the camera");
  }
  return config.stature_m ? withStature(actor, *config.stature_m) : actor;
}

void Calibrator::Impl::refuse() const {
  const char* advice = "stand alone, whole in view and facing the camera, both arms stretched out level to the sides";
  if (frame_count < config.frames) {
    throw Error(
        fmt::format("{} frames are too few for a calibration, which needs {} good ones", frame_count, config.frames),
        "calibration", "record at least one second of T-pose");
  }
  const auto worst = std::max_element(faults.begin(), faults.end(),
                                      [](const auto& a, const auto& b) { return a.second.first < b.second.first; });
  std::string why;
  if (worst != faults.end()) {
    why = fmt::format("; most often ({} of {}): {}", worst->second.first, frame_count, worst->second.second);
  }
  throw Error(fmt::format("only {} of the {} frames needed show a T-pose{}", good_count, config.frames, why),
              "calibration", advice);
}

std::shared_ptr<const CalibratorModels> loadCalibratorModels(const Models& tracking,
                                                             const std::filesystem::path& shape_space) {
  const auto models = std::make_shared<CalibratorModels>();
  models->tpose = std::make_shared<const ForestClassifier>(loadForest(shippedFile("tpose.forest")));
  models->general = tracking.classifier;
  models->room = tracking.room;
  models->space = loadShapeSpace(shape_space.empty() ? shippedFile("shape_space.json") : shape_space);
  return models;
}

Calibrator::Calibrator(std::shared_ptr<const CalibratorModels> models, const CameraModel& camera,
                       const CalibratorConfig& config) {
  config.validate();
  impl_ = std::make_unique<Impl>(std::move(models), camera, config);
}

Calibrator::~Calibrator() = default;

TPoseVerdict Calibrator::add(const DepthFrame& frame) {
  ++impl_->frame_count;
  TPoseVerdict verdict = impl_->judge(frame);
  if (!verdict.good()) {
    auto& [count, advice] = impl_->faults[verdict.fault];
    ++count;
    advice = verdict.advice;
  }
  return verdict;
}

int Calibrator::goodFrames() const {
  return impl_->good_count;
}

bool Calibrator::enough() const {
  return impl_->good_count >= impl_->config.frames;
}

bool Calibrator::hadCompany() const {
  return impl_->had_company;
}

Actor Calibrator::solve(const std::vector<PoseObservation>& others) {
  Impl& s = *impl_;
  s.refuseTwoPeople();
  if (!enough()) s.refuse();
  std::vector<const GoodFrame*> frames;
  for (const GoodFrame& frame : s.good) frames.push_back(&frame);
  return s.believed(s.fit(frames, others));
}

Actor Calibrator::solveWithoutTPose(const std::vector<PoseObservation>& others, double stature_m) {
  Impl& s = *impl_;
  s.refuseTwoPeople();
  if (!enough()) s.refuse();
  if (others.size() < kFewestPoses) {
    throw Error(fmt::format("only {} frames show clearly different poses, and without a T-pose {} are needed",
                            others.size(), kFewestPoses),
                "calibration", "move arms and legs in view of the camera, or stand in a T-pose");
  }
  const auto start = [&](const BodyTemplate& body) {
    const BoneLengths lengths = boneLengths(body.templateShape());
    return shapeVector(lengths.scaled(stature_m / statureOf(lengths)), body.girthOf(stature_m));
  };
  Pose q;
  return s.believed(s.fitBetterTemplate({}, others, start, nullptr, q));
}

const Calibrator::Shown& Calibrator::shown() const {
  return impl_->shown;
}

}  // namespace depthmocap
