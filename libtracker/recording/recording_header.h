#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "libtracker/recording/recording.h"

namespace depthmocap {

// recording.json to RecordingInfo, checked field by field; Error names the file, the field and the rule.
RecordingInfo readRecordingHeader(const std::filesystem::path& file);
// The same of the text of such a file; `where` names it in errors.
RecordingInfo parseRecordingHeader(std::string_view text, const std::string& where);
// The reverse, with the keys of info.extra_json. Distortion is not written: a writer is handed undistorted frames.
void writeRecordingHeader(const std::filesystem::path& file, const RecordingInfo& info);

// Throws Error unless frame rate and depth step lie in their ranges.
void checkRates(const RecordingInfo& info, const std::string& where);

}  // namespace depthmocap
