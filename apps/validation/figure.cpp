// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/figure.hpp"

#include "apps/pictures/drawn_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

namespace plekton::apps {
namespace {

// Pixels of the frame of the axes in a picture.
constexpr double kWidth = 760.0;
constexpr double kHeight = 380.0;
constexpr double kLeft = 90.0;
constexpr double kRight = 740.0;
constexpr double kLegend = 34.0;  // middle of its first row
constexpr double kRow = 18.0;
constexpr std::size_t kInRow = 3;
constexpr double kBottom = 320.0;

constexpr std::array<std::string_view, 9> kColours = {"#08519c", "#cb181d", "#238b45",
                                                      "#6a51a3", "#d94801", "#525252",
                                                      "#4292c6", "#ef6548", "#74c476"};

struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void take(const std::vector<double>& values) {
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  /// Out to round numbers; a span without width gets one.
  void round() {
    if (!(low <= high)) *this = {0.0, 1.0};
    if (low == high) {
      const double around = low == 0.0 ? 1.0 : 0.1 * std::abs(low);
      low -= around;
      high += around;
    }
    const std::vector<double> ticks = ticks_of(low, high);
    const double step = ticks[1] - ticks[0];
    low = ticks.front() > low ? ticks.front() - step : ticks.front();
    high = ticks.back() < high ? ticks.back() + step : ticks.back();
  }
};

class SvgWriter {
 public:
  explicit SvgWriter(const Figure& figure) : figure_(figure) {
    for (const Curve& curve : figure.curves) {
      x_.take(curve.x);
      y_.take(curve.y);
    }
    x_.round();
    y_.round();
    const std::size_t rows = (figure.curves.size() + kInRow - 1) / kInRow;
    top_ = kLegend + 10.0 + kRow * static_cast<double>(std::max<std::size_t>(rows, 1) - 1);
  }

  std::string write() {
    svg_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" role=\"img\" "
        "font-family=\"sans-serif\" font-size=\"13\" fill=\"#222\">\n"
        "<rect width=\"{}\" height=\"{}\" fill=\"white\"/>\n",
        kWidth, kHeight, kWidth, kHeight);
    add_text(0.5 * (kLeft + kRight), 18.0, figure_.title, "middle", " font-weight=\"bold\"");
    add_axes();
    for (std::size_t i = 0; i < figure_.curves.size(); ++i) add_curve(figure_.curves[i], i);
    add_legend();
    return svg_ + "</svg>\n";
  }

 private:
  double px(double x) const { return kLeft + (x - x_.low) / (x_.high - x_.low) * (kRight - kLeft); }
  double py(double y) const {
    return kBottom - (y - y_.low) / (y_.high - y_.low) * (kBottom - top_);
  }

  void add_text(double x, double y, const std::string& text, std::string_view anchor,
                std::string_view more = "") {
    svg_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                        anchor, more, html_text(text));
  }

  void add_line(double x0, double y0, double x1, double y1, std::string_view look) {
    svg_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x0,
                        y0, x1, y1, look);
  }

  void add_axes() {
    constexpr std::string_view kGrid = "stroke=\"#ddd\"";
    for (const double tick : ticks_of(x_.low, x_.high)) {
      add_line(px(tick), top_, px(tick), kBottom, kGrid);
      add_text(px(tick), kBottom + 18.0, fmt::format("{:.4g}", tick), "middle");
    }
    for (const double tick : ticks_of(y_.low, y_.high)) {
      add_line(kLeft, py(tick), kRight, py(tick), kGrid);
      add_text(kLeft - 8.0, py(tick) + 4.0, fmt::format("{:.4g}", tick), "end");
    }
    svg_ += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#222\"/>\n",
        kLeft, top_, kRight - kLeft, kBottom - top_);
    add_text(0.5 * (kLeft + kRight), kBottom + 40.0, figure_.x_head, "middle");
    const double middle = 0.5 * (top_ + kBottom);
    add_text(20.0, middle, figure_.y_head, "middle",
             fmt::format(" transform=\"rotate(-90 20 {})\"", middle));
  }

  void add_curve(const Curve& curve, std::size_t number) {
    const std::string_view colour = kColours[number % kColours.size()];
    std::string points;
    const std::size_t most = curve.style == CurveStyle::points ? 60 : 3000;
    for (const std::size_t i : drawn_rows(curve.x, curve.y, most)) {
      if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) continue;
      if (curve.style == CurveStyle::points) {
        svg_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n",
                            px(curve.x[i]), py(curve.y[i]), colour);
      } else {
        points += fmt::format("{:.1f},{:.1f} ", px(curve.x[i]), py(curve.y[i]));
      }
    }
    if (!points.empty())
      svg_ += fmt::format(
          "<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"2\"{} points=\"{}\"/>\n", colour,
          dashes(curve), points);
  }

  static std::string_view dashes(const Curve& curve) {
    return curve.style == CurveStyle::dashed ? " stroke-dasharray=\"7 5\"" : "";
  }

  /// In rows above the axes.
  void add_legend() {
    const std::size_t columns = std::clamp<std::size_t>(figure_.curves.size(), 1, kInRow);
    const double width = (kRight - kLeft) / static_cast<double>(columns);
    for (std::size_t i = 0; i < figure_.curves.size(); ++i) {
      const Curve& curve = figure_.curves[i];
      const std::string_view colour = kColours[i % kColours.size()];
      const double x = kLeft + width * static_cast<double>(i % columns);
      const double y = kLegend + kRow * static_cast<double>(i / columns);
      if (curve.style == CurveStyle::points)
        svg_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n", x + 13.0,
                            y, colour);
      else
        add_line(x, y, x + 26.0, y,
                 fmt::format("stroke=\"{}\" stroke-width=\"2\"{}", colour, dashes(curve)));
      add_text(x + 32.0, y + 4.0, curve.name, "start");
    }
  }

  const Figure& figure_;
  Span x_;
  Span y_;
  double top_ = 0.0;  // of the axes
  std::string svg_;
};

}  // namespace

std::vector<double> ticks_of(double low, double high) {
  // Powers of ten by products, which are the same everywhere.
  double unit = 1.0;
  const double raw = (high - low) / 5.0;
  while (unit > raw) unit /= 10.0;
  while (unit * 10.0 <= raw) unit *= 10.0;
  double step = unit;
  for (const double factor : {2.0, 5.0, 10.0})
    if (factor * unit <= 1.3 * raw) step = factor * unit;
  std::vector<double> ticks;
  const double first = std::ceil(low / step - 1e-9);
  for (double i = first; i * step <= high + 1e-9 * step; ++i) ticks.push_back(i * step + 0.0);
  return ticks;
}

std::string html_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string svg_of(const Figure& figure) {
  return SvgWriter(figure).write();
}

}  // namespace plekton::apps
