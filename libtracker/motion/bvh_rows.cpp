#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "libtracker/core/check.h"
#include "libtracker/motion/bvh.h"

namespace depthmocap {
namespace {

using Eigen::Vector3d;

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kDegrees = 180.0 / std::numbers::pi;
// Width of the number of frames, the same for any number.
constexpr int kFramesWidth = 12;

Vector3d unwrapped(const Vector3d& angles, const Vector3d& near) {
  Vector3d result;
  for (int i = 0; i < 3; ++i) result[i] = angles[i] - kTwoPi * std::round((angles[i] - near[i]) / kTwoPi);
  return result;
}

// R = Rz(z) Ry(y) Rx(x): of the two solutions and their turns the one nearest to `near` (z, y, x).
Vector3d eulerZyx(const Eigen::Matrix3d& R, const Vector3d& near) {
  const double y = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
  Vector3d first(near[0], y, 0);
  if (std::abs(R(2, 0)) < 1.0 - 1e-9) {
    first[0] = std::atan2(R(1, 0), R(0, 0));
    first[2] = std::atan2(R(2, 1), R(2, 2));
  } else {
    // y = +-90 degrees: only one combination of z and x shows; z stays where it was.
    const Eigen::Matrix3d rest = Eigen::AngleAxisd(-near[0], Vector3d::UnitZ()).toRotationMatrix() * R;
    first[2] = std::atan2(-rest(1, 2), rest(1, 1));
  }
  const Vector3d second(first[0] + std::numbers::pi, std::numbers::pi - first[1], first[2] + std::numbers::pi);
  const Vector3d a = unwrapped(first, near);
  const Vector3d b = unwrapped(second, near);
  return (a - near).squaredNorm() <= (b - near).squaredNorm() ? a : b;
}

}  // namespace

BvhRows::BvhRows(std::filesystem::path path, std::vector<MotionBone> bones, double fps, double scale,
                 std::size_t moving_bones)
    : file_(path), bones_(std::move(bones)), fps_(fps), scale_(scale), moving_bones_(moving_bones) {
  DMC_CHECK(!bones_.empty() && bones_[0].parent < 0 && fps > 0 && scale > 0);
  angles_.assign(bones_.size(), Vector3d::Zero());
  bone(0, 0);
  DMC_CHECK(order_.size() == bones_.size());
}

void BvhRows::bone(std::size_t index, int depth) {
  order_.push_back(index);
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  const MotionBone& bone = bones_[index];
  const auto offset = [&](const Vector3d& v) {
    return fmt::format("OFFSET {:.6f} {:.6f} {:.6f}\n", scale_ * v.x(), scale_ * v.y(), scale_ * v.z());
  };
  hierarchy_ += fmt::format("{0}{1} {2}\n{0}{{\n{0}  {3}", indent, depth == 0 ? "ROOT" : "JOINT", bone.name,
                            offset(depth == 0 ? Vector3d::Zero() : bone.offset));
  hierarchy_ += fmt::format("{}  CHANNELS {} Zrotation Yrotation Xrotation\n", indent,
                            index < moving_bones_ ? "6 Xposition Yposition Zposition" : "3");
  bool has_child = false;
  for (std::size_t child = index + 1; child < bones_.size(); ++child) {
    if (bones_[child].parent != static_cast<int>(index)) continue;
    has_child = true;
    this->bone(child, depth + 1);
  }
  if (bone.has_tip || !has_child) {
    hierarchy_ += fmt::format("{0}  End Site\n{0}  {{\n{0}    {1}{0}  }}\n", indent, offset(bone.tip));
  }
  hierarchy_ += indent + "}\n";
}

void BvhRows::write(const std::vector<Vector3d>& positions, const std::vector<Eigen::Quaterniond>& rotations) {
  DMC_CHECK(rotations.size() == bones_.size());
  DMC_CHECK(positions.size() >= moving_bones_);
  std::string row;
  const auto add = [&](const Vector3d& v) {
    row += fmt::format("{}{:.6f} {:.6f} {:.6f}", row.empty() ? "" : " ", v.x(), v.y(), v.z());
  };
  for (const std::size_t b : order_) {
    if (b < moving_bones_) add(scale_ * positions[b]);
    angles_[b] = eulerZyx(rotations[b].toRotationMatrix(), angles_[b]);
    add(kDegrees * angles_[b]);
  }
  rows_ += row + '\n';
  ++frames_;
}

void BvhRows::finish() {
  file_.write("HIERARCHY\n");
  file_.write(hierarchy_);
  file_.write(fmt::format("MOTION\nFrames: {:>{}}\nFrame Time: {:.8f}\n", frames_, kFramesWidth, 1.0 / fps_));
  file_.write(rows_);
  file_.commit();
}

void writeBvh(const SourceMotion& motion, const std::filesystem::path& path, double scale) {
  BvhRows rows(path, motion.bones, motion.fps, scale);
  for (const MotionFrame& frame : motion.frames) rows.write(frame.position, frame.rotation);
  rows.finish();
}

}  // namespace depthmocap
