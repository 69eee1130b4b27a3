#include "apps/plot/plot_page.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "apps/plot/chart.h"

namespace depthmocap {
namespace {

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<' || c == '>' || c == '&' || c == '"') {
      safe += fmt::format("&#{};", static_cast<int>(c));
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string ranges(const AnglePlot& plot) {
  std::string rows;
  for (const Panel& panel : plot.panels) {
    for (const Curve& curve : panel.curves) {
      double low = 1e9;
      double high = -1e9;
      for (const double value : curve.value_deg) {
        if (!std::isfinite(value)) continue;
        low = std::min(low, value);
        high = std::max(high, value);
      }
      rows += fmt::format("<tr><td>{}<td>{:.1f}<td>{:.1f}<td>{:.1f}\n", curve.name, low, high, high - low);
    }
  }
  return "<table><caption>Angles [°]</caption><tr><th>angle<th>least<th>greatest<th>range\n" + rows + "</table>\n";
}

std::string movements(const AnglePlot& plot) {
  if (plot.movements.empty()) return "<p>No steps, jumps or rising from a seat were found.</p>\n";
  std::string rows;
  for (const MovementEvent& event : plot.movements) {
    rows += fmt::format("<tr><td>{}<td>{:.2f}<td>{:.2f}\n", kMovementNames[static_cast<std::size_t>(event.kind)],
                        event.start_s, event.end_s - event.start_s);
  }
  return "<table><caption>Movements [s]</caption><tr><th>what<th>at<th>for\n" + rows + "</table>\n";
}

}  // namespace

std::string plotPage(const AnglePlot& plot) {
  const std::string svg = chartSvg(plot);
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>{0}</title>\n"
      "<style>body{{font:15px sans-serif;color:#262b33;margin:1em auto;max-width:1280px;padding:0 1em}}"
      "svg{{width:100%;height:auto}}table{{border-collapse:collapse;display:inline-table;margin:1em 2em 1em 0;"
      "vertical-align:top}}caption{{text-align:left;font-weight:bold}}td,th{{text-align:right;padding:.15em .8em;"
      "border-bottom:1px solid #dde}}td:first-child,th:first-child{{text-align:left;padding-left:0}}</style>\n"
      "{1}\n{2}{3}</html>\n",
      escaped(plot.title), svg.substr(svg.find("<svg")), movements(plot), ranges(plot));
}

}  // namespace depthmocap
