#include "libtracker/core/json_file.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"

namespace depthmocap {

namespace {

const nlohmann::json& member(const nlohmann::json& object, const std::string& key, const std::string& where) {
  if (!object.is_object() || !object.contains(key)) throw Error("\"" + key + "\" is missing", where);
  return object.at(key);
}

}  // namespace

nlohmann::json readJsonFile(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) throw Error("is a folder, not a file", path.string());
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Error(std::string("cannot be read: ") + std::strerror(errno), path.string());
  nlohmann::json object;
  try {
    object = nlohmann::json::parse(stream);
  } catch (const nlohmann::json::exception& failure) {
    throw Error(std::string("is not valid JSON: ") + failure.what(), path.string());
  }
  if (!object.is_object()) throw Error("must hold a JSON object", path.string());
  return object;
}

void writeJsonFile(const std::filesystem::path& path, const nlohmann::json& object) {
  writeFileAtomically(path, object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

double jsonNumber(const nlohmann::json& object, const std::string& key, const std::string& where) {
  const nlohmann::json& value = member(object, key, where);
  if (!value.is_number()) throw Error("\"" + key + "\" must be a number", where);
  const auto number = value.get<double>();
  if (!std::isfinite(number)) throw Error("\"" + key + "\" must be finite", where);
  return number;
}

int jsonInteger(const nlohmann::json& object, const std::string& key, const std::string& where) {
  const double number = jsonNumber(object, key, where);
  if (number != std::floor(number) || std::abs(number) > std::numeric_limits<int>::max()) {
    throw Error("\"" + key + "\" must be a whole number", where);
  }
  return static_cast<int>(number);
}

std::string jsonString(const nlohmann::json& object, const std::string& key, const std::string& where) {
  const nlohmann::json& value = member(object, key, where);
  if (!value.is_string()) throw Error("\"" + key + "\" must be a text", where);
  return value.get<std::string>();
}

void checkJsonFormat(const nlohmann::json& object, const std::string& format, int version, const std::string& where) {
  const std::string found = jsonString(object, "format", where);
  if (found != format) throw Error("\"format\" must be \"" + format + "\", not \"" + found + "\"", where);
  const int found_version = jsonInteger(object, "version", where);
  if (found_version < 1 || found_version > version) {
    throw Error("version " + std::to_string(found_version) + " of the format is not known", where,
                "this program reads versions 1 to " + std::to_string(version));
  }
}

}  // namespace depthmocap
