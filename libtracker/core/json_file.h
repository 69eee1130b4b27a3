#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

// Include this only where nlohmann_json is linked.
namespace depthmocap {

// The JSON object in a file; Error if the file cannot be read, is no JSON or no object.
nlohmann::json readJsonFile(const std::filesystem::path& path);
// Writes whole or not at all, indented, keys sorted, with a line end. Text that is no UTF-8 is replaced by U+FFFD.
void writeJsonFile(const std::filesystem::path& path, const nlohmann::json& object);

// A member of an object; Error naming `where` and the key if it is missing or of another type. Numbers are finite.
double jsonNumber(const nlohmann::json& object, const std::string& key, const std::string& where);
int jsonInteger(const nlohmann::json& object, const std::string& key, const std::string& where);
std::string jsonString(const nlohmann::json& object, const std::string& key, const std::string& where);

// Checks the first two members of our formats; `version` is the newest that this program reads.
void checkJsonFormat(const nlohmann::json& object, const std::string& format, int version, const std::string& where);

}  // namespace depthmocap
