#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "libtracker/core/atomic_file.h"
#include "libtracker/motion/asf_amc.h"

namespace depthmocap {
namespace {

using Eigen::Vector3d;

constexpr double kUnitsPerMetre = 0.45 / 0.0254;
constexpr double kShortest = 1e-9;  // [m] below this a bone has no length
constexpr double kDegrees = 180.0 / std::numbers::pi;

std::string boneText(int id, const std::string& name, const Vector3d& bone, const char* dof) {
  const double length = bone.norm();
  const Vector3d direction = length > kShortest ? Vector3d(bone / length) : Vector3d::UnitY();
  return fmt::format(
      "  begin\n    id {}\n    name {}\n    direction {:.12g} {:.12g} {:.12g}\n    length {:.12g}\n"
      "    axis 0 0 0 XYZ\n{}  end\n",
      id, name, direction.x(), direction.y(), direction.z(), length > kShortest ? length * kUnitsPerMetre : 0.0, dof);
}

// Angles of R = Rz Ry Rx: a sequence x, y, z about fixed axes. [deg], x y z.
Vector3d fixedAxesXyz(const Eigen::Matrix3d& R) {
  const double y = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
  if (std::abs(R(2, 0)) > 1.0 - 1e-12) return kDegrees * Vector3d(std::atan2(-R(1, 2), R(1, 1)), y, 0);
  return kDegrees * Vector3d(std::atan2(R(2, 1), R(2, 2)), y, std::atan2(R(1, 0), R(0, 0)));
}

}  // namespace

void writeAsfAmc(const SourceMotion& motion, const std::filesystem::path& asf, const std::filesystem::path& amc) {
  std::string bones;
  std::string hierarchy;
  int id = 0;
  const auto nameOf = [&](std::size_t b) { return b == 0 ? std::string("root") : motion.bones[b].name; };
  for (std::size_t b = 1; b < motion.bones.size(); ++b) {
    const MotionBone& bone = motion.bones[b];
    const auto parent = static_cast<std::size_t>(bone.parent);
    std::string parent_name = nameOf(parent);
    const Vector3d gap = parent == 0 ? bone.offset : Vector3d(bone.offset - motion.bones[parent].tip);
    if (gap.norm() > kShortest) {
      const std::string fixed = bone.name + "_joint";
      bones += boneText(++id, fixed, gap, "");
      hierarchy += fmt::format("    {} {}\n", parent_name, fixed);
      parent_name = fixed;
    }
    bones += boneText(++id, bone.name, bone.tip, "    dof rx ry rz\n");
    hierarchy += fmt::format("    {} {}\n", parent_name, bone.name);
  }
  writeFileAtomically(asf,
                      ":version 1.10\n:name depthmocap\n:units\n  mass 1.0\n  length 0.45\n  angle deg\n:root\n"
                      "  order TX TY TZ RX RY RZ\n  axis XYZ\n  position 0 0 0\n  orientation 0 0 0\n:bonedata\n" +
                          bones + ":hierarchy\n  begin\n" + hierarchy + "  end\n");
  std::string text = ":FULLY-SPECIFIED\n:DEGREES\n";
  for (std::size_t f = 0; f < motion.frames.size(); ++f) {
    const MotionFrame& frame = motion.frames[f];
    const Vector3d p = kUnitsPerMetre * frame.position[0];
    text += fmt::format("{}\n", f + 1);
    for (std::size_t b = 0; b < motion.bones.size(); ++b) {
      const Vector3d angles = fixedAxesXyz(frame.rotation[b].toRotationMatrix());
      text += nameOf(b);
      if (b == 0) text += fmt::format(" {:.9g} {:.9g} {:.9g}", p.x(), p.y(), p.z());
      text += fmt::format(" {:.9g} {:.9g} {:.9g}\n", angles.x(), angles.y(), angles.z());
    }
  }
  writeFileAtomically(amc, text);
}

}  // namespace depthmocap
