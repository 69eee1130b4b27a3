#include "libtracker/core/json_file.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/printable.h"

namespace depthmocap {

namespace {

constexpr std::size_t kShownBytes = 200;  // of a damaged text, in a message

const nlohmann::json& member(const nlohmann::json& object, const std::string& key, const std::string& where) {
  if (!object.is_object() || !object.contains(key)) throw Error("\"" + key + "\" is missing", where);
  return object.at(key);
}

// What the library lets pass, found while a text is read: nesting without limit, and two members with the same key.
template <typename Json>
class DamageFinder {
 public:
  explicit DamageFinder(std::string where) : where_(std::move(where)) {}

  bool operator()(int depth, typename Json::parse_event_t event, Json& value) {
    if (depth >= kMostJsonLevels) throw Error("is nested too deeply", where_);
    if (event == Json::parse_event_t::object_start) keys_.emplace_back();
    if (event == Json::parse_event_t::object_end) keys_.pop_back();
    if (event == Json::parse_event_t::key && !keys_.back().insert(value.template get<std::string>()).second) {
      const std::string key = printable(value.template get<std::string>(), kShownBytes);
      throw Error("\"" + key + "\" stands twice in one object", where_);
    }
    return true;
  }

 private:
  std::string where_;
  std::vector<std::set<std::string>> keys_;
};

template <typename Json>
Json parsed(std::string_view text, const std::string& where) {
  Json object;
  try {
    object = Json::parse(text, DamageFinder<Json>(where));
  } catch (const typename Json::exception& failure) {
    throw Error("is not valid JSON: " + printable(failure.what(), kShownBytes), where);
  }
  if (!object.is_object()) throw Error("must hold a JSON object", where);
  return object;
}

}  // namespace

nlohmann::json parseJson(std::string_view text, const std::string& where) {
  return parsed<nlohmann::json>(text, where);
}

nlohmann::ordered_json parseOrderedJson(std::string_view text, const std::string& where) {
  return parsed<nlohmann::ordered_json>(text, where);
}

nlohmann::json readJsonFile(const std::filesystem::path& path) {
  return parseJson(readFile(path, "the file", kMostJsonBytes), path.string());
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
  if (found != format)
    throw Error("\"format\" must be \"" + format + "\", not \"" + printable(found, kShownBytes) + "\"", where);
  const int found_version = jsonInteger(object, "version", where);
  if (found_version < 1 || found_version > version) {
    throw Error("version " + std::to_string(found_version) + " of the format is not known", where,
                "this program reads versions 1 to " + std::to_string(version));
  }
}

}  // namespace depthmocap
