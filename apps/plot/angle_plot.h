#pragma once
#include <string>
#include <vector>

#include "libtracker/clinical/movement_events.h"

namespace depthmocap {

// One angle over time.
struct Curve {
  enum class Whose { Left, Right, Middle };
  std::string name;
  Whose whose = Whose::Middle;
  std::vector<double> value_deg;       // NaN where there is none
  std::vector<double> half_width_deg;  // of the band
};

// Curves that are shown together.
struct Panel {
  std::string title;
  std::vector<Curve> curves;
};

struct AnglePlot {
  std::string title;
  std::vector<double> time_s;
  std::vector<Panel> panels;
  std::vector<MovementEvent> movements;
};

// The panels that `names` ask for: angles by their names, where those of sides may leave the side out ("knee_flexion");
// empty: those of most use. Panels without a value are left out; Error for an unknown name, and where nothing is left.
AnglePlot anglePlot(const std::vector<AnglesRow>& rows, const std::vector<std::string>& names,
                    const std::string& title);

// Half the width of the band [deg] where the least confidence of the joints concerned is `confidence`: a guide to how
// far an angle may be off, from about the mean error where all is seen to a wide guess where nothing is.
double bandHalfWidthDeg(double confidence);

}  // namespace depthmocap
