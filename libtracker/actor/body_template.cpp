#include "libtracker/actor/body_template.h"

namespace depthmocap {
namespace {

using Eigen::Vector3d;

// The lengths that stretch the template; girths follow after them.
enum Ratio : int {
  kUpperArm,
  kLowerArm,
  kUpperLeg,
  kLowerLeg,
  kFoot,
  kShoulderWidth,
  kTorso,
  kUpperTorso,  // spine joint to neck
  kNeckToHead,
  kFirstGirth,
};

std::uint8_t girth(Girth g) {
  return static_cast<std::uint8_t>(kFirstGirth + static_cast<int>(g));
}

bool isLeftOrMiddle(Part part) {
  return mirrored(part) >= part;
}

// The two girths across a point's bone: towards the side and towards the front.
std::array<std::uint8_t, 2> girthsOf(Part part) {
  switch (isLeftOrMiddle(part) ? part : mirrored(part)) {
    case Part::Head:
      return {girth(Girth::Head), girth(Girth::Head)};
    case Part::Neck:
      return {girth(Girth::Neck), girth(Girth::Neck)};
    case Part::LeftShoulder:
      return {girth(Girth::Shoulder), girth(Girth::Shoulder)};
    case Part::LeftUpperArm:
      return {girth(Girth::UpperArm), girth(Girth::UpperArm)};
    case Part::LeftLowerArm:
      return {girth(Girth::LowerArm), girth(Girth::LowerArm)};
    case Part::LeftWaist:
      return {girth(Girth::WaistWidth), girth(Girth::WaistDepth)};
    case Part::LeftUpperLeg:
      return {girth(Girth::UpperLeg), girth(Girth::UpperLeg)};
    case Part::LeftLowerLeg:
      return {girth(Girth::LowerLeg), girth(Girth::LowerLeg)};
    default:
      return {girth(Girth::TorsoWidth), girth(Girth::TorsoDepth)};
  }
}

std::array<std::uint8_t, 3> stretchOf(Bone bone, Part part) {
  const auto [side, front] = girthsOf(part);
  switch (bone) {
    case Bone::RightHumerus:
    case Bone::LeftHumerus:
      return {kUpperArm, side, front};
    case Bone::RightRadius:
    case Bone::LeftRadius:
      return {kLowerArm, side, front};
    case Bone::RightClavicle:
    case Bone::LeftClavicle:
      return {kShoulderWidth, side, front};
    case Bone::RightFemur:
    case Bone::LeftFemur:
      return {side, kUpperLeg, front};
    case Bone::RightTibia:
    case Bone::LeftTibia:
      return {side, kLowerLeg, front};
    case Bone::RightFoot:
    case Bone::LeftFoot:
      return {side, kLowerLeg, kFoot};
    case Bone::Neck:
    case Bone::Head:
      return {side, kNeckToHead, front};
    case Bone::UpperBack:
      return {side, kUpperTorso, front};
    case Bone::Root:
      return {side, kTorso, front};
  }
  return {};
}

}  // namespace

ShapeVector shapeVector(const BoneLengths& lengths, double girth) {
  ShapeVector shape = ShapeVector::Constant(girth);
  shape.head<kBoneLengthCount>() = lengthVector(lengths);
  return shape;
}

BoneLengths boneLengths(const ShapeVector& shape) {
  return boneLengths(LengthVector(shape.head<kBoneLengthCount>()));
}

BodyTemplate::BodyTemplate(const TemplateSurface& body) : shape_(shapeVector(body.lengths, 1.0)) {
  defineRatios();
  for (int part = 0; part < kPartCount; ++part) {
    for (const SurfaceModel::Point& point : body.surface.parts[static_cast<std::size_t>(part)]) {
      points_.push_back(makePoint(point.bone, partAt(part), point.p_bone.cast<double>(), point.n_bone.cast<double>()));
    }
  }
  const auto end = [&](std::size_t i) {
    const TemplateSurface::End& given = body.ends[i];
    return makePoint(given.bone, given.part, given.p, given.n);
  };
  ends_ = {end(0), end(1), end(2), end(3), end(4)};
}

const BodyTemplate& BodyTemplate::ofSex(Sex sex) {
  static const BodyTemplate man(shippedBodies().man);
  static const BodyTemplate woman(shippedBodies().woman);
  return sex == Sex::Male ? man : woman;
}

const BodyTemplate& BodyTemplate::average() {
  static const BodyTemplate average(shippedBodies().average);
  return average;
}

BodyTemplate::Point BodyTemplate::makePoint(Bone bone, Part part, const Vector3d& p, const Vector3d& n) const {
  return {bone, part, p, n, stretchOf(bone, part)};
}

void BodyTemplate::defineRatios() {
  const BoneLengths l = boneLengths(shape_);
  ratios_.setZero();
  const auto set = [&](Ratio ratio, int index, double length) { ratios_(ratio, index) = 1.0 / length; };
  // Columns in the order of kBoneLengthFields.
  set(kUpperArm, 0, l.upper_arm);
  set(kLowerArm, 1, l.lower_arm);
  set(kUpperLeg, 2, l.upper_leg);
  set(kLowerLeg, 3, l.lower_leg);
  set(kFoot, 4, l.foot);
  set(kShoulderWidth, 5, l.shoulder_width);
  set(kTorso, 7, l.torso);
  set(kUpperTorso, 7, l.torso - l.spine);
  ratios_(kUpperTorso, 9) = -1.0 / (l.torso - l.spine);
  set(kNeckToHead, 8, l.neck_to_head);
  for (int g = 0; g < kGirthCount; ++g) ratios_(kFirstGirth + g, kBoneLengthCount + g) = 1.0;
}

double BodyTemplate::girthOf(double stature_m) const {
  return stature_m / statureOf(boneLengths(shape_));
}

Vector3d BodyTemplate::place(const Point& point, const ShapeVector& shape) const {
  Vector3d p;
  for (int i = 0; i < 3; ++i) p[i] = point.p0[i] * ratios_.row(point.stretch[static_cast<std::size_t>(i)]).dot(shape);
  return p;
}

Vector3d BodyTemplate::normal(const Point& point, const ShapeVector& shape) const {
  Vector3d n;
  for (int i = 0; i < 3; ++i) n[i] = point.n0[i] / ratios_.row(point.stretch[static_cast<std::size_t>(i)]).dot(shape);
  return n.normalized();
}

ShapeJacobian BodyTemplate::placeJacobian(const Point& point) const {
  ShapeJacobian J;
  for (int i = 0; i < 3; ++i) J.row(i) = point.p0[i] * ratios_.row(point.stretch[static_cast<std::size_t>(i)]);
  return J;
}

ShapeJacobian BodyTemplate::placeJacobian(const BonePoint& placed, Part part, const ShapeVector& shape) const {
  const std::array<std::uint8_t, 3> stretch = stretchOf(placed.bone, part);
  ShapeJacobian J;
  for (int i = 0; i < 3; ++i) {
    const auto ratio = ratios_.row(stretch[static_cast<std::size_t>(i)]);
    J.row(i) = placed.p_bone[i] / ratio.dot(shape) * ratio;
  }
  return J;
}

SurfaceModel BodyTemplate::surface(const ShapeVector& shape) const {
  SurfaceModel model;
  model.stature_m = statureOf(boneLengths(shape));
  for (const Point& point : points_) {
    model.parts[static_cast<std::size_t>(partIndex(point.part))].push_back(
        {point.bone, place(point, shape).cast<float>(), normal(point, shape).cast<float>()});
  }
  return model;
}

void ShapeKinematics::update(const ForwardKinematics& fk) {
  static const auto kOffsets = [] {
    std::array<Eigen::Matrix<double, 3, kBoneLengthCount>, kBoneCount> offsets;
    for (std::size_t b = 0; b < kBoneCount; ++b) {
      offsets[b] = linearInLengths([&](const BoneLengths& l) { return makeSkeleton(l).offset[b]; });
    }
    return offsets;
  }();
  origin_[0].setZero();
  for (std::size_t b = 1; b < kBoneCount; ++b) {
    const auto parent = static_cast<std::size_t>(kBoneParents[b]);
    origin_[b] = origin_[parent] + fk.R_world_bone(static_cast<Bone>(parent)) * kOffsets[b];
  }
}

ShapeJacobian ShapeKinematics::jacobian(const ForwardKinematics& fk, Bone bone, const ShapeJacobian& place) const {
  ShapeJacobian J = fk.R_world_bone(bone) * place;
  J.leftCols<kBoneLengthCount>() += origin_[static_cast<std::size_t>(bone)];
  return J;
}

}  // namespace depthmocap
