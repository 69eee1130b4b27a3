#pragma once
#include <string>

#include "apps/plot/angle_plot.h"

namespace depthmocap {

// The plot as a page that needs nothing else: the picture as SVG, the movements and the range of each angle as tables.
std::string plotPage(const AnglePlot& plot);

}  // namespace depthmocap
