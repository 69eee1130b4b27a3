#pragma once
#include "libtracker/classify/classify.h"
#include "libtracker/classify/forest.h"
#include "libtracker/classify/part_classifier.h"

namespace depthmocap {

// A random forest as part classifier (Shotton 2011).
class ForestClassifier : public PartClassifier {
 public:
  struct Memory : PartClassifier::Memory {
    ClassifyMemory votes;
  };
  // Throws Error where the forest holds no tree.
  explicit ForestClassifier(Forest forest);

  [[nodiscard]] std::unique_ptr<PartClassifier::Memory> newMemory() const override;
  [[nodiscard]] bool tellsFacings() const override { return forest_.facings > 1; }
  void classify(const DepthImage& depth, const MaskImage& mask, const CameraModel& camera, const ClassifyConfig& config,
                PartClassifier::Memory& memory, ClassifiedPixels& result) const override;
  void assumeFacing(const FacingShares& facing, int threads, const PartClassifier::Memory& memory,
                    ClassifiedPixels& pixels) const override;

  [[nodiscard]] const Forest& forest() const { return forest_; }

 private:
  Forest forest_;
};

}  // namespace depthmocap
