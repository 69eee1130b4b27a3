#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "libtracker/core/read_file.h"

// Include this only where nlohmann_json is linked.
namespace depthmocap {

// The JSON object in a text or in a file of at most kMostJsonBytes. Error naming `where` or the file if it cannot be
// read, is no JSON or no object, is nested deeper than kMostJsonLevels or names a member twice. All JSON that comes
// from outside goes through these; members in their order where the order says something.
nlohmann::json parseJson(std::string_view text, const std::string& where);
nlohmann::ordered_json parseOrderedJson(std::string_view text, const std::string& where);
nlohmann::json readJsonFile(const std::filesystem::path& path);

inline constexpr int kMostJsonLevels = 64;  // by hand: far above what anybody writes and below any stack
inline constexpr std::size_t kMostJsonBytes = mebibytes(16);  // MakeHuman's weights, the largest read, have 3 MB

// Writes whole or not at all, indented, keys sorted, with a line end. Text that is no UTF-8 is replaced by U+FFFD.
void writeJsonFile(const std::filesystem::path& path, const nlohmann::json& object);

// A member of an object; Error naming `where` and the key if it is missing or of another type. Numbers are finite.
double jsonNumber(const nlohmann::json& object, const std::string& key, const std::string& where);
int jsonInteger(const nlohmann::json& object, const std::string& key, const std::string& where);
std::string jsonString(const nlohmann::json& object, const std::string& key, const std::string& where);

// Checks the first two members of our formats; `version` is the newest that this program reads.
void checkJsonFormat(const nlohmann::json& object, const std::string& format, int version, const std::string& where);

}  // namespace depthmocap
