#pragma once
#include <array>
#include <vector>

#include "depthmocap/camera_model.h"
#include "depthmocap/joints.h"
#include "libtracker/ik/pose_prior.h"
#include "libtracker/ik/pose_term.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {

enum class Projection { Orthographic, Pinhole };

// How places of the world (x right, y up, z towards the viewer) come into a picture. Orthographic is scaled
// orthographic as in MNN-IK: u = s x + u_0, v = s y + v_0, with the scale s of each pose unknown. Pinhole: the camera
// is the origin and looks along -z; v points down.
struct ImageProjection {
  Projection kind = Projection::Orthographic;
  CameraModel camera = {};  // Pinhole only
};

// Where some joints of one body are in a picture.
struct ImageTargets {
  struct Target {
    Joint joint = Joint::Pelvis;
    Eigen::Vector2d uv = Eigen::Vector2d::Zero();  // Pinhole: [px], v down; Orthographic: any unit, v up
    double weight = 1;                             // (> 0) of the distance
  };
  std::vector<Target> targets;
};

// Fewer do not determine where in the picture a body is and how large.
inline constexpr std::size_t kLeastImageTargets = 3;

// Distances in the picture as lengths at the body over `unit_m`, two rows a target. Orthographic has no depth: in its
// place root_tz is log(s / scale), so that a pose is 36 numbers in either case.
class ImageTerm final : public PoseTerm {
 public:
  // scale: (> 0) picture units in a metre at the body, roughly. The skeleton must outlive the term.
  ImageTerm(const Skeleton& skeleton, const ImageProjection& projection, ImageTargets targets, double scale,
            double unit_m = 1.0);

  [[nodiscard]] int rows() const override { return 2 * static_cast<int>(targets_.targets.size()); }
  void evaluate(const Pose& q, Eigen::Ref<Eigen::VectorXd> r, RowsJacobian* J) override;
  // Root mean square distance [m] at q, whatever the weights.
  [[nodiscard]] double rms(const Pose& q);

 private:
  using ImageJacobian = Eigen::Matrix<double, 2, kDofCount>;
  Eigen::Vector2d project(const BonePoint& point, const Pose& q, ImageJacobian* J) const;

  const Skeleton& skeleton_;
  std::array<BonePoint, kJointCount> points_;
  ImageProjection projection_;
  ImageTargets targets_;
  double scale_;
  double unit_m_;
  ForwardKinematics fk_;
};

// Poses to start from and the picture's scale at the body: of the shapes, turned to kHeadings directions, moved and
// scaled to the targets, the nearest of each direction.
struct ImageStarts {
  std::vector<Pose> poses;
  double scale = 1;
};
inline constexpr int kHeadings = 12;
ImageStarts imageStarts(const Skeleton& skeleton, const ImageProjection& projection, const ImageTargets& targets,
                        const std::vector<PoseShape>& shapes);

}  // namespace depthmocap
