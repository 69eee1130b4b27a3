#pragma once
#include <optional>

#include "libtracker/tracker/body_adapter.h"
#include "libtracker/tracker/foot_watch.h"
#include "libtracker/tracker/hypothesis.h"
#include "libtracker/tracker/prediction.h"
#include "libtracker/tracker/track_history.h"
#include "libtracker/tracker/tracker_config.h"

namespace depthmocap {

// State of one actor between frames: poses, size, feet, where to look next.
class TrackMemory {
 public:
  // No actor given: an average body whose size is fitted.
  TrackMemory(const TrackPolicy& policy, const std::optional<Actor>& given);

  // What to expect of the frame at `time_s`. A lost actor is waited for; then the next one may be anybody, of any size.
  Prediction predict(double time_s, const Eigen::Matrix3d& R_world_camera);
  // A pose that is believed.
  void accept(const Hypothesis& pose, const Prediction& prediction, const std::optional<Eigen::Vector4d>& floor_world);
  // No pose in this frame.
  void miss(const Prediction& prediction);
  // The camera was turned: p_new = R_new_before * p_before.
  void turnWorld(const Eigen::Matrix3d& R_new_before);
  // Counts the frames in which the image gives the tracked side less than `share`; true when it is time to try the
  // other sides.
  bool dispute(float share);
  // Whether it is time to try poses from the image alone: the tracked one keeps leaving much of it unexplained.
  bool puzzled(bool much);

  // Forgets the actor; the next one is the person nearest to `wanted_camera` [m], or anybody.
  void forget(const std::optional<Eigen::Vector3d>& wanted_camera);
  // The same actor has been measured: tracking goes on with this body, whose size is fixed.
  void use(const Actor& actor);
  // From the next forget() on the body that was fitted last is the actor's, fixed, if enough was seen of it.
  void keepBody();

  [[nodiscard]] const BodyAdapter& body() const { return body_; }
  [[nodiscard]] const Actor& actor() const { return body_.actor(); }
  [[nodiscard]] TrackState state() const { return history_.state(); }
  [[nodiscard]] const Pose& pose() const { return history_.prev(); }  // the last one; undefined when lost
  [[nodiscard]] const FootContacts& contacts() const { return feet_.contacts(); }

 private:
  std::optional<ExpectedActor> expectedActor(double time_s, const Eigen::Matrix3d& R_world_camera);

  TrackPolicy policy_;
  BodyAdapter first_body_;
  BodyAdapter body_;
  std::optional<BodyAdapter> fitted_body_;  // of the one who was tracked before
  TrackHistory history_;
  FootWatch feet_;
  std::optional<Eigen::Vector3d> wanted_camera_;            // [m] where to look for somebody, once
  Eigen::Vector3d trunk_camera_ = Eigen::Vector3d::Zero();  // [m] where it was last expected
  double time_s_ = 0;                                       // of the frame before
  int disputed_frames_ = 0;
  int puzzled_frames_ = 0;
  ForwardKinematics fk_;
};

}  // namespace depthmocap
