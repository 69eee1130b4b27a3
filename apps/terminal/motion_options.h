#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "apps/terminal/output_check.h"
#include "libtracker/motion/motion_files.h"

namespace CLI {
class App;
}

namespace depthmocap {

// --asf, --unit, --bones and --fps, of every command that reads motion files. `options` must outlive the parsing.
void addMotionOptions(CLI::App& command, LoadOptions& options);

// Tells `check` of what is read for a motion file, or for all that lie below a folder: the motions and their skeletons.
void readsMotions(OutputCheck& check, const std::filesystem::path& motions, const LoadOptions& load);

// A line on stderr for each warning about a file.
void printMotionWarnings(const std::filesystem::path& file, const std::vector<std::string>& warnings);

}  // namespace depthmocap
