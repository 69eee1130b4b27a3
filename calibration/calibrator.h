#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration/joint_solve.h"
#include "calibration/limb_shapes.h"
#include "calibration/shape_space.h"
#include "calibration/tpose_check.h"
#include "depthmocap/actor.h"
#include "depthmocap/depth_frame.h"
#include "depthmocap/models.h"
#include "libtracker/classify/part_classifier.h"
#include "libtracker/classify/room_classifier.h"

namespace depthmocap {

struct CalibratorConfig {
  int frames = 10;  // (>= 1) good frames that a calibration needs and uses
  TPoseCheckConfig check;
  JointSolveConfig solve;
  std::optional<double> stature_m;  // [m] (1.0 .. 2.3) known: fixes the scale
  int points_per_part = 30;         // (>= 5) of the cloud of one frame
  int threads = 2;                  // (>= 1)
  bool any_pose = false;            // no T-pose is asked for: solveWithoutTPose() will measure
  void validate() const;            // throws Error naming field, value and rule
};

struct CalibratorModels {
  std::shared_ptr<const PartClassifier> tpose;    // knows the parts of a T-pose
  std::shared_ptr<const PartClassifier> general;  // the tracker's: markers are calibrated as the tracker will see them
  std::shared_ptr<const RoomClassifier> room;     // the tracker's
  ShapeSpace space;
};

// The T-pose forest and the shape space that come with the library (`shape_space` empty), and the tracker's classifier.
// Throws Error where a file is missing or damaged.
std::shared_ptr<const CalibratorModels> loadCalibratorModels(const Models& tracking,
                                                             const std::filesystem::path& shape_space = {});

// The shapes fitted to the first good frame; what a preview shows.
struct FittedLimbs {
  std::array<std::optional<Cylinder>, kPartCount> cylinders;  // of upper and lower arms and legs
  std::optional<EllipticCylinder> torso;
};

// Collects the T-pose frames of a stream, whoever else is in view; tells the actor what to change, and fits the body to
// the best of them (method section A (6)). Not thread-safe; deterministic for any number of threads.
class Calibrator {
 public:
  // Throws Error for an invalid config.
  Calibrator(std::shared_ptr<const CalibratorModels> models, const CameraModel& camera, const CalibratorConfig& config);
  ~Calibrator();

  // Judges the next frame and keeps it if it is a good one.
  TPoseVerdict add(const DepthFrame& frame);
  [[nodiscard]] int goodFrames() const;
  [[nodiscard]] bool enough() const;
  // Somebody else was in view in a good frame: which one a tracker follows in others is not sure.
  [[nodiscard]] bool hadCompany() const;

  // The body by the frames so far. Throws Error saying why the recording does not do and what to change: too few good
  // frames (with the most frequent fault), two in a T-pose, no body that fits. `others`: frames in other poses
  // (PoseCollector), which are solved for together with the T-pose.
  Actor solve(const std::vector<PoseObservation>& others = {});

  // Where there is no T-pose (config.any_pose): the body by frames in other poses alone, less surely. `stature_m` [m]:
  // what the tracker that gave the poses took it for. Throws Error as solve() does.
  Actor solveWithoutTPose(const std::vector<PoseObservation>& others, double stature_m);

  // Of the last solve(): the frame that a preview shows, its mask, the limbs and the pose.
  struct Shown {
    DepthFrame frame;
    MaskImage mask;
    FittedLimbs limbs;
    Pose q;
  };
  [[nodiscard]] const Shown& shown() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
