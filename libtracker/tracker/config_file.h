#pragma once
#include <filesystem>
#include <string>

#include "libtracker/tracker/tracker_config.h"

namespace depthmocap {

// Configurations as JSON files: {"format": "depthmocap-config", "version": 1, "solve": {"lambda_prior": 100.0}, ...},
// one object per section of TrackerConfig::sections().

// Takes what the file says over `config`; what it leaves out stays. Throws Error naming file, section and field: no
// such field (and the nearest one), a wrong type, a value out of its range.
void readConfigFile(const std::filesystem::path& path, TrackerConfig& config);
// All fields, whole or not at all.
void writeConfigFile(const std::filesystem::path& path, const TrackerConfig& config);

// The table of all fields for docs/reference/config.md (Markdown): unit, range, default and meaning.
std::string configTable();

}  // namespace depthmocap
