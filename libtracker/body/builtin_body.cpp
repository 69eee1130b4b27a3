#include "libtracker/body/builtin_body.h"

#include <cmath>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/body/anatomy.h"
#include "libtracker/body/part_regions.h"
#include "libtracker/body/polygonise.h"
#include "libtracker/body/skin_weights.h"

namespace depthmocap {
namespace {

// Cell of the final grid and of the grids that only measure the volume, as shares of the stature.
constexpr double kCellPerStature = 0.0072;
constexpr double kCoarseCellPerStature = 0.018;
constexpr double kLeanest = -1.2;
constexpr double kFattest = 4.0;
constexpr double kWeightTolerance = 0.05;
constexpr double kOrdinaryBodyMassIndex = 23.5;  // [kg/m^2]

void validate(const BodyShape& shape) {
  const auto require = [](const char* field, double value, double low, double high) {
    if (value >= low && value <= high) return;
    throw Error(fmt::format("{} is {}, outside {} .. {}", field, value, low, high), "body shape");
  };
  require("stature_m", shape.stature_m, 1.0, 2.2);
  require("weight_kg", shape.weight_kg, 10, 160);
}

// The fatness whose volume is closest to the wanted one: bisection, the volume grows with the fatness.
double fatnessFor(const BodyShape& shape, const BoneLengths& lengths, double volume) {
  double low = kLeanest;
  double high = kFattest;
  for (int i = 0; i < 11; ++i) {
    const double middle = 0.5 * (low + high);
    const BodyField field = makeAnatomy(shape.sex, lengths, shape.stature_m, middle);
    (fieldVolume(field, kCoarseCellPerStature * shape.stature_m) < volume ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

BodySurface makeBuiltinBody(const BodyShape& shape) {
  validate(shape);
  return makeBuiltinBody(shape, typicalBoneLengths(shape.sex, shape.stature_m));
}

BodySurface makeBuiltinBody(const BoneLengths& lengths) {
  BodyShape shape;
  shape.stature_m = statureOf(lengths);
  shape.weight_kg = kOrdinaryBodyMassIndex * shape.stature_m * shape.stature_m;
  return makeBuiltinBody(shape, lengths);
}

BodySurface makeBuiltinBody(const BodyShape& shape, const BoneLengths& lengths) {
  validate(shape);
  BodySurface body;
  body.skeleton = makeSkeleton(lengths);
  const double volume = shape.weight_kg / kBodyDensityKgPerLitre * 1e-3;
  // The coarse grid misjudges the volume a little; the first surface shows by how much.
  double wanted = volume;
  for (int i = 0; i < 2; ++i) {
    const double fatness = fatnessFor(shape, lengths, wanted);
    polygonise(makeAnatomy(shape.sex, lengths, shape.stature_m, fatness), kCellPerStature * shape.stature_m, body);
    wanted *= volume / enclosedVolume(body.vertices, body.triangles);
  }
  if (std::abs(enclosedVolume(body.vertices, body.triangles) / volume - 1.0) > kWeightTolerance) {
    throw Error(fmt::format("no body of {} m weighs {} kg", shape.stature_m, shape.weight_kg), "body shape",
                "a body mass index between 13 and 60 is possible");
  }
  body.skin.reserve(body.vertices.size());
  for (const Eigen::Vector3f& p : body.vertices) body.skin.push_back(skinOfPoint(body.skeleton, p));
  labelParts(body);
  return body;
}

}  // namespace depthmocap
