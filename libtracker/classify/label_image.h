#pragma once
#include "depthmocap/image.h"
#include "libtracker/core/classified_pixels.h"

namespace depthmocap {

// The most probable part (index 0 .. 14, the first of equals) of a classified pixel.
int mostProbablePart(const ClassifiedPixels::Pixel& pixel);

// The most probable part of each pixel of the mask; pixels between classified ones take the nearest one's.
void labelImage(const ClassifiedPixels& pixels, const MaskImage& mask, PartImage& labels);

}  // namespace depthmocap
