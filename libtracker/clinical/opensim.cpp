#include "libtracker/clinical/opensim.h"

#include <numbers>
#include <string>

#include <fmt/format.h>

#include "libtracker/clinical/anatomical.h"
#include "libtracker/core/atomic_file.h"

namespace depthmocap {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
// Hips of the model's pelvis [m]: how far they are apart; and where the pelvis' origin, between the foremost points of
// the iliac crests, lies above and before the middle between them (Rajagopal2016.osim, joints hip_r and hip_l).
constexpr double kModelHipWidth = 2 * 0.07726;
constexpr double kModelPelvisUp = 0.07849;
constexpr double kModelPelvisForward = 0.056276;

// In the order of kOpenSimCoordinates; degrees where they are angles.
class Values {
 public:
  void angle(double rad) { values_[next_++] = kDegrees * rad; }
  // About the mediolateral axis, which is the same on both sides, and about the others, which are mirrored.
  void angles(const CardanAngles& a, double sign) {
    angle(a.flexion);
    angle(sign * a.adduction);
    angle(sign * a.rotation);
  }
  void point(const Eigen::Vector3d& p_m) {
    for (const double value : p_m) values_[next_++] = value;
  }
  [[nodiscard]] const OpenSimCoordinates& all() const { return values_; }

 private:
  OpenSimCoordinates values_ = OpenSimCoordinates::Zero();
  int next_ = 0;
};

Eigen::Vector3d modelPelvis(const ForwardKinematics& fk, double hip_width_m) {
  const double scale = hip_width_m / kModelHipWidth;
  const Eigen::Vector3d hips = 0.5 * (fk.origin(Bone::LeftFemur) + fk.origin(Bone::RightFemur));
  return hips + fk.R_world_bone(Bone::Root) * (scale * Eigen::Vector3d(0, kModelPelvisUp, kModelPelvisForward));
}

}  // namespace

Eigen::Vector3d openSimPoint(const Eigen::Vector3d& p) {
  return {p.z(), p.y(), -p.x()};
}

OpenSimCoordinates OpenSimReader::read(const ForwardKinematics& fk, double hip_width_m, const Eigen::Vector3d& origin) {
  constexpr std::array<BodySide, 2> kOrder = {BodySide::Right, BodySide::Left};
  Values values;
  pelvis_ = cardanAngles(fk.R_world_bone(Bone::Root), pelvis_);
  values.angles(pelvis_, 1.0);
  values.point(openSimPoint(modelPelvis(fk, hip_width_m) - origin));
  for (const BodySide side : kOrder) {
    CardanAngles& hip = limbs_[static_cast<std::size_t>(side)].hip;
    hip = cardanAngles(relativeRotation(fk, Bone::Root, bonesOf(side).femur), hip);
    values.angles(hip, mirrorSign(side));
    values.angle(kneeFlexion(fk, side));
    values.angle(footAngles(fk, side).dorsiflexion);
  }
  lumbar_ = cardanAngles(relativeRotation(fk, Bone::Root, Bone::UpperBack), lumbar_);
  values.angles(lumbar_, 1.0);
  for (const BodySide side : kOrder) {
    CardanAngles& arm = limbs_[static_cast<std::size_t>(side)].arm;
    arm = cardanAngles(armInThorax(fk, side), arm);
    values.angles(arm, mirrorSign(side));
    values.angle(elbowFlexion(fk, side));
  }
  return values.all();
}

void writeMot(const std::vector<OpenSimRow>& rows, const std::filesystem::path& path) {
  AtomicFile file(path);
  file.write(
      fmt::format("Coordinates\nversion=1\nnRows={}\nnColumns={}\ninDegrees=yes\n\n"
                  "Units are S.I. units (second, meters, Newtons, ...)\n"
                  "Angles are in degrees. Model: Rajagopal2016 (full body).\n\nendheader\n",
                  rows.size(), 1 + kOpenSimCoordinateCount));
  file.write(fmt::format("time\t{}\n", fmt::join(kOpenSimCoordinates, "\t")));
  for (const OpenSimRow& row : rows) {
    std::string line = fmt::format("{:.6f}", row.time_s);
    for (const double value : row.values) line += fmt::format("\t{:.6f}", value);
    file.write(line + "\n");
  }
  file.commit();
}

}  // namespace depthmocap
