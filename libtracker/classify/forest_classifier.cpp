#include "libtracker/classify/forest_classifier.h"

#include <utility>

#include "depthmocap/error.h"

namespace depthmocap {

ForestClassifier::ForestClassifier(Forest forest) : forest_(std::move(forest)) {
  if (forest_.trees.empty()) {
    throw Error("the forest has no tree", "ForestClassifier", "load one from a file, or take Models::shipped()");
  }
  checkForest(forest_);
}

std::unique_ptr<PartClassifier::Memory> ForestClassifier::newMemory() const {
  return std::make_unique<Memory>();
}

void ForestClassifier::classify(const DepthImage& depth, const MaskImage& mask, const CameraModel& camera,
                                const ClassifyConfig& config, PartClassifier::Memory& memory,
                                ClassifiedPixels& result) const {
  depthmocap::classify(forest_, depth, mask, camera.fx, config, static_cast<Memory&>(memory).votes, result);
}

void ForestClassifier::assumeFacing(const FacingShares& facing, int threads, const PartClassifier::Memory& memory,
                                    ClassifiedPixels& pixels) const {
  depthmocap::assumeFacing(facing, threads, static_cast<const Memory&>(memory).votes, pixels);
}

}  // namespace depthmocap
