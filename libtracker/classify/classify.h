#pragma once
#include <array>
#include <vector>

#include "depthmocap/image.h"
#include "libtracker/classify/actor_depth.h"
#include "libtracker/classify/forest.h"
#include "libtracker/classify/part_classifier.h"
#include "libtracker/core/classified_pixels.h"

namespace depthmocap {

// Working memory of classify(), for reuse.
struct ClassifyMemory {
  ActorDepth actor;
  // The votes of the trees for each pixel: the sum of the leaves that it reached.
  std::vector<std::array<VoteRow, kFacingCount>> votes;
  std::vector<std::array<double, kFacingCount>> evidence;  // of some pixels each
};

// Classifies the pixels of the actor (mask != 0, with a measurement). `depth` and `mask` have the same size, `focal_px`
// is the camera's fx (1 .. 1e5). The same result for any number of threads. No allocation once `memory` and `result`
// have seen the largest actor.
//
// Beyond Shotton 2011: front and back of a person look much alike, and what is left from the front is right from
// behind. A pixel alone cannot decide that, but all pixels together can: leaves keep the joint distribution of part and
// facing, the image decides the facing, and each pixel's parts are taken from the distribution that fits.
void classify(const Forest& forest, const DepthImage& depth, const MaskImage& mask, double focal_px,
              const ClassifyConfig& config, ClassifyMemory& memory, ClassifiedPixels& result);
// Every pixel's distribution again, as if the facings had these probabilities (>= 0, not all 0); `memory` and `pixels`
// as the last classify() left them.
void assumeFacing(const FacingShares& facing, int threads, const ClassifyMemory& memory, ClassifiedPixels& pixels);
// classify() for a single image.
void classify(const Forest& forest, const DepthImage& depth, const MaskImage& mask, double focal_px,
              const ClassifyConfig& config, ClassifiedPixels& result);

// The definition that classify() is tested against: the same result from the plain images, pixel by pixel, slowly.
void classifyReference(const Forest& forest, const DepthImage& depth, const MaskImage& mask, double focal_px,
                       const ClassifyConfig& config, ClassifiedPixels& result);

}  // namespace depthmocap
