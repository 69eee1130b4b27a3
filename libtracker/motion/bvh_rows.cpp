#include <array>
#include <cmath>
#include <numbers>
#include <system_error>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"
#include "libtracker/motion/bvh.h"

namespace depthmocap {
namespace {

using Eigen::Vector3d;

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kDegrees = 180.0 / std::numbers::pi;
// Width of the number of frames, which is known only at the end and then written over the blanks.
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

BvhRows::BvhRows(std::filesystem::path path, std::vector<MotionBone> bones, double fps, double scale, bool moving_bones)
    : path_(std::move(path)), bones_(std::move(bones)), fps_(fps), scale_(scale), moving_bones_(moving_bones) {
  DMC_CHECK(!bones_.empty() && bones_[0].parent < 0 && fps > 0 && scale > 0);
  temporary_ = path_;
  temporary_ += ".part";
  out_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!out_) throw Error("cannot write the file", path_.string(), "does the folder exist, and may it be written to?");
  angles_.assign(bones_.size(), Vector3d::Zero());
  header();
}

BvhRows::~BvhRows() {
  if (finished_) return;
  out_.close();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void BvhRows::check() const {
  if (!out_) throw Error("writing failed", path_.string(), "is the disk full?");
}

void BvhRows::bone(std::size_t index, int depth) {
  order_.push_back(index);
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  const MotionBone& bone = bones_[index];
  const auto offset = [&](const Vector3d& v) {
    return fmt::format("OFFSET {:.6f} {:.6f} {:.6f}\n", scale_ * v.x(), scale_ * v.y(), scale_ * v.z());
  };
  out_ << indent << (depth == 0 ? "ROOT " : "JOINT ") << bone.name << '\n' << indent << "{\n";
  out_ << indent << "  " << offset(depth == 0 ? Vector3d::Zero() : bone.offset);
  out_ << indent << (depth == 0 || moving_bones_ ? "  CHANNELS 6 Xposition Yposition Zposition " : "  CHANNELS 3 ")
       << "Zrotation Yrotation Xrotation\n";
  bool has_child = false;
  for (std::size_t child = index + 1; child < bones_.size(); ++child) {
    if (bones_[child].parent != static_cast<int>(index)) continue;
    has_child = true;
    this->bone(child, depth + 1);
  }
  if (bone.has_tip || !has_child) {
    out_ << indent << "  End Site\n" << indent << "  {\n" << indent << "    " << offset(bone.tip) << indent << "  }\n";
  }
  out_ << indent << "}\n";
}

void BvhRows::header() {
  out_ << "HIERARCHY\n";
  bone(0, 0);
  DMC_CHECK(order_.size() == bones_.size());
  out_ << "MOTION\nFrames: ";
  frames_at_ = out_.tellp();
  out_ << std::string(kFramesWidth, ' ') << '\n' << fmt::format("Frame Time: {:.8f}\n", 1.0 / fps_);
  check();
}

void BvhRows::write(const std::vector<Vector3d>& positions, const std::vector<Eigen::Quaterniond>& rotations) {
  DMC_CHECK(rotations.size() == bones_.size() && !finished_);
  DMC_CHECK(positions.size() == bones_.size() || (positions.size() == 1 && !moving_bones_));
  std::string row;
  const auto add = [&](const Vector3d& v) {
    row += fmt::format("{}{:.6f} {:.6f} {:.6f}", row.empty() ? "" : " ", v.x(), v.y(), v.z());
  };
  for (const std::size_t b : order_) {
    if (b == 0 || moving_bones_) add(scale_ * positions[b]);
    angles_[b] = eulerZyx(rotations[b].toRotationMatrix(), angles_[b]);
    add(kDegrees * angles_[b]);
  }
  out_ << row << '\n';
  check();
  ++frames_;
}

void BvhRows::finish() {
  out_.seekp(frames_at_);
  out_ << fmt::format("{:>{}}", frames_, kFramesWidth);
  out_.close();
  check();
  std::error_code failure;
  std::filesystem::rename(temporary_, path_, failure);
  if (failure) throw Error("cannot write the file: " + failure.message(), path_.string());
  finished_ = true;
}

void writeBvh(const SourceMotion& motion, const std::filesystem::path& path, double scale) {
  BvhRows rows(path, motion.bones, motion.fps, scale);
  for (const MotionFrame& frame : motion.frames) rows.write(frame.position, frame.rotation);
  rows.finish();
}

}  // namespace depthmocap
