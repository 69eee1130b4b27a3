#include "calibration/shape_space.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <nlohmann/json.hpp>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"
#include "libtracker/core/json_file.h"
#include "libtracker/skeleton/typical_bone_lengths.h"

namespace depthmocap {
namespace {

constexpr const char* kFormat = "depthmocap-shape-space";
constexpr int kVersion = 1;
constexpr double kMeanStature_m = 1.69;
constexpr double kStatureDeviation_m = 0.10;

using Covariance = Eigen::Matrix<double, kBoneLengthCount, kBoneLengthCount>;

LengthVector perMetre(Sex sex) {
  return lengthVector(typicalBoneLengths(sex, 1.0));
}

// Sizes are a scale of each sex' proportions, so mean and covariance of the family follow in closed form.
Covariance familyCovariance() {
  const LengthVector man = perMetre(Sex::Male);
  const LengthVector woman = perMetre(Sex::Female);
  const LengthVector middle = 0.5 * (man + woman);
  const LengthVector half = 0.5 * (man - woman);
  const double square = kMeanStature_m * kMeanStature_m + kStatureDeviation_m * kStatureDeviation_m;
  return kStatureDeviation_m * kStatureDeviation_m * middle * middle.transpose() + square * half * half.transpose();
}

Covariance proportionCovariance(const std::vector<BoneLengths>& measured) {
  const LengthVector middle = 0.5 * (perMetre(Sex::Male) + perMetre(Sex::Female));
  std::vector<LengthVector> rests;
  LengthVector mean = LengthVector::Zero();
  for (const BoneLengths& lengths : measured) {
    rests.push_back(lengthVector(lengths) / statureOf(lengths) - middle);
    mean += rests.back() / static_cast<double>(measured.size());
  }
  Covariance covariance = Covariance::Zero();
  for (const LengthVector& rest : rests) covariance += (rest - mean) * (rest - mean).transpose();
  return covariance * (kMeanStature_m * kMeanStature_m / static_cast<double>(measured.size() - 1));
}

nlohmann::json toJson(const LengthVector& s) {
  nlohmann::json object;
  for (int i = 0; i < kBoneLengthCount; ++i) object[std::string(kBoneLengthNames[static_cast<std::size_t>(i)])] = s[i];
  return object;
}

LengthVector fromJson(const nlohmann::json& object, const std::string& where) {
  LengthVector s;
  for (int i = 0; i < kBoneLengthCount; ++i) {
    s[i] = jsonNumber(object, std::string(kBoneLengthNames[static_cast<std::size_t>(i)]), where);
  }
  return s;
}

}  // namespace

LengthVector ShapeSpace::offSpace(const LengthVector& s) const {
  const LengthVector d = s - mean;
  return d - H * (H.transpose() * d);
}

ShapeSpace makeShapeSpace(const std::vector<BoneLengths>& measured, double share, const std::string& origin) {
  DMC_CHECK(measured.size() >= 2 && share > 0 && share <= 1);
  const Eigen::SelfAdjointEigenSolver<Covariance> solver(familyCovariance() + proportionCovariance(measured));
  const LengthVector values = solver.eigenvalues().reverse().cwiseMax(0.0);
  int columns = 0;
  for (double held = 0; columns < kBoneLengthCount && held < share * values.sum(); ++columns) held += values[columns];
  ShapeSpace space;
  space.origin = origin;
  space.mean = 0.5 * kMeanStature_m * (perMetre(Sex::Male) + perMetre(Sex::Female));
  space.H = solver.eigenvectors().rowwise().reverse().leftCols(columns);
  space.deviation = values.head(columns).cwiseSqrt();
  for (int k = 0; k < columns; ++k) {
    if (space.H.col(k).sum() < 0) space.H.col(k) *= -1.0;  // eigenvectors have no sign of their own
  }
  return space;
}

ShapeSpace loadShapeSpace(const std::filesystem::path& path) {
  const nlohmann::json file = readJsonFile(path);
  const std::string where = path.string();
  checkJsonFormat(file, kFormat, kVersion, where);
  ShapeSpace space;
  space.origin = jsonString(file, "origin", where);
  if (!file.contains("mean_m") || !file.contains("components") || !file["components"].is_array()) {
    throw Error("\"mean_m\" or the list \"components\" is missing", where);
  }
  space.mean = fromJson(file["mean_m"], where);
  const auto count = static_cast<Eigen::Index>(file["components"].size());
  if (count < 1 || count > kBoneLengthCount) throw Error("\"components\" must have 1 to 12 entries", where);
  space.H.resize(kBoneLengthCount, count);
  space.deviation.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const nlohmann::json& component = file["components"][static_cast<std::size_t>(k)];
    space.deviation[k] = jsonNumber(component, "deviation_m", where);
    if (space.deviation[k] <= 0) throw Error("\"deviation_m\" must be positive", where);
    if (!component.contains("direction")) throw Error("\"direction\" is missing", where);
    space.H.col(k) = fromJson(component["direction"], where);
  }
  if (!(space.H.transpose() * space.H).isIdentity(1e-6)) throw Error("the components are not orthonormal", where);
  return space;
}

void saveShapeSpace(const std::filesystem::path& path, const ShapeSpace& space) {
  nlohmann::json components = nlohmann::json::array();
  for (Eigen::Index k = 0; k < space.deviation.size(); ++k) {
    components.push_back({{"deviation_m", space.deviation[k]}, {"direction", toJson(space.H.col(k))}});
  }
  writeJsonFile(path, {{"format", kFormat},
                       {"version", kVersion},
                       {"origin", space.origin},
                       {"mean_m", toJson(space.mean)},
                       {"components", components}});
}

}  // namespace depthmocap
