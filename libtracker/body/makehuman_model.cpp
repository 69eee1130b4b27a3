#include "libtracker/body/makehuman_model.h"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/body/makehuman_rest.h"
#include "libtracker/body/part_regions.h"

namespace depthmocap {
namespace {

constexpr std::array kRaces{"african", "asian", "caucasian"};
constexpr std::array kSexes{"female", "male"};
constexpr std::array kAges{"young", "old"};
constexpr std::array kMuscles{"minmuscle", "averagemuscle", "maxmuscle"};
constexpr std::array kWeights{"minweight", "averageweight", "maxweight"};
constexpr double kYoungAge = 25;
constexpr double kOldAge = 90;

// Shares of the low, middle and high target at a value in [0, 1].
std::array<double, 3> threeShares(double value) {
  const double low = std::max(0.0, 1.0 - 2.0 * value);
  const double high = std::max(0.0, 2.0 * value - 1.0);
  return {low, 1.0 - low - high, high};
}

template <std::size_t N>
double shareOf(const std::array<double, N>& shares, int choice) {
  return choice < 0 ? 1.0 : shares[static_cast<std::size_t>(choice)];
}

void validate(const MakeHumanShape& s) {
  const auto require = [](const char* field, double value, double low, double high) {
    if (value >= low && value <= high) return;
    throw Error(fmt::format("{} is {}, outside {} .. {}", field, value, low, high), "MakeHuman shape");
  };
  require("male", s.male, 0, 1);
  require("age_years", s.age_years, kYoungAge, kOldAge);
  require("muscle", s.muscle, 0, 1);
  require("weight", s.weight, 0, 1);
  require("height", s.height, 0, 1);
  require("proportions", s.proportions, 0, 1);
  for (const double race : {s.african, s.asian, s.caucasian}) require("race share", race, 0, 1e9);
  require("sum of the race shares", s.african + s.asian + s.caucasian, 1e-6, 1e10);
  if (s.stature_m != 0) require("stature_m", s.stature_m, 1.0, 2.2);
}

}  // namespace

MakeHumanModel::MakeHumanModel(const std::filesystem::path& folder) {
  mesh_ = readMakeHumanMesh(folder / "base.obj");
  joints_ = readMakeHumanRig(folder / "rig.cmu_mb.json", mesh_);
  weights_ = readMakeHumanWeights(folder / "weights.cmu_mb.json", mesh_.body_vertices);
  const std::filesystem::path targets = folder / "targets";
  for (int sex = 0; sex < 2; ++sex) {
    const std::string sex_name = kSexes[static_cast<std::size_t>(sex)];
    for (int age = 0; age < 2; ++age) {
      const std::string age_name = kAges[static_cast<std::size_t>(age)];
      for (int race = 0; race < 3; ++race) {
        const std::string race_name = kRaces[static_cast<std::size_t>(race)];
        addMacro(targets / fmt::format("{}-{}-{}.target.gz", race_name, sex_name, age_name),
                 {.race = race, .male = sex, .old = age, .target = {}});
      }
      for (int weight = 0; weight < 3; ++weight) {
        const std::string weight_name = kWeights[static_cast<std::size_t>(weight)];
        // Old people come in average muscle only; that target then stands for all.
        for (int muscle = age == 0 ? 0 : 1; muscle < (age == 0 ? 3 : 2); ++muscle) {
          addMacro(targets / fmt::format("universal-{}-{}-{}-{}.target.gz", sex_name, age_name,
                                         kMuscles[static_cast<std::size_t>(muscle)], weight_name),
                   {.male = sex, .old = age, .muscle = age == 0 ? muscle : -1, .weight = weight, .target = {}});
        }
      }
    }
    for (int weight = 0; weight < 3; ++weight) {
      for (const int height : {0, 2}) {
        addMacro(targets / "height" /
                     fmt::format("{}-young-averagemuscle-{}-{}height.target.gz", sex_name,
                                 kWeights[static_cast<std::size_t>(weight)], height == 0 ? "min" : "max"),
                 {.male = sex, .weight = weight, .height = height, .target = {}});
      }
    }
    for (const int proportions : {0, 2}) {
      addMacro(targets / "proportions" /
                   fmt::format("{}-young-averagemuscle-averageweight-{}proportions.target.gz", sex_name,
                               proportions == 0 ? "uncommon" : "ideal"),
               {.male = sex, .proportions = proportions, .target = {}});
    }
  }
}

void MakeHumanModel::addMacro(const std::filesystem::path& file, Macro macro) {
  macro.target = readMakeHumanTarget(file, mesh_.vertices.size());
  macros_.push_back(std::move(macro));
}

std::vector<Eigen::Vector3f> MakeHumanModel::morphed(const MakeHumanShape& s) const {
  const double races = s.african + s.asian + s.caucasian;
  const std::array<double, 3> race{s.african / races, s.asian / races, s.caucasian / races};
  const std::array<double, 2> sex{1.0 - s.male, s.male};
  const double old = (s.age_years - kYoungAge) / (kOldAge - kYoungAge);
  const std::array<double, 2> age{1.0 - old, old};
  const auto muscle = threeShares(s.muscle);
  const auto weight = threeShares(s.weight);
  const auto height = threeShares(s.height);
  const auto proportions = threeShares(s.proportions);
  std::vector<Eigen::Vector3f> vertices = mesh_.vertices;
  for (const Macro& m : macros_) {
    const double share = shareOf(race, m.race) * shareOf(sex, m.male) * shareOf(age, m.old) *
                         shareOf(muscle, m.muscle) * shareOf(weight, m.weight) * shareOf(height, m.height) *
                         shareOf(proportions, m.proportions);
    if (share <= 0) continue;
    const auto factor = static_cast<float>(share);
    for (std::size_t i = 0; i < m.target.vertex.size(); ++i) vertices[m.target.vertex[i]] += factor * m.target.delta[i];
  }
  return vertices;
}

BodySurface MakeHumanModel::make(const MakeHumanShape& shape) const {
  validate(shape);
  const std::vector<Eigen::Vector3f> vertices = morphed(shape);
  BodySurface body = inZeroPose(vertices, joints_, weights_, shape.stature_m);
  body.triangles = mesh_.triangles;
  labelParts(body);
  return body;
}

}  // namespace depthmocap
