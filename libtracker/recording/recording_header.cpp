#include "libtracker/recording/recording_header.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/check_camera.h"
#include "libtracker/core/json_file.h"

namespace depthmocap {

namespace {

using nlohmann::json;

constexpr const char* kFormat = "depthmocap-recording";
constexpr int kVersion = 1;
constexpr double kFastest = 1e4;  // [1/s] of pictures
constexpr double kSlowest = 1e-3;
constexpr double kLargestUnit_m = 1;  // of a step of depth
constexpr double kSmallestUnit_m = 1e-7;

void require(bool condition, const std::string& what, const std::string& where) {
  if (!condition) throw Error(what, where);
}

std::array<double, 5> readDistortion(const json& intrinsics, const std::string& where) {
  std::array<double, 5> distortion{};
  if (!intrinsics.contains("distortion") || intrinsics["distortion"].is_null()) return distortion;
  const json& list = intrinsics["distortion"];
  const std::string rule = "\"distortion\" must be a list of the 5 numbers k1, k2, p1, p2, k3";
  require(list.is_array() && (list.size() == distortion.size() || list.empty()), rule, where);
  for (std::size_t i = 0; i < list.size(); ++i) {
    require(list[i].is_number() && std::isfinite(list[i].get<double>()), rule, where);
    distortion[i] = list[i].get<double>();
  }
  return distortion;
}

CameraModel readCamera(const json& header, const std::string& where) {
  CameraModel camera;
  camera.width = jsonInteger(header, "width", where);
  camera.height = jsonInteger(header, "height", where);
  require(header.contains("intrinsics") && header["intrinsics"].is_object(), "\"intrinsics\" is missing", where);
  const json& intrinsics = header["intrinsics"];
  camera.fx = jsonNumber(intrinsics, "fx", where);
  camera.fy = jsonNumber(intrinsics, "fy", where);
  camera.cx = jsonNumber(intrinsics, "cx", where);
  camera.cy = jsonNumber(intrinsics, "cy", where);
  camera.distortion = readDistortion(intrinsics, where);
  checkCamera(camera, where);
  return camera;
}

// What is left of the header without the keys that RecordingInfo holds.
std::string unknownKeys(json header) {
  for (const char* key : {"format", "version", "width", "height", "fps", "depth_unit_m", "camera", "note"}) {
    header.erase(key);
  }
  for (const char* key : {"fx", "fy", "cx", "cy", "distortion"}) header["intrinsics"].erase(key);
  if (header["intrinsics"].empty()) header.erase("intrinsics");
  return header.dump();
}

}  // namespace

void checkRates(const RecordingInfo& info, const std::string& where) {
  requireRange("fps", info.fps, kSlowest, kFastest, where);
  requireRange("depth_unit_m", info.depth_unit_m, kSmallestUnit_m, kLargestUnit_m, where);
}

RecordingInfo readRecordingHeader(const std::filesystem::path& file) {
  return parseRecordingHeader(readFile(file, "the recording's header", kMostJsonBytes), file.string());
}

RecordingInfo parseRecordingHeader(std::string_view text, const std::string& where) {
  const json header = parseJson(text, where);
  checkJsonFormat(header, kFormat, kVersion, where);
  RecordingInfo info;
  info.camera = readCamera(header, where);
  info.fps = jsonNumber(header, "fps", where);
  info.depth_unit_m = jsonNumber(header, "depth_unit_m", where);
  checkRates(info, where);
  if (header.contains("camera")) info.camera_name = jsonString(header, "camera", where);
  if (header.contains("note")) info.note = jsonString(header, "note", where);
  info.extra_json = unknownKeys(header);
  return info;
}

void writeRecordingHeader(const std::filesystem::path& file, const RecordingInfo& info) {
  checkCamera(info.camera, file.string());
  checkRates(info, file.string());
  json header = json::parse(info.extra_json);  // our own text, of unknownKeys()
  header["format"] = kFormat;
  header["version"] = kVersion;
  header["width"] = info.camera.width;
  header["height"] = info.camera.height;
  header["fps"] = info.fps;
  header["depth_unit_m"] = info.depth_unit_m;
  json& intrinsics = header["intrinsics"];
  intrinsics["fx"] = info.camera.fx;
  intrinsics["fy"] = info.camera.fy;
  intrinsics["cx"] = info.camera.cx;
  intrinsics["cy"] = info.camera.cy;
  header["camera"] = info.camera_name;
  header["note"] = info.note;
  writeJsonFile(file, header);
}

}  // namespace depthmocap
