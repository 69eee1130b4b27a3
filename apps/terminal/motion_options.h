#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "libtracker/motion/motion_files.h"

namespace CLI {
class App;
}

namespace depthmocap {

// --asf, --unit, --bones and --fps, of every command that reads motion files. `options` must outlive the parsing.
void addMotionOptions(CLI::App& command, LoadOptions& options);

// A line on stderr for each warning about a file.
void printMotionWarnings(const std::filesystem::path& file, const std::vector<std::string>& warnings);

}  // namespace depthmocap
