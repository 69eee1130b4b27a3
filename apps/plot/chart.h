#pragma once
#include <string>

#include "apps/plot/angle_plot.h"

namespace depthmocap {

// The plot as a PNG or SVG file's bytes.
std::string chartPng(const AnglePlot& plot);
std::string chartSvg(const AnglePlot& plot);

}  // namespace depthmocap
