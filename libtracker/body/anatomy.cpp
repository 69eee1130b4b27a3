#include "libtracker/body/anatomy.h"

#include <algorithm>
#include <vector>

namespace depthmocap {
namespace {

using Eigen::Vector3d;

// Fillet between two limb segments that already meet flush: a wide one would swell the joint. [m at 1.75 m]
constexpr double kJointBlend = 0.006;

// Builds the masses of one body. Tables below are in metres for an adult of 1.75 m (girths after ANSUR 1988); u scales
// them to this body. Heights along the trunk are shares of the bone lengths, so that the surface follows the skeleton.
class Anatomist {
 public:
  Anatomist(Sex sex, const BoneLengths& lengths, double stature_m, double fatness)
      : female_(sex == Sex::Female), l_(lengths), u_(stature_m / 1.75), fat_(fatness) {
    shoulder_ = Vector3d(0.5 * l_.shoulder_width, l_.torso - l_.shoulder_drop, 0);
    hip_ = Vector3d(0.5 * l_.hip_width, -l_.hip_drop, 0);
    knee_ = hip_ - Vector3d(0, l_.upper_leg, 0);
    ankle_ = knee_ - Vector3d(0, l_.lower_leg, 0);
    // Crown = head centre + 0.7 neck_to_head, floor = ankle - 0.17 lower_leg: the same shares as statureOf.
    crown_y_ = l_.torso + 1.7 * l_.neck_to_head;
    floor_y_ = ankle_.y() - 0.17 * l_.lower_leg;
  }

  BodyField build() {
    trunk();
    chest();
    girdle();
    neckAndHead();
    arm();
    hand();
    leg();
    foot();
    field_.setFloor(floor_y_);
    field_.setLegGap(hip_.y() - 0.085 * u_, 0.006 * u_);
    return std::move(field_);
  }

 private:
  [[nodiscard]] double pick(double male, double female) const { return female_ ? female : male; }
  // Growth factor of a region whose rate at fatness 1 is `rate`.
  // Thin people are thin all over: below the lean adult the rates come together.
  [[nodiscard]] double grown(double rate) const {
    return std::max(0.55, fat_ > 0 ? 1.0 + rate * fat_ : 1.0 + (0.35 * rate + 0.22) * fat_);
  }
  // A table's section: extents scaled to the body and grown by rates for the sides, the front and the back.
  [[nodiscard]] Section section(double t, double outer, double inner, double front, double back, double side_rate,
                                double front_rate, double back_rate) const {
    return {t, outer * u_ * grown(side_rate), inner * u_ * grown(side_rate), front * u_ * grown(front_rate),
            back * u_ * grown(back_rate)};
  }

  void trunk();
  void chest();
  void girdle();
  void neckAndHead();
  void face(const Vector3d& head);
  void arm();
  void hand();
  void leg();
  void foot();

  bool female_;
  BoneLengths l_;
  double u_;
  double fat_;
  Vector3d shoulder_, hip_, knee_, ankle_;
  double crown_y_, floor_y_;
  BodyField field_;
};

// One cross-section of the trunk: height as a share of the torso length, half-width, front and back [m at 1.75 m], and
// how fast they grow with fatness.
struct TrunkRow {
  double height, side, front, back, side_rate, front_rate, back_rate;
};

constexpr TrunkRow kMaleTrunk[] = {
    {-0.215, 0.095, 0.060, 0.060, 0.25, 0.30, 0.30}, {-0.120, 0.150, 0.084, 0.092, 0.30, 0.45, 0.35},
    {0.000, 0.166, 0.098, 0.102, 0.34, 0.70, 0.35},  {0.110, 0.160, 0.103, 0.092, 0.42, 0.95, 0.38},
    {0.230, 0.149, 0.102, 0.083, 0.50, 1.10, 0.42},  {0.350, 0.146, 0.102, 0.084, 0.50, 1.05, 0.42},
    {0.480, 0.151, 0.106, 0.094, 0.42, 0.80, 0.36},  {0.610, 0.158, 0.110, 0.106, 0.36, 0.50, 0.32},
    {0.730, 0.160, 0.108, 0.112, 0.32, 0.34, 0.30},  {0.820, 0.150, 0.096, 0.110, 0.26, 0.28, 0.28},
    {0.900, 0.120, 0.073, 0.100, 0.20, 0.20, 0.24},  {0.975, 0.070, 0.052, 0.078, 0.15, 0.15, 0.20}};
constexpr TrunkRow kFemaleTrunk[] = {
    {-0.215, 0.105, 0.062, 0.064, 0.30, 0.30, 0.30}, {-0.120, 0.166, 0.086, 0.096, 0.36, 0.42, 0.38},
    {0.000, 0.178, 0.098, 0.102, 0.40, 0.60, 0.38},  {0.110, 0.166, 0.101, 0.090, 0.48, 0.80, 0.40},
    {0.230, 0.143, 0.095, 0.079, 0.56, 0.95, 0.42},  {0.350, 0.131, 0.091, 0.077, 0.56, 0.90, 0.42},
    {0.480, 0.134, 0.092, 0.086, 0.46, 0.66, 0.38},  {0.610, 0.141, 0.095, 0.097, 0.38, 0.42, 0.34},
    {0.730, 0.144, 0.095, 0.103, 0.32, 0.30, 0.30},  {0.820, 0.136, 0.086, 0.102, 0.26, 0.26, 0.28},
    {0.900, 0.106, 0.066, 0.092, 0.20, 0.20, 0.24},  {0.975, 0.060, 0.046, 0.070, 0.15, 0.15, 0.20}};

void Anatomist::trunk() {
  std::vector<Section> sections;
  const auto add = [&](const TrunkRow& r) {
    sections.push_back(
        section(r.height * l_.torso, r.side, r.side, r.front, r.back, r.side_rate, r.front_rate, r.back_rate));
  };
  if (female_) {
    for (const TrunkRow& row : kFemaleTrunk) add(row);
  } else {
    for (const TrunkRow& row : kMaleTrunk) add(row);
  }
  field_.addLoft(Vector3d::Zero(), Vector3d::UnitY(), Vector3d::UnitX(), Vector3d::UnitZ(), sections, 0.03 * u_,
                 0.03 * u_, 2.35, 0.0);
  const double g = grown(0.40);
  const double glute = pick(1.0, 1.07) * u_;
  field_.addEllipsoid({0.073 * u_ * g, hip_.y() - 0.035 * u_, -0.062 * u_ * g},
                      Vector3d(0.078, 0.092, 0.066) * glute * g, 0.05 * u_);
}

void Anatomist::chest() {
  const double y = 0.735 * l_.torso;
  if (female_) {
    const double g = grown(0.45);
    field_.addEllipsoid({0.078 * u_ * grown(0.25), y - 0.012 * u_, 0.078 * u_ * grown(0.25)},
                        Vector3d(0.061, 0.060, 0.051) * u_ * g, 0.06 * u_);
  } else {
    field_.addEllipsoid({0.077 * u_, y + 0.012 * u_, 0.063 * u_ * grown(0.30)},
                        Vector3d(0.080, 0.060, 0.047) * u_ * grown(0.25), 0.05 * u_);
  }
  // Shoulder blade and the broad muscle of the back that closes the armpit behind; the chest muscle in front.
  const double m = pick(1.0, 0.86) * u_ * grown(0.28);
  field_.addEllipsoid({0.085 * u_, 0.76 * l_.torso, -0.068 * u_}, Vector3d(0.070, 0.095, 0.048) * m, 0.05 * u_);
  const Vector3d axilla = shoulder_ + Vector3d(0.015, -0.045, 0) * u_;
  field_.addCone({0.118 * u_, 0.62 * l_.torso, -0.040 * u_}, 0.042 * m, axilla + Vector3d(0, 0, -0.028 * u_), 0.028 * m,
                 0.05 * u_);
  field_.addCone({0.095 * u_, 0.78 * l_.torso, 0.055 * u_}, 0.042 * m, axilla + Vector3d(0, 0.01, 0.022) * u_,
                 0.028 * m, 0.05 * u_);
}

void Anatomist::girdle() {
  const double m = pick(1.0, 0.86) * u_ * grown(0.25);
  // Trapezius from the neck to the acromion, above the clavicle.
  field_.addCone({0.035 * u_, l_.torso + 0.012 * u_, -0.030 * u_}, 0.046 * m,
                 shoulder_ + Vector3d(-0.015, 0.006, -0.006) * u_, 0.044 * m, 0.06 * u_);
  field_.addCone({0.030 * u_, l_.torso - 0.035 * u_, 0.010 * u_}, 0.042 * m,
                 shoulder_ + Vector3d(-0.010, 0, 0.008) * u_, 0.042 * m, 0.06 * u_);
  field_.addEllipsoid(shoulder_ + Vector3d(0.022, -0.002, -0.002) * u_, Vector3d(0.080, 0.058, 0.060) * m, 0.05 * u_);
}

void Anatomist::neckAndHead() {
  const double neck = pick(0.060, 0.051) * u_ * grown(0.26);
  const Vector3d head(0, l_.torso + l_.neck_to_head, 0.012 * u_);
  field_.addCone({0, l_.torso - 0.040 * u_, -0.022 * u_}, neck * 1.12, {0, head.y() - 0.045 * u_, -0.008 * u_}, neck,
                 0.045 * u_);
  // Head sizes barely follow the stature.
  const double h = (0.5 + 0.5 * u_) * pick(1.0, 0.955);
  const Vector3d cranium(0.077 * h, 0.098 * h, 0.097 * h);
  field_.addEllipsoid({0, crown_y_ - cranium.y(), head.z() - 0.004 * u_}, cranium, 0.03 * u_);
  face(Vector3d(0, crown_y_ - 0.122 * h, head.z()));
}

void Anatomist::face(const Vector3d& head) {
  const double h = (0.5 + 0.5 * u_) * pick(1.0, 0.955);
  const double cheek = h * grown(0.12);
  const auto at = [&](double x, double y, double z) { return Vector3d(head + Vector3d(x, y, z) * h); };
  field_.addEllipsoid(at(0, -0.030, 0.030), Vector3d(0.062, 0.078, 0.062) * cheek, 0.02 * u_);
  // Jaw: from below the ear to the chin; its breadth tells the sexes apart.
  field_.addCone(at(0.046, -0.052, -0.002), pick(0.024, 0.021) * cheek, at(0.012, -0.098, 0.064), 0.020 * cheek,
                 0.03 * u_);
  field_.addCone(at(0, 0.016, 0.084), 0.011 * h, at(0, -0.028, 0.099), 0.015 * h, 0.018 * u_);
  field_.addCone(at(0, 0.022, 0.083), 0.014 * h, at(0.035, 0.020, 0.070), 0.013 * h, 0.02 * u_);
  field_.addEllipsoid(at(0.076, -0.012, -0.010), Vector3d(0.010, 0.031, 0.018) * h, 0.008 * u_);
}

void Anatomist::arm() {
  const double m = pick(1.0, 0.84);
  const auto upper = [&](double share, double up, double down, double front, double back, double rate) {
    return section(share * l_.upper_arm, up * m, down * m, front * m, back * m, rate, rate, rate);
  };
  // Lateral is up, so outer and inner are the deltoid's and the armpit's side.
  field_.addLoft(shoulder_, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ(),
                 {upper(-0.05, 0.052, 0.050, 0.050, 0.052, 0.42), upper(0.15, 0.054, 0.054, 0.053, 0.055, 0.42),
                  upper(0.40, 0.047, 0.049, 0.052, 0.051, 0.42), upper(0.60, 0.042, 0.044, 0.050, 0.047, 0.38),
                  upper(0.80, 0.039, 0.040, 0.044, 0.042, 0.30), upper(1.00, 0.039, 0.040, 0.040, 0.041, 0.24)},
                 0.05 * u_, 0.03 * u_, 2.0, 0.04 * u_);
  const Vector3d elbow = shoulder_ + Vector3d(l_.upper_arm, 0, 0);
  const auto lower = [&](double share, double up, double down, double front, double back, double rate) {
    const double w = pick(1.0, 0.87);
    return section(share * l_.lower_arm, up * w, down * w, front * w, back * w, rate, rate, rate);
  };
  field_.addLoft(elbow, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ(),
                 {lower(-0.05, 0.038, 0.038, 0.039, 0.040, 0.24), lower(0.18, 0.043, 0.040, 0.046, 0.042, 0.27),
                  lower(0.40, 0.040, 0.038, 0.043, 0.041, 0.25), lower(0.65, 0.032, 0.031, 0.036, 0.035, 0.20),
                  lower(0.90, 0.024, 0.023, 0.030, 0.030, 0.12), lower(1.04, 0.022, 0.021, 0.030, 0.030, 0.10)},
                 0.03 * u_, 0.02 * u_, 2.0, kJointBlend * u_);
}

// Palm down, thumb to the front, fingers together and slightly curled.
void Anatomist::hand() {
  const Vector3d wrist = shoulder_ + Vector3d(l_.upper_arm + l_.lower_arm, 0, 0);
  const double s = u_ * pick(1.0, 0.93);
  const double thick = s * grown(0.12);
  const auto row = [&](double t, double up, double down, double front, double back) {
    return Section{t * s, up * thick, down * thick, front * thick, back * thick};
  };
  field_.addLoft(wrist, Vector3d(0.992, -0.126, 0), Vector3d(0.126, 0.992, 0), Vector3d::UnitZ(),
                 {row(0.000, 0.020, 0.020, 0.030, 0.029), row(0.035, 0.017, 0.020, 0.042, 0.038),
                  row(0.075, 0.015, 0.017, 0.044, 0.042), row(0.105, 0.013, 0.014, 0.041, 0.041),
                  row(0.145, 0.012, 0.013, 0.036, 0.035), row(0.170, 0.011, 0.012, 0.028, 0.025)},
                 0.02 * s, 0.016 * s, 2.2, 0.015 * u_);
  const auto at = [&](double x, double y, double z) { return Vector3d(wrist + Vector3d(x, y, z) * s); };
  field_.addCone(at(0.025, -0.004, 0.026), 0.018 * thick, at(0.062, -0.016, 0.056), 0.014 * thick, 0.015 * u_);
  field_.addCone(at(0.062, -0.016, 0.056), 0.014 * thick, at(0.094, -0.022, 0.068), 0.010 * thick, 0.006 * u_);
}

void Anatomist::leg() {
  const double m = pick(1.0, 1.03);
  const double rate = pick(0.36, 0.44);
  const auto thigh = [&](double share, double out, double in, double front, double back, double slow) {
    return section(share * l_.upper_leg, out * m, in * m, front * m, back * m, rate * slow, rate * slow, rate * slow);
  };
  field_.addLoft(hip_, -Vector3d::UnitY(), Vector3d::UnitX(), Vector3d::UnitZ(),
                 {thigh(-0.08, 0.072, 0.065, 0.074, 0.075, 1.0), thigh(0.08, 0.083, 0.076, 0.086, 0.082, 1.0),
                  thigh(0.22, 0.081, 0.080, 0.088, 0.084, 1.0), thigh(0.40, 0.076, 0.077, 0.085, 0.079, 0.95),
                  thigh(0.60, 0.067, 0.069, 0.077, 0.070, 0.85), thigh(0.80, 0.058, 0.061, 0.066, 0.060, 0.65),
                  thigh(1.00, 0.053, 0.056, 0.058, 0.053, 0.50)},
                 0.09 * u_, 0.03 * u_, 2.1, 0.055 * u_);
  const double w = pick(1.0, 0.98);
  const auto shank = [&](double share, double out, double in, double front, double back, double r) {
    return section(share * l_.lower_leg, out * w, in * w, front * w, back * w, r, r, r);
  };
  field_.addLoft(knee_, -Vector3d::UnitY(), Vector3d::UnitX(), Vector3d::UnitZ(),
                 {shank(-0.06, 0.052, 0.055, 0.057, 0.053, 0.20), shank(0.08, 0.051, 0.052, 0.053, 0.056, 0.22),
                  shank(0.24, 0.055, 0.056, 0.045, 0.069, 0.28), shank(0.38, 0.053, 0.054, 0.041, 0.069, 0.28),
                  shank(0.55, 0.044, 0.044, 0.038, 0.056, 0.22), shank(0.75, 0.034, 0.034, 0.034, 0.042, 0.14),
                  shank(0.92, 0.032, 0.033, 0.037, 0.042, 0.08), shank(1.02, 0.034, 0.035, 0.043, 0.044, 0.05)},
                 0.03 * u_, 0.03 * u_, 2.0, kJointBlend * u_);
  field_.addEllipsoid(knee_ + Vector3d(0, 0.004, 0.034) * u_, Vector3d(0.034, 0.042, 0.028) * u_ * grown(0.1),
                      0.02 * u_);
}

// A foot in a soft shoe: heel, instep, ball and toes, cut flat by the floor.
void Anatomist::foot() {
  const double s = u_ * pick(1.0, 0.95);
  const double ball_z = l_.foot * 0.93675;
  const auto at = [&](double x, double above_floor, double z) {
    return Vector3d(ankle_.x() + x * s, floor_y_ + above_floor * s, z);
  };
  field_.addEllipsoid(at(0, 0.030, -0.028 * s), Vector3d(0.034, 0.042, 0.036) * s, 0.03 * u_);
  field_.addCone(at(0, 0.040, 0.0), 0.034 * s, at(0.003, 0.028, 0.62 * ball_z), 0.036 * s, 0.03 * u_);
  field_.addEllipsoid(at(0.004, 0.014, 0.86 * ball_z), Vector3d(0.047, 0.034, 0.070) * s, 0.03 * u_);
  field_.addEllipsoid(at(-0.002, 0.012, ball_z + 0.016 * s), Vector3d(0.042, 0.026, 0.052) * s, 0.02 * u_);
}

}  // namespace

BodyField makeAnatomy(Sex sex, const BoneLengths& lengths, double stature_m, double fatness) {
  return Anatomist(sex, lengths, stature_m, fatness).build();
}

}  // namespace depthmocap
