// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace plekton::apps {

/// How a curve is drawn.
enum class CurveStyle { line, dashed, points };

struct Curve {
  std::string name;
  CurveStyle style = CurveStyle::line;
  std::vector<double> x;
  std::vector<double> y;
};

/// Curves over one axis.
struct Figure {
  std::string title;
  std::string x_head;  ///< with unit, as in "position (m)"
  std::string y_head;
  std::vector<Curve> curves;
};

/// Round numbers that divide a range into four to nine parts, from its low end to its high one.
std::vector<double> ticks_of(double low, double high);

/// The figure as an <svg> element: axes with ticks, a legend, curves. Values that are not finite are
/// left out.
std::string svg_of(const Figure& figure);

/// With what would be markup written as text.
std::string html_text(const std::string& text);

}  // namespace plekton::apps
