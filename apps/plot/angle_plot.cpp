#include "apps/plot/angle_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/nearest_name.h"

namespace depthmocap {
namespace {

const std::vector<std::string> kUsual = {"pelvis_tilt",      "trunk_flexion",      "hip_flexion",
                                         "hip_abduction",    "knee_flexion",       "ankle_dorsiflexion",
                                         "shoulder_flexion", "shoulder_abduction", "elbow_flexion"};

constexpr double kSureHalfWidth_deg = 5.0;  // [deg] the mean error of angles on rendered people, docs/lab/accuracy.md
constexpr double kUnsureHalfWidth_deg = 20.0;  // [deg] chosen, not measured: a joint that is not seen

std::vector<std::string> panelNames() {
  std::vector<std::string> names;
  for (const std::string_view angle : kClinicalAngleNames) {
    const std::size_t from = angle.starts_with("left_") ? 5 : angle.starts_with("right_") ? 6 : 0;
    const std::string name(angle.substr(from));
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

void addCurve(const std::vector<AnglesRow>& rows, const std::string& name, Curve::Whose whose, Panel& panel) {
  const int angle = clinicalAngleIndex(name);
  if (angle < 0) return;
  Curve curve{name, whose, {}, {}};
  const int joint = clinicalJointOf(angle);
  bool any = false;
  for (const AnglesRow& row : rows) {
    const bool there = row.state != TrackState::Lost;
    curve.value_deg.push_back(there ? row.angles[angle] : std::numeric_limits<double>::quiet_NaN());
    curve.half_width_deg.push_back(bandHalfWidthDeg(row.confidence[joint]));
    any = any || std::isfinite(curve.value_deg.back());
  }
  if (any) panel.curves.push_back(std::move(curve));
}

// "knee_flexion": "Knee flexion".
std::string titled(std::string name) {
  std::ranges::replace(name, '_', ' ');
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

}  // namespace

double bandHalfWidthDeg(double confidence) {
  return kSureHalfWidth_deg + (kUnsureHalfWidth_deg - kSureHalfWidth_deg) * (1.0 - confidence);
}

AnglePlot anglePlot(const std::vector<AnglesRow>& rows, const std::vector<std::string>& asked,
                    const std::string& title) {
  AnglePlot plot{title, {}, {}, findMovements(rows)};
  for (const AnglesRow& row : rows) plot.time_s.push_back(row.time_s);
  const std::vector<std::string> known = panelNames();
  for (const std::string& name : asked.empty() ? kUsual : asked) {
    Panel panel{titled(name), {}};
    addCurve(rows, name, Curve::Whose::Middle, panel);
    addCurve(rows, "left_" + name, Curve::Whose::Left, panel);
    addCurve(rows, "right_" + name, Curve::Whose::Right, panel);
    if (!panel.curves.empty()) {
      plot.panels.push_back(std::move(panel));
    } else if (clinicalAngleIndex(name) < 0 && std::ranges::find(known, name) == known.end()) {
      throw Error(fmt::format("there is no angle '{}'", name), "--angles",
                  fmt::format("known: {}", fmt::join(known, " ")));
    }
  }
  if (plot.panels.empty()) throw Error("holds none of these angles in any frame", title);
  return plot;
}

}  // namespace depthmocap
