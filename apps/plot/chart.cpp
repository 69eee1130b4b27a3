#include "apps/plot/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>

#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include "depthmocap/error.h"

namespace depthmocap {
namespace {

// Sizes [px].
constexpr int kColumns = 2;
constexpr double kPanelWidth = 620;
constexpr double kPanelHeight = 190;
constexpr double kLeft = 52, kRight = 14, kTop = 28, kBottom = 26;  // of a panel, around its axes
constexpr double kHeader = 64;
constexpr double kMargin = 10;
constexpr double kText = 12, kTitle = 16;

struct Color {
  double r, g, b;
};
constexpr Color kInk{0.15, 0.17, 0.2}, kFaint{0.85, 0.87, 0.9}, kGrey{0.45, 0.48, 0.52};
// Blue, orange and green of Okabe and Ito's palette, which colour-blind people tell apart; left, right, middle.
constexpr std::array<Color, 3> kCurves = {{{0.0, 0.447, 0.698}, {0.835, 0.369, 0.0}, {0.0, 0.62, 0.451}}};
// Steps in the colour of their side; jumps, standing up.
constexpr std::array<Color, 4> kMovements = {{kCurves[0], kCurves[1], {0.8, 0.475, 0.655}, {0.902, 0.624, 0.0}}};

class Canvas {
 public:
  explicit Canvas(cairo_surface_t* surface) : cairo_(cairo_create(surface)) {
    cairo_select_font_face(cairo_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  }
  ~Canvas() { cairo_destroy(cairo_); }
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void color(const Color& c, double alpha = 1.0) { cairo_set_source_rgba(cairo_, c.r, c.g, c.b, alpha); }
  void rectangle(double x, double y, double width, double height) {
    cairo_rectangle(cairo_, x, y, width, height);
    cairo_fill(cairo_);
  }
  void line(double x0, double y0, double x1, double y1, double width = 1.0) {
    cairo_move_to(cairo_, x0, y0);
    cairo_line_to(cairo_, x1, y1);
    cairo_set_line_width(cairo_, width);
    cairo_stroke(cairo_);
  }
  // `anchor`: 0 begins at x, 0.5 is centred, 1 ends there.
  void text(const std::string& words, double x, double y, double size, double anchor = 0) {
    cairo_set_font_size(cairo_, size);
    cairo_move_to(cairo_, x - anchor * width(words, size), y);
    cairo_show_text(cairo_, words.c_str());
  }
  double width(const std::string& words, double size) {
    cairo_set_font_size(cairo_, size);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_, words.c_str(), &extents);
    return extents.x_advance;
  }
  [[nodiscard]] cairo_t* raw() const { return cairo_; }

 private:
  cairo_t* cairo_;
};

// A round step that gives at most `most` ticks over a range: 1, 2 or 5 times a power of ten.
double tickStep(double range, int most) {
  const double least = range / most;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least) return factor * power;
  }
  return 10.0 * power;
}

// One panel: from seconds and degrees to pixels.
class PanelView {
 public:
  PanelView(const AnglePlot& plot, const Panel& panel, double x, double y) : plot_(plot), panel_(panel), x_(x), y_(y) {
    t0_ = plot.time_s.front();
    t1_ = std::max(plot.time_s.back(), t0_ + 1e-3);
    for (const Curve& curve : panel.curves) {
      for (const double value : curve.value_deg) {
        if (!std::isfinite(value)) continue;
        low_ = std::min(low_, value);
        high_ = std::max(high_, value);
      }
    }
    constexpr double kRoom_deg = 8;  // above and below the curves
    low_ -= kRoom_deg;
    high_ += kRoom_deg;
  }

  void draw(Canvas& canvas) const {
    movements(canvas);
    axes(canvas);
    cairo_save(canvas.raw());
    cairo_rectangle(canvas.raw(), x_ + kLeft, y_ + kTop, plotWidth(), plotHeight());
    cairo_clip(canvas.raw());
    for (const Curve& curve : panel_.curves) band(canvas, curve);
    for (const Curve& curve : panel_.curves) stroke(canvas, curve);
    cairo_restore(canvas.raw());
  }

 private:
  static double plotWidth() { return kPanelWidth - kLeft - kRight; }
  static double plotHeight() { return kPanelHeight - kTop - kBottom; }
  [[nodiscard]] double px(double time_s) const { return x_ + kLeft + plotWidth() * (time_s - t0_) / (t1_ - t0_); }
  [[nodiscard]] double py(double deg) const { return y_ + kTop + plotHeight() * (high_ - deg) / (high_ - low_); }

  void movements(Canvas& canvas) const {
    const double top = y_ + kTop;
    for (const MovementEvent& event : plot_.movements) {
      const Color& color = kMovements[static_cast<std::size_t>(event.kind)];
      if (event.end_s > event.start_s) {
        canvas.color(color, 0.22);
        canvas.rectangle(px(event.start_s), top, px(event.end_s) - px(event.start_s), plotHeight());
      } else {
        canvas.color(color, 0.55);
        cairo_set_dash(canvas.raw(), std::array<double, 2>{3, 3}.data(), 2, 0);
        canvas.line(px(event.start_s), top, px(event.start_s), top + plotHeight());
        cairo_set_dash(canvas.raw(), nullptr, 0, 0);
      }
    }
  }

  void axes(Canvas& canvas) const {
    canvas.color(kInk);
    canvas.text(panel_.title + " [°]", x_ + kLeft, y_ + kTop - 8, kText + 1);
    const double bottom = y_ + kTop + plotHeight();
    const double deg_step = tickStep(high_ - low_, 5);
    for (double deg = std::ceil(low_ / deg_step) * deg_step; deg <= high_; deg += deg_step) {
      canvas.color(kFaint);
      canvas.line(x_ + kLeft, py(deg), x_ + kLeft + plotWidth(), py(deg));
      canvas.color(kGrey);
      canvas.text(fmt::format("{:.0f}", std::abs(deg) < 1e-9 ? 0.0 : deg), x_ + kLeft - 6, py(deg) + 4, kText - 1, 1);
    }
    const double time_step = tickStep(t1_ - t0_, 8);
    for (double t = std::ceil(t0_ / time_step) * time_step; t <= t1_ + 1e-9; t += time_step) {
      canvas.color(kGrey);
      canvas.line(px(t), bottom, px(t), bottom + 4);
      canvas.text(fmt::format("{:g} s", std::round(t * 1e6) / 1e6), px(t), bottom + 16, kText - 1, 0.5);
    }
    canvas.color(kGrey);
    canvas.line(x_ + kLeft, bottom, x_ + kLeft + plotWidth(), bottom);
  }

  // Calls `run` with each unbroken run of values, as first and past-the-last index.
  static void eachRun(const Curve& curve, const std::function<void(std::size_t, std::size_t)>& run) {
    const std::size_t count = curve.value_deg.size();
    for (std::size_t first = 0; first < count;) {
      while (first < count && !std::isfinite(curve.value_deg[first])) ++first;
      std::size_t last = first;
      while (last < count && std::isfinite(curve.value_deg[last])) ++last;
      if (last > first) run(first, last);
      first = last;
    }
  }

  void band(Canvas& canvas, const Curve& curve) const {
    canvas.color(kCurves[static_cast<std::size_t>(curve.whose)], 0.16);
    eachRun(curve, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        cairo_line_to(canvas.raw(), px(plot_.time_s[i]), py(curve.value_deg[i] + curve.half_width_deg[i]));
      }
      for (std::size_t i = last; i-- > first;) {
        cairo_line_to(canvas.raw(), px(plot_.time_s[i]), py(curve.value_deg[i] - curve.half_width_deg[i]));
      }
      cairo_close_path(canvas.raw());
      cairo_fill(canvas.raw());
    });
  }

  void stroke(Canvas& canvas, const Curve& curve) const {
    canvas.color(kCurves[static_cast<std::size_t>(curve.whose)]);
    cairo_set_line_width(canvas.raw(), 1.6);
    cairo_set_line_join(canvas.raw(), CAIRO_LINE_JOIN_ROUND);
    eachRun(curve, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        cairo_line_to(canvas.raw(), px(plot_.time_s[i]), py(curve.value_deg[i]));
      cairo_stroke(canvas.raw());
    });
  }

  const AnglePlot& plot_;
  const Panel& panel_;
  double x_, y_;
  double t0_ = 0, t1_ = 1;
  double low_ = 1e9, high_ = -1e9;
};

int rowsOf(const AnglePlot& plot) {
  return (static_cast<int>(plot.panels.size()) + kColumns - 1) / kColumns;
}

double widthOf(const AnglePlot& plot) {
  return 2 * kMargin + kPanelWidth * std::min<double>(kColumns, static_cast<double>(plot.panels.size()));
}

double heightOf(const AnglePlot& plot) {
  return kHeader + rowsOf(plot) * kPanelHeight + kMargin;
}

// What the colours mean: of curves that are there, and of movements with how many were found.
void legend(const AnglePlot& plot, Canvas& canvas) {
  double x = kMargin + kLeft;
  const double y = kHeader - 14;
  const auto entry = [&](const Color& color, double alpha, const std::string& words) {
    canvas.color(color, alpha);
    canvas.rectangle(x, y - 9, 18, 10);
    canvas.color(kInk);
    canvas.text(words, x + 24, y, kText);
    x += 24 + canvas.width(words, kText) + 20;
  };
  constexpr std::array<const char*, 3> kWhose = {"left", "right", "middle"};
  for (std::size_t whose = 0; whose < kWhose.size(); ++whose) {
    const bool shown = std::ranges::any_of(plot.panels, [&](const Panel& panel) {
      return std::ranges::any_of(panel.curves,
                                 [&](const Curve& c) { return static_cast<std::size_t>(c.whose) == whose; });
    });
    if (shown) entry(kCurves[whose], 1.0, kWhose[whose]);
  }
  for (std::size_t kind = 0; kind < kMovements.size(); ++kind) {
    const auto count = std::ranges::count(plot.movements, static_cast<MovementKind>(kind), &MovementEvent::kind);
    if (count > 0) entry(kMovements[kind], 0.4, fmt::format("{} ({})", kMovementNames[kind], count));
  }
}

void draw(const AnglePlot& plot, cairo_surface_t* surface) {
  Canvas canvas(surface);
  canvas.color({1, 1, 1});
  canvas.rectangle(0, 0, widthOf(plot), heightOf(plot));
  canvas.color(kInk);
  canvas.text(plot.title, kMargin + kLeft, 26, kTitle);
  legend(plot, canvas);
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    const double x = kMargin + static_cast<double>(i % kColumns) * kPanelWidth;
    const std::size_t row = i / kColumns;
    const double y = kHeader + static_cast<double>(row) * kPanelHeight;
    PanelView(plot, plot.panels[i], x, y).draw(canvas);
  }
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

struct Destroy {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroy>;

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error(std::string("cannot be drawn: ") + cairo_status_to_string(status), "plot");
}

}  // namespace

std::string chartPng(const AnglePlot& plot) {
  constexpr double kScale = 1.5;  // pixels of the picture for one of ours, for screens of today
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(kScale * widthOf(plot)),
                                                   static_cast<int>(kScale * heightOf(plot))));
  cairo_surface_set_device_scale(surface.get(), kScale, kScale);
  draw(plot, surface.get());
  std::string png;
  check(cairo_surface_write_to_png_stream(surface.get(), append, &png));
  return png;
}

std::string chartSvg(const AnglePlot& plot) {
  std::string svg;
  const Surface surface(cairo_svg_surface_create_for_stream(append, &svg, widthOf(plot), heightOf(plot)));
  draw(plot, surface.get());
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()));
  return svg;
}

}  // namespace depthmocap
