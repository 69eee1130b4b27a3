#pragma once
#include <span>

#include "depthmocap/tracked_frame.h"

namespace depthmocap {

// Between the labels of two people in one image: the part of person k is raised by kPersonLabelStep * (k - 1).
inline constexpr int kPersonLabelStep = 16;

// Everybody's parts in one image, each person's raised by `step` times the number less one; of one person the image
// itself. `all` is working memory.
const PartImage& labelsOfAll(std::span<const TrackedFrame* const> people, int step, PartImage& all);

}  // namespace depthmocap
