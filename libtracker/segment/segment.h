#pragma once
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"
#include "depthmocap/joints.h"
#include "libtracker/core/config_fields.h"
#include "libtracker/core/room_map.h"

namespace depthmocap {

struct SegmentConfig {
  double min_depth_m = 0.4;        // [m] (>= 0) nearer measurements are dropped
  double max_depth_m = 6.0;        // [m] (> min_depth_m) farther ones too
  double floor_distance_m = 0.02;  // [m] (> 0) this near the floor plane is floor, beside what the sensor's noise needs
  double cluster_gap_m = 0.10;     // [m] (> 0) points farther apart belong to different clusters
  double min_height_m = 0.5;       // [m] (> 0) a person's cluster is at least this tall, unless cut by the image border
  double max_height_m = 2.4;       // [m] (> min_height_m)
  int min_pixels = 400;            // [px] (>= 1) at 320x240; scaled with the image
  int plane_interval = 30;         // [frames] (>= 1) the floor is looked for again after so many
  std::vector<ConfigField> fields();
  void validate() const;  // throws Error naming field, value and rule
};

// Where somebody is expected who is known from the frames before or was pointed at.
struct ExpectedActor {
  Eigen::Vector3d p_camera = Eigen::Vector3d::Zero();  // [m] middle of the trunk
  double unseen_s =
      0;  // [s] (>= 0) since the person was last seen; infinite: has not been seen, somebody near is meant
  std::optional<JointPositions> joints_camera = {};  // [m] of the pose that is expected; none: not known
};

// Who is expected in an image: one entry for each person that is followed, none for one who may be anybody.
using ExpectedPeople = std::vector<std::optional<ExpectedActor>>;
inline constexpr int kMostPeople = 6;

// Asks the room classifier about a picture of the camera. The answer is valid until the next question.
using RoomLook = std::function<const RoomMap&(const DepthImage& depth)>;

// One person's part of the image.
struct PersonRegion {
  MaskImage mask;       // 1 on the person; nobody = all 0
  int pixel_count = 0;  // [px] in the mask
  bool touches_border = false;
  bool in_room = false;  // the background is in the image, too
  bool covered = false;  // something nearer covers a part
  bool cut_below =
      false;  // the lower end is not in view: covered, beyond the picture, or not measured down to the floor
  double visible_share = 1;  // (0, 1] of what is usually in view; below 1 where something nearer covers a part
  Eigen::Vector3d centroid_camera = Eigen::Vector3d::Zero();  // [m]
};

// The people of one image and the floor they stand on.
struct Segmentation {
  std::vector<PersonRegion> people{1};          // one for each that is followed; a region of no pixels is nobody
  std::optional<Eigen::Vector4d> floor_camera;  // plane n.p + d = 0, |n| = 1, n away from the floor (up); if seen
  double floor_area_m2 = 0;                     // of it in view, when it was last looked for

  [[nodiscard]] PersonRegion& actor() { return people.front(); }
  [[nodiscard]] const PersonRegion& actor() const { return people.front(); }
};

// Finds people's pixels: those of one actor, or of several. A recording whose background is already removed is
// recognised (see mayBeCutOut); otherwise the floor (a RANSAC plane, PCL) and what does not look like people to the
// room classifier is removed. What is left is clustered, and clusters most like people are taken. From then on those
// are followed: who is who is carried from frame to frame, so that people who touch stay apart, and nobody else is
// taken while somebody is hidden; then somebody who appears where the hidden one is expected is taken for that one.
// Detached pieces that fit (a hand before the body, a leg behind an arm) join their person. The floor is kept from
// frame to frame: one object per recording, frames in order; the result depends on nothing else. The camera is upright
// within 30 degrees. Not thread-safe.
class Segmenter {
 public:
  // Throws Error for an invalid config.
  explicit Segmenter(const SegmentConfig& config);
  ~Segmenter();
  Segmenter(Segmenter&&) noexcept;
  Segmenter& operator=(Segmenter&&) noexcept;

  // `depth` has the camera's size; `look` says what the room classifier says of it, or of it
  // without its boards, and is not called where the background was removed a moment ago. `expected` (1 .. kMostPeople):
  // each is looked for, in this order; who may be anybody is taken from those who are left, the plainest first, and a
  // place whose person changes must be "anybody" in between: then who was there is forgotten. out.people has as many,
  // in the same order. Reuses the memory of `out`.
  void segment(const DepthImage& depth, const CameraModel& camera, const RoomLook& look, const ExpectedPeople& expected,
               Segmentation& out);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
