#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "depthmocap/parts.h"
#include "libtracker/classify/forest.h"
#include "libtracker/core/facing.h"

namespace depthmocap {

// Adds the logarithms of one pixel's votes for each facing.
void addEvidence(const std::array<VoteRow, kFacingCount>& votes, std::array<double, kFacingCount>& evidence);

// Probability of each facing from the evidence of all pixels (added in the order given) and what was known before.
FacingShares facingProbabilities(std::span<const std::array<double, kFacingCount>> evidence, std::size_t pixels,
                                 const FacingShares& prior);

// A pixel's distribution over the parts when the facings have these probabilities.
void partProbabilities(const std::array<VoteRow, kFacingCount>& votes, const FacingShares& facing,
                       std::array<float, kPartCount>& probability);

}  // namespace depthmocap
