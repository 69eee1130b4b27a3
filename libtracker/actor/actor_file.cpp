#include <cmath>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "depthmocap/actor.h"
#include "depthmocap/error.h"
#include "libtracker/actor/make_actor.h"
#include "libtracker/core/json_file.h"

namespace depthmocap {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "depthmocap-actor";
constexpr int kVersion = 1;
constexpr double kShortest_m = 0.005, kLongest_m = 1.5;  // of a bone length; a hip may lie close below the pelvis
constexpr double kLeastGirth = 0.3, kMostGirth = 3.0;
constexpr double kLargestOffset_m = 0.5;
constexpr double kStatureMismatch = 0.05;
constexpr int kRequiredLengths = 9;  // the first ones, as the contract names them

std::string text(std::string_view view) {
  return std::string(view);
}

double bounded(const json& object, const std::string& key, double low, double high, const std::string& where) {
  const double value = jsonNumber(object, key, where);
  if (value < low || value > high) {
    throw Error(fmt::format("\"{}\" is {}, outside {} .. {}", key, value, low, high), where,
                "calibrate again or correct the file");
  }
  return value;
}

const json* optionalObject(const json& object, const std::string& key, const std::string& where) {
  if (!object.contains(key)) return nullptr;
  if (!object.at(key).is_object()) throw Error("\"" + key + "\" must be an object", where);
  return &object.at(key);
}

BoneLengths readLengths(const json& file, const std::string& where) {
  const json* given = optionalObject(file, "bone_lengths_m", where);
  if (given == nullptr) throw Error("\"bone_lengths_m\" is missing", where);
  BoneLengths lengths;
  for (int i = 0; i < kRequiredLengths; ++i) {
    lengths.*kBoneLengthFields[static_cast<std::size_t>(i)] =
        bounded(*given, text(kBoneLengthNames[static_cast<std::size_t>(i)]), kShortest_m, kLongest_m, where);
  }
  // The others follow the trunk, as in the average body.
  const double scale = lengths.torso / BoneLengths{}.torso;
  for (int i = kRequiredLengths; i < kBoneLengthCount; ++i) {
    const auto field = kBoneLengthFields[static_cast<std::size_t>(i)];
    const std::string name = text(kBoneLengthNames[static_cast<std::size_t>(i)]);
    lengths.*field =
        given->contains(name) ? bounded(*given, name, kShortest_m, kLongest_m, where) : scale * BoneLengths{}.*field;
  }
  if (lengths.spine >= lengths.torso) throw Error("\"spine\" must be less than \"torso\"", where);
  return lengths;
}

void readGirths(const json& file, const std::string& where, ActorMeasurement& measured) {
  const json* given = optionalObject(file, "girths", where);
  if (given == nullptr) return;
  for (int g = 0; g < kGirthCount; ++g) {
    const std::string name = text(kGirthNames[static_cast<std::size_t>(g)]);
    if (given->contains(name)) {
      measured.shape[kBoneLengthCount + g] = bounded(*given, name, kLeastGirth, kMostGirth, where);
    }
  }
}

int partNamed(const std::string& name, const std::string& where) {
  for (int i = 0; i < kPartCount; ++i) {
    if (kPartNames[static_cast<std::size_t>(i) + 1] == name) return i;
  }
  throw Error("there is no body part \"" + name + "\"", where);
}

Bone boneNamed(const std::string& name, const std::string& where) {
  for (std::size_t i = 0; i < kBoneCount; ++i) {
    if (kBoneNames[i] == name) return static_cast<Bone>(i);
  }
  throw Error("there is no bone \"" + name + "\"", where);
}

void readMarkers(const json& file, const std::string& where, Actor& model) {
  const json* given = optionalObject(file, "markers", where);
  if (given == nullptr) return;
  for (const auto& [name, marker] : given->items()) {
    const auto part = static_cast<std::size_t>(partNamed(name, where));
    const std::string at = fmt::format("{}: marker {}", where, name);
    if (!marker.is_object()) throw Error("must be an object", at);
    model.markers[part].bone = boneNamed(jsonString(marker, "bone", at), at);
    for (int axis = 0; axis < 3; ++axis) {
      const std::string key = fmt::format("{}_m", "xyz"[axis]);
      model.markers[part].p_bone[axis] = bounded(marker, key, -kLargestOffset_m, kLargestOffset_m, at);
    }
    model.radii_m[part] = bounded(marker, "depth_m", 0.0, kLargestOffset_m, at);
  }
}

void readFit(const json& file, const std::string& where, ActorMeasurement::Fit& fit) {
  const json* given = optionalObject(file, "fit", where);
  if (given == nullptr) return;
  fit.tpose_frames = jsonInteger(*given, "tpose_frames", where);
  fit.other_frames = jsonInteger(*given, "other_frames", where);
  fit.surface_m = jsonNumber(*given, "surface_m", where);
  fit.marker_m = jsonNumber(*given, "marker_m", where);
  fit.confidence = jsonNumber(*given, "confidence", where);
}

void checkStature(const json& file, const BoneLengths& lengths, const std::string& where) {
  const double stated = bounded(file, "stature_m", 0.5, 2.6, where);
  const double bones = statureOf(lengths);
  if (std::abs(stated - bones) > kStatureMismatch * bones) {
    throw Error(fmt::format("\"stature_m\" is {:.3f}, but the bone lengths make a body of {:.3f} m", stated, bones),
                where, "correct one of them");
  }
}

// Tenths of a millimetre are as much as anybody measures, and keep the file readable.
double rounded(double value) {
  return std::round(value * 1e4) / 1e4;
}

json markersToJson(const Actor& model) {
  json markers;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const BonePoint& marker = model.markers[i];
    markers[text(kPartNames[i + 1])] = {{"bone", text(kBoneNames[static_cast<std::size_t>(marker.bone)])},
                                        {"x_m", rounded(marker.p_bone.x())},
                                        {"y_m", rounded(marker.p_bone.y())},
                                        {"z_m", rounded(marker.p_bone.z())},
                                        {"depth_m", rounded(model.radii_m[i])}};
  }
  return markers;
}

}  // namespace

Actor readActorFile(const std::filesystem::path& path) {
  const std::string where = path.string();
  const json file = readJsonFile(path);
  checkJsonFormat(file, kFormat, kVersion, where);
  ActorMeasurement measured;
  const BoneLengths lengths = readLengths(file, where);
  checkStature(file, lengths, where);
  if (file.contains("surface")) {
    const std::string sex = jsonString(file, "surface", where);
    if (sex != "man" && sex != "woman") throw Error("\"surface\" must be \"man\" or \"woman\"", where);
    measured.sex = sex == "man" ? Sex::Male : Sex::Female;
  }
  measured.shape = shapeVector(lengths, BodyTemplate::ofSex(measured.sex).girthOf(statureOf(lengths)));
  readGirths(file, where, measured);
  if (const json* radii = optionalObject(file, "radii_m", where)) {
    for (const LimbRadius& radius : kLimbRadii) {
      if (radii->contains(radius.name)) measured.*radius.field = bounded(*radii, radius.name, 0.0, 0.6, where);
    }
  }
  if (file.contains("depth_scale")) measured.depth_scale = bounded(file, "depth_scale", 0.5, 2.0, where);
  if (file.contains("camera")) measured.camera = jsonString(file, "camera", where);
  readFit(file, where, measured.fit);
  Actor actor = averageActor(lengths);
  readMarkers(file, where, actor);
  actor.surface = surfaceOf(measured);
  actor.measured = std::make_shared<const ActorMeasurement>(std::move(measured));
  return actor;
}

void writeActorFile(const std::filesystem::path& path, const Actor& actor) {
  if (!actor.measured) throw Error("an average body was not measured: there is nothing to write", path.string());
  const ActorMeasurement& measured = *actor.measured;
  json lengths, girths, radii;
  for (int i = 0; i < kBoneLengthCount; ++i) {
    lengths[text(kBoneLengthNames[static_cast<std::size_t>(i)])] = rounded(measured.shape[i]);
  }
  for (int g = 0; g < kGirthCount; ++g) {
    girths[text(kGirthNames[static_cast<std::size_t>(g)])] = rounded(measured.shape[kBoneLengthCount + g]);
  }
  for (const LimbRadius& radius : kLimbRadii) radii[radius.name] = rounded(measured.*radius.field);
  writeJsonFile(path, {{"format", kFormat},
                       {"version", kVersion},
                       {"stature_m", rounded(actor.stature_m())},
                       {"bone_lengths_m", lengths},
                       {"girths", girths},
                       {"radii_m", radii},
                       {"markers", markersToJson(actor)},
                       {"surface", measured.sex == Sex::Male ? "man" : "woman"},
                       {"depth_scale", rounded(measured.depth_scale)},
                       {"camera", measured.camera},
                       {"fit",
                        {{"tpose_frames", measured.fit.tpose_frames},
                         {"other_frames", measured.fit.other_frames},
                         {"surface_m", rounded(measured.fit.surface_m)},
                         {"marker_m", rounded(measured.fit.marker_m)},
                         {"confidence", rounded(measured.fit.confidence)}}}});
}

}  // namespace depthmocap
