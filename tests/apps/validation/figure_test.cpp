// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plekton::apps::figure_test {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Ticks, AreRoundAndDivideARangeIntoAFewParts) {
  EXPECT_THAT(ticks_of(0.0, 1.0),
              testing::Pointwise(testing::DoubleNear(1e-12),
                                 std::vector<double>{0, 0.2, 0.4, 0.6, 0.8, 1}));
  for (const double size : {1e-9, 0.3, 1.0, 1.7, 2.0, 4.9, 8.0, 123.0, 7e5}) {
    const auto ticks = ticks_of(-0.3 * size, 0.7 * size);
    EXPECT_GE(ticks.size(), 4U) << size;
    EXPECT_LE(ticks.size(), 11U) << size;
    EXPECT_GE(ticks.front(), -0.3001 * size);
    EXPECT_LE(ticks.back(), 0.7001 * size);
  }
}

TEST(SvgFigure, HasHeadsTicksALegendAndNothingThatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Figure figure{"a < b",
                      "time (s)",
                      "force (N)",
                      {{"felt & told", CurveStyle::line, {0, 1, 2}, {0, nan, 4}},
                       {"theory", CurveStyle::dashed, {0, 2}, {0, 4}},
                       {"empty", CurveStyle::points, {}, {}}}};

  const std::string svg = svg_of(figure);

  for (const char* text : {"a &lt; b", "time (s)", "force (N)", "felt &amp; told", "theory",
                           "stroke-dasharray", ">2</text>", ">4</text>"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(SvgFigure, KeepsThePeaksOfLongCurves) {
  std::vector<double> x(100'000), y(x.size(), 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<double>(i);
  y[77'777] = 9.0;

  const std::string svg = svg_of({"", "", "", {{"c", CurveStyle::line, x, y}}});

  // The axis goes up to 10, from 320 px at its foot to 44 px.
  EXPECT_THAT(svg, HasSubstr(",71.6 "));
}

TEST(SvgFigure, CanBeOfConstantsAndOfNothing) {
  for (const Figure& figure :
       {Figure{"", "", "", {{"c", CurveStyle::line, {1, 2}, {3, 3}}}}, Figure{"", "", "", {}}})
    EXPECT_THAT(svg_of(figure), Not(testing::AnyOf(HasSubstr("nan"), HasSubstr("inf"))));
}

}  // namespace
}  // namespace plekton::apps::figure_test
