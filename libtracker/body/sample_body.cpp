#include "libtracker/body/sample_body.h"

#include <algorithm>
#include <cmath>

namespace depthmocap {
namespace {

// Stature of a random adult [m].
double sampleStature(Random& random, Sex sex) {
  const double mean = sex == Sex::Male ? 1.765 : 1.635;
  return std::clamp(mean + 0.072 * random.normal(), 1.50, 2.00);
}

// Body mass index [kg/m^2]: log-normal around 23.5, skewed towards the heavy as people are.
double sampleBodyMassIndex(Random& random) {
  return std::clamp(23.5 * std::exp(0.16 * random.normal()), 17.0, 36.0);
}

}  // namespace

BodyShape sampleBodyShape(Random& random) {
  BodyShape shape;
  shape.sex = random.uniform() < 0.5 ? Sex::Male : Sex::Female;
  shape.stature_m = sampleStature(random, shape.sex);
  shape.weight_kg = sampleBodyMassIndex(random) * shape.stature_m * shape.stature_m;
  return shape;
}

}  // namespace depthmocap
