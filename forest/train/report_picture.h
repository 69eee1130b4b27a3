#pragma once
#include <filesystem>

#include "forest/train/training_report.h"

namespace depthmocap {

// A PNG with the confusion matrix (rows true, columns found, row shares in percent) and the learning curves. Throws
// Error.
void drawReport(const TrainingReport& report, const std::filesystem::path& path);

}  // namespace depthmocap
