#include "libtracker/body/sample_body.h"

#include <algorithm>
#include <cmath>

#include "libtracker/body/builtin_body.h"
#include "libtracker/body/clothing.h"

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

MakeHumanShape sampleMakeHumanShape(Random& random) {
  const auto near_middle = [&](double spread) { return std::clamp(0.5 + spread * random.normal(), 0.0, 1.0); };
  MakeHumanShape shape;
  const bool man = random.uniform() < 0.5;
  const double ambiguity = 0.35 * random.uniform() * random.uniform();
  shape.male = man ? 1.0 - ambiguity : ambiguity;
  const double age = random.uniform();
  shape.age_years = 25.0 + 60.0 * age * age;
  shape.muscle = near_middle(0.22);
  // The macro's lower end is starved and its upper end only stout: shift to the stout side.
  shape.weight = std::clamp(0.62 + 0.25 * random.normal(), 0.2, 1.0);
  shape.height = near_middle(0.20);
  shape.proportions = near_middle(0.25);
  shape.african = random.uniform() * random.uniform();
  shape.asian = random.uniform() * random.uniform();
  shape.caucasian = 0.05 + random.uniform() * random.uniform();
  shape.stature_m = sampleStature(random, man ? Sex::Male : Sex::Female);
  return shape;
}

BodySurface sampleDressedBody(Random& random, const MakeHumanModel* makehuman) {
  const bool from_makehuman = makehuman != nullptr && random.uniform() < 0.5;
  BodySurface body =
      from_makehuman ? makehuman->make(sampleMakeHumanShape(random)) : makeBuiltinBody(sampleBodyShape(random));
  dress(body, sampleClothing(random));
  return body;
}

}  // namespace depthmocap
