#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "depthmocap/depth_frame.h"
#include "libtracker/posedb/pose_search.h"
#include "libtracker/prior/local_prior_builder.h"
#include "libtracker/segment/segment.h"
#include "libtracker/tracker/dense_refinement.h"
#include "libtracker/tracker/evidence.h"
#include "libtracker/tracker/global_search.h"
#include "libtracker/tracker/hidden_legs.h"
#include "libtracker/tracker/hypothesis.h"
#include "libtracker/tracker/prediction.h"
#include "libtracker/tracker/tracker_config.h"
#include "libtracker/tracker/upright_world.h"

namespace depthmocap {

// From evidence to a pose: (3) nearest poses, (4) local model, (5) maximum a posteriori, and the dense term.
class PoseFitter {
 public:
  // Poses are searched for with this body's proportions, whatever size the actor has later.
  PoseFitter(std::shared_ptr<const PoseDatabase> database, const Actor& body, const TrackerConfig& config);

  // The image that the next evidence is of; depth and region must outlive the calls for this frame.
  void look(const DepthImage& depth, const PersonRegion& actor, const CameraModel& camera,
            const Eigen::Matrix3d& R_world_camera);
  // The next frame is the first one of another run.
  void forget() { dense_.forget(); }
  // What is known of legs that are not in view; before buildPrior() and the fits of this frame.
  void supposeLegs(const PersonRegion& actor, const UprightWorld& world) { legs_.look(actor.cut_below, world.floor()); }

  // (3) and (4) for fitNext(): the poses nearest to the markers and to the pose before, and the local model over them.
  void buildPrior(const Evidence& evidence, const Prediction& prediction, const Actor& actor);
  // (5) from the pose before. Where that fits the markers badly, a search over all poses competes with it; where it
  // leaves much of the image unexplained, what the pose before says without any markers. `contacts` may be null.
  // Whether the pose is to be believed is for the caller to ask.
  Hypothesis fitNext(const Evidence& evidence, const Prediction& prediction, const Actor& actor,
                     const FootContacts* contacts);
  // A pose from one image alone; a body whose size is being fitted takes it at once. None if no pose is believed.
  std::optional<Hypothesis> fitFirst(const Evidence& evidence, const BodyAdapter& body);

  // The fit of the seen markers is close enough to be a person, or the pose explains the image whatever they say.
  [[nodiscard]] bool believed(const Hypothesis& fit) const;
  // The pose leaves so much of the image unexplained that others should be tried,
  [[nodiscard]] bool isPuzzling(const Hypothesis& fit) const;
  // and this one explains enough more of it.
  [[nodiscard]] bool explainsMore(const Hypothesis& other, const Hypothesis& fit) const;
  // The energy without what the frames before say.
  [[nodiscard]] double energyOfImage(const MapSummary& fit) const;
  // How much larger the actor is than this body: by the height of a whole person who is upright, else by the markers
  // and by the assumed stature.
  ObservedSize observedSize(const Evidence& evidence, const Actor& actor, const Pose& q);
  // What the image says of the body's shape, by the last fit, whose pose `fit` is.
  ShapeEvidence observedShape(const Hypothesis& fit, const BodyAdapter& body);
  // Nothing hides or cuts off a part of the actor.
  [[nodiscard]] bool wholeInView() const { return whole_in_view_; }

 private:
  // (3) and (4) about these markers and the pose before.
  void buildPriorAbout(const MarkerSet& markers_world, const Prediction& prediction, const Actor& actor,
                       LocalPrior& prior);
  Hypothesis fitByParts(const Evidence& evidence, const Prediction& prediction, const Actor& actor,
                        const FootContacts* contacts);
  // From the pose before by distance alone, whatever parts the classifier sees: a limb that it takes for another one
  // stays what it was.
  Hypothesis fitByDistance(const Evidence& evidence, const Prediction& prediction, const Actor& actor);
  void finish(const Evidence& evidence, const Actor& actor, MapInput input, Hypothesis& fit);
  // Supposed markers say nothing about how well a pose fits: its summary is to speak of those that were seen.
  void judgeBySeen(const MarkerSet& seen_world, const Actor& actor, const Pose& q, MapSummary& summary);
  [[nodiscard]] double rmsOfSeen(const MarkerSet& seen_world, const Actor& actor, const Pose& q);  // [m]
  [[nodiscard]] double searchScale(const Actor& actor) const { return actor.stature_m() / search_stature_m_; }

  const TrackerConfig config_;
  const std::shared_ptr<const PoseDatabase> database_;
  const double search_stature_m_;  // of the body whose markers the search holds
  PoseSearch search_;
  LocalPriorBuilder prior_builder_;
  MapSolver solver_;
  GlobalSearch global_;
  DenseRefinement dense_;
  HiddenLegs legs_;
  std::vector<PoseNeighbour> neighbours_;
  LocalPrior prior_, prior_of_prediction_;
  bool whole_in_view_ = false;  // of the present image
  ForwardKinematics fk_;
};

}  // namespace depthmocap
