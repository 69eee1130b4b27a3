#pragma once
#include <Eigen/Core>
#include <vector>

namespace depthmocap {

// An implicit body: the signed distance [m] (negative inside, about exact near the surface) of a smooth union of
// masses. The body is symmetric: masses describe the half x >= 0 and are mirrored.

// One cross-section of a loft: half-extents [m] at position t [m] along its axis.
struct Section {
  double t;
  double outer, inner;  // towards and away from the lateral direction
  double front, back;   // towards and away from the front direction
};

class BodyField {
 public:
  // A tube of superelliptic sections (exponent 2 = ellipse) around an axis, rounded at both ends over cap lengths [m].
  // axis, lateral and front must be an orthonormal frame; sections are sorted by t and interpolated smoothly.
  // `blend` is the width [m] of the fillet to what was added before.
  void addLoft(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, const Eigen::Vector3d& lateral,
               const Eigen::Vector3d& front, const std::vector<Section>& sections, double start_cap, double end_cap,
               double exponent, double blend);
  void addEllipsoid(const Eigen::Vector3d& center, const Eigen::Vector3d& half_axes, double blend);
  // The hull of two balls.
  void addCone(const Eigen::Vector3d& a, double radius_a, const Eigen::Vector3d& b, double radius_b, double blend);
  // Nothing below the floor y, and a gap of this half-width [m] around x = 0 below the crotch, so that legs never join.
  void setFloor(double y) { floor_y_ = y; }
  void setLegGap(double crotch_y, double half_width) {
    crotch_y_ = crotch_y;
    half_gap_ = half_width;
  }

  [[nodiscard]] float distance(const Eigen::Vector3f& p) const;
  [[nodiscard]] const Eigen::Vector3f& lower() const { return lower_; }  // of the masses with x >= 0 [m]
  [[nodiscard]] const Eigen::Vector3f& upper() const { return upper_; }

 private:
  struct Mass {
    enum class Kind { Loft, Ellipsoid, Cone } kind = Kind::Loft;
    Eigen::Vector3f a = Eigen::Vector3f::Zero(), b = Eigen::Vector3f::Zero();  // origin, center or ends
    Eigen::Matrix3f frame = Eigen::Matrix3f::Identity();                       // rows: lateral, front, axis
    std::vector<Eigen::Array4f> table;                                         // outer, inner, front, back
    float t0 = 0, step = 1, start_cap = 0, end_cap = 0, exponent = 2;
    float radius_a = 0, radius_b = 0, blend = 0;
    Eigen::Vector3f lower = Eigen::Vector3f::Constant(1e9F), upper = Eigen::Vector3f::Constant(-1e9F);
  };
  static float loftDistance(const Mass& mass, const Eigen::Vector3f& p);
  static float massDistance(const Mass& mass, const Eigen::Vector3f& p);
  void add(Mass mass);

  std::vector<Mass> masses_;
  Eigen::Vector3f lower_ = Eigen::Vector3f::Constant(1e9F);
  Eigen::Vector3f upper_ = Eigen::Vector3f::Constant(-1e9F);
  double floor_y_ = -1e9;
  double crotch_y_ = -1e9;
  double half_gap_ = 0;
};

// Volume [m^3] of the whole body from samples on a coarse grid of this cell size [m].
double fieldVolume(const BodyField& field, double cell);

}  // namespace depthmocap
