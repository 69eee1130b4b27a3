#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "forest/train/forest_accuracy.h"
#include "libtracker/classify/forest.h"

namespace depthmocap {

// Accuracy of a smaller forest: fewer trees, less depth or fewer training images.
struct CurvePoint {
  double x = 0;              // trees, depth or images
  double mean_accuracy = 0;  // over the parts
};

// The contents of a training report.
struct TrainingReport {
  std::string title;
  std::string command;     // that trained it
  std::string data;        // what it was trained on
  std::string validation;  // what it was measured on
  double render_s = 0;     // [s]
  double training_s = 0;   // [s]
  ForestAccuracy accuracy;
  std::vector<CurvePoint> by_trees, by_depth, by_images;
};

// `stem`.report.md and `stem`.report.png.
std::array<std::filesystem::path, 2> trainingReportFiles(const std::filesystem::path& stem);

// Writes them: figures, and a picture of confusion matrix and learning curves. Throws Error.
void writeTrainingReport(const TrainingReport& report, const Forest& forest, std::uintmax_t forest_bytes,
                         const std::filesystem::path& stem);

}  // namespace depthmocap
