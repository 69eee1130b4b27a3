#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "libtracker/recording/image_list_reader.h"

namespace depthmocap {

// The depth pictures that depth.txt or associations.txt of a TUM RGB-D folder lists, in order.
struct TumIndex {
  std::vector<IndexEntry> entries;   // at least one; numbers from 0, times growing
  double fps = 0;                    // [1/s] (> 0)
  std::vector<std::string> guesses;  // as RecordingInfo::guesses
};

// Fields are separated by blanks or tabs. Of a row with several times and files that one is taken whose first file is a
// 16-bit grey PNG. A row with the time of the row before is passed over. Times that count 0, 1, 2, ... or 1, 2, 3, ...
// are numbers of frames. Throws Error naming the line.
TumIndex readTumIndex(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace depthmocap
