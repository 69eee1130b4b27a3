#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>

#include "libtracker/classify/forest_classifier.h"

namespace depthmocap {

// What a perfect classifier would say, for measurements: a forest whose trees saw exactly the parts of a label image,
// whatever the facing. The forest still says which side is seen.
class KnownLabels : public PartClassifier {
 public:
  explicit KnownLabels(std::shared_ptr<const PartClassifier> forest) : forest_(std::move(forest)) {}
  // Of the next image, which has the same size; 0: any part. Must outlive the next classify().
  void setLabels(const PartImage& labels) { labels_ = &labels; }

  [[nodiscard]] std::unique_ptr<Memory> newMemory() const override { return forest_->newMemory(); }
  [[nodiscard]] bool tellsFacings() const override { return forest_->tellsFacings(); }
  void classify(const DepthImage& depth, const MaskImage& mask, const CameraModel& camera, const ClassifyConfig& config,
                Memory& memory, ClassifiedPixels& result) const override;
  void assumeFacing(const FacingShares& facing, int threads, const Memory& memory,
                    ClassifiedPixels& pixels) const override {
    forest_->assumeFacing(facing, threads, memory, pixels);
  }

 private:
  std::shared_ptr<const PartClassifier> forest_;
  const PartImage* labels_ = nullptr;
};

inline void KnownLabels::classify(const DepthImage& depth, const MaskImage& mask, const CameraModel& camera,
                                  const ClassifyConfig& config, Memory& memory, ClassifiedPixels& result) const {
  forest_->classify(depth, mask, camera, config, memory, result);
  if (labels_ == nullptr) return;
  ClassifyMemory& trees = static_cast<ForestClassifier::Memory&>(memory).votes;
  for (std::size_t i = 0; i < result.pixels.size(); ++i) {
    const int label = labels_->at(result.pixels[i].x, result.pixels[i].y);
    VoteRow votes{};
    if (label == 0) std::fill_n(votes.begin(), kPartCount, std::uint16_t{1});
    if (label != 0) votes[static_cast<std::size_t>(label - 1)] = 1;
    trees.votes[i].fill(votes);
  }
  forest_->assumeFacing(FacingShares(result.facing), config.threads, memory, result);
}

}  // namespace depthmocap
