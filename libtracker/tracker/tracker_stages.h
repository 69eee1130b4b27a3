#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "libtracker/classify/classify.h"
#include "libtracker/markers/find_markers.h"
#include "libtracker/posedb/pose_search.h"
#include "libtracker/prior/local_prior_builder.h"
#include "libtracker/segment/segment.h"
#include "libtracker/tracker/dense_refinement.h"
#include "libtracker/tracker/foot_watch.h"
#include "libtracker/tracker/global_search.h"
#include "libtracker/tracker/size_adapter.h"
#include "libtracker/tracker/track_history.h"
#include "libtracker/tracker/tracker.h"
#include "libtracker/tracker/upright_world.h"

namespace depthmocap {

// The stages, their working memory and what is known from the frames before.
struct Tracker::Stages {
  Stages(std::shared_ptr<const TrackerModels> m, const CameraModel& c, const TrackerConfig& cfg,
         const std::optional<ActorModel>& given);

  void begin(const DepthFrame& frame, const KnownEvidence& given);
  void predict();
  void levelWorld();
  void labelPixels(const DepthImage& depth);
  void findMarkers(const MarkerSet* expected_camera);
  void buildPrior();
  void solve(const DepthImage& depth);
  struct FirstPose {
    Pose q;
    MapSummary summary;
    SizeAdapter size;
    Facing facing = Facing::Front;
    double cost = 0;  // against other facings' poses
  };
  bool solveFirst(const DepthImage& depth);
  void assume(Facing facing, const DepthImage& depth);
  std::optional<FirstPose> poseFromScratch();
  bool accept(const std::optional<FirstPose>& first);
  bool turnAround(const DepthImage& depth);
  std::optional<FirstPose> poseFromAnySide(const FacingShares& shares, const DepthImage& depth);
  bool solveNext(const DepthImage& depth);
  // Without what the frames before say.
  [[nodiscard]] double energyOfImage(const MapSummary& fit) const {
    return fit.energy - config.solve.lambda_smooth * fit.e_smooth - config.solve.lambda_contact * fit.e_contact;
  }
  void finish();
  [[nodiscard]] double searchScale() const { return statureOf(size.actor().skeleton.lengths) / search_stature_m; }
  [[nodiscard]] bool believed(const MapSummary& fit) const { return fit.rms_marker_m <= config.policy.max_rms_m; }
  void expectActor();
  double observedScale(const Pose& q);

  const std::shared_ptr<const TrackerModels> models;
  const CameraModel camera;
  const TrackerConfig config;
  UprightWorld world;
  const Eigen::Matrix3d& R_world_camera = world.R_world_camera();

  const SizeAdapter first_size;
  SizeAdapter size;
  const double search_stature_m;  // of the skeleton whose markers the search holds
  TrackHistory history;
  FootWatch feet;

  Segmenter segmenter;
  MarkerFinder finder;
  PoseSearch search;
  LocalPriorBuilder prior_builder;
  MapSolver solver;
  GlobalSearch global;
  DenseRefinement dense;

  std::optional<Eigen::Vector3d> wanted_camera;            // where to look for somebody, once
  Eigen::Vector3d trunk_camera = Eigen::Vector3d::Zero();  // where it was last expected

  // Of the present frame.
  KnownEvidence known;
  double dt_s = 0;
  bool predicted = false;
  Pose q_predicted = Pose::Zero();
  MarkerSet predicted_camera;
  JointPositions joints_predicted_camera;
  ClassifyConfig classify_config = config.classify;  // with what is known of the facing
  std::optional<ExpectedActor> expected_actor;
  Segmentation segmentation;
  ClassifyMemory classify_memory;
  ClassifiedPixels pixels;
  ClassifiedPixels pixels_before;
  int disputed_frames = 0;
  MarkerSet markers_world;
  std::vector<PoseNeighbour> neighbours;
  LocalPrior prior;
  MapSummary summary;
  ForwardKinematics fk;
  TrackedFrame out;
};

}  // namespace depthmocap
