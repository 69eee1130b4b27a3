#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "depthmocap/body_shape.h"
#include "depthmocap/surface_model.h"
#include "libtracker/actor/template_surface.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/length_vector.h"

namespace depthmocap {

ShapeVector shapeVector(const BoneLengths& lengths, double girth);
BoneLengths boneLengths(const ShapeVector& shape);

using ShapeJacobian = Eigen::Matrix<double, 3, kShapeCount>;

// A sampled body as a surface that bone lengths and girths stretch: every point is rigid with a bone, and each of
// its three coordinates in the bone's frame is proportional to a ratio that is linear in the shape (the length of the
// bone along it, a girth across it).
class BodyTemplate {
 public:
  struct Point {
    Bone bone = Bone::Root;
    Part part = Part::None;
    Eigen::Vector3d p0 = Eigen::Vector3d::Zero();  // [m] in the bone's frame, of the template
    Eigen::Vector3d n0 = Eigen::Vector3d::Zero();  // unit, outwards
    std::array<std::uint8_t, 3> stretch{};         // which ratio stretches x, y, z
  };
  // Where the body ends: points of the surface.
  struct Ends {
    Point crown, left_tip, right_tip, left_sole, right_sole;
  };

  explicit BodyTemplate(const TemplateSurface& body);
  // The man or the woman that comes with the library.
  static const BodyTemplate& ofSex(Sex sex);
  // The average actor's.
  static const BodyTemplate& average();

  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  [[nodiscard]] const Ends& ends() const { return ends_; }
  // The shape of the template itself, and the girths that go with a stature [m].
  [[nodiscard]] const ShapeVector& templateShape() const { return shape_; }
  [[nodiscard]] double girthOf(double stature_m) const;

  // A point's place in its bone's frame [m], its unit normal, and d place / d shape.
  [[nodiscard]] Eigen::Vector3d place(const Point& point, const ShapeVector& shape) const;
  [[nodiscard]] Eigen::Vector3d normal(const Point& point, const ShapeVector& shape) const;
  [[nodiscard]] ShapeJacobian placeJacobian(const Point& point) const;
  // The same of a point of `part`, from its place on the surface of `shape`.
  [[nodiscard]] ShapeJacobian placeJacobian(const BonePoint& placed, Part part, const ShapeVector& shape) const;

  // The surface of a shaped body, for the dense term of tracking.
  [[nodiscard]] SurfaceModel surface(const ShapeVector& shape) const;

 private:
  static constexpr int kRatioCount = 9 + kGirthCount;
  [[nodiscard]] Point makePoint(Bone bone, Part part, const Eigen::Vector3d& p, const Eigen::Vector3d& n) const;
  void defineRatios();

  ShapeVector shape_;
  Eigen::Matrix<double, kRatioCount, kShapeCount> ratios_;
  std::vector<Point> points_;
  Ends ends_;
};

// d origin of each bone / d s for one pose, so that d p_world / d shape of any point is at hand. The skeleton's offsets
// are linear in s.
class ShapeKinematics {
 public:
  void update(const ForwardKinematics& fk);
  // Of a point rigid with a bone, whose place in the bone's frame changes by `place` [3 x shape].
  [[nodiscard]] ShapeJacobian jacobian(const ForwardKinematics& fk, Bone bone, const ShapeJacobian& place) const;

 private:
  std::array<Eigen::Matrix<double, 3, kBoneLengthCount>, kBoneCount> origin_;
};

// A linear function of the bone lengths by its values at the unit vectors: bone offsets, marker offsets, end points.
template <typename Function>
Eigen::Matrix<double, 3, kBoneLengthCount> linearInLengths(Function&& f) {
  Eigen::Matrix<double, 3, kBoneLengthCount> J;
  for (int k = 0; k < kBoneLengthCount; ++k) J.col(k) = f(boneLengths(LengthVector(LengthVector::Unit(k))));
  return J;
}

}  // namespace depthmocap
