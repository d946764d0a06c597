// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/grains/size_curve.hpp"

#include "apps/grains/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace plekton::apps::size_curve_test {
namespace {

const std::vector<Sieve> kSieves = {{0.006, 0.0}, {0.008, 0.3}, {0.010, 0.3}, {0.016, 1.0}};

double volume(double d) {
  return std::numbers::pi / 6.0 * d * d * d;
}

/// Share of the volume (or number) of grains below a diameter.
double share_below(const std::vector<double>& diameters, double size, PassingBy by) {
  double below = 0.0, total = 0.0;
  for (const double d : diameters) {
    const double weight = by == PassingBy::mass ? volume(d) : 1.0;
    total += weight;
    if (d <= size) below += weight;
  }
  return below / total;
}

TEST(SizeCurve, IsFollowedByItsSampleByMassAndByNumber) {
  for (const PassingBy by : {PassingBy::mass, PassingBy::number}) {
    Random random(1);
    const std::vector<double> diameters = SizeCurve(kSieves, by).draw(4000, random);

    // Each of the 4000 parts of the curve holds one grain, so the count below a sieve is off by one
    // grain at most; by mass that is the mass of the largest grain over the total.
    const double total = std::accumulate(diameters.begin(), diameters.end(), 0.0,
                                         [](double sum, double d) { return sum + volume(d); });
    const double count_error = 1.0 / 4000.0;
    const double mass_error = 2.0 * volume(0.016) / total;
    const double tolerance = by == PassingBy::number ? count_error : mass_error;
    EXPECT_NEAR(share_below(diameters, 0.007, by), 0.15, tolerance);
    EXPECT_NEAR(share_below(diameters, 0.008, by), 0.3, tolerance);
    EXPECT_NEAR(share_below(diameters, 0.010, by), 0.3, tolerance);
    EXPECT_NEAR(share_below(diameters, 0.013, by), 0.65, tolerance);
  }
}

TEST(SizeCurve, KnowsTheMeanVolumeOfItsSample) {
  for (const PassingBy by : {PassingBy::mass, PassingBy::number}) {
    Random random(2);
    const SizeCurve curve(kSieves, by);
    const std::vector<double> diameters = curve.draw(20000, random);

    double mean = 0.0;
    for (const double d : diameters) mean += volume(d) / 20000.0;

    EXPECT_NEAR(mean, curve.mean_volume(), volume(0.016) / 20000.0);  // one part of the curve
  }
}

TEST(SizeCurve, DrawsTheLargestFirstAndNothingOutsideTheTable) {
  Random random(3);
  const std::vector<double> diameters = SizeCurve(kSieves, PassingBy::mass).draw(1000, random);

  EXPECT_TRUE(std::is_sorted(diameters.rbegin(), diameters.rend()));
  EXPECT_LE(diameters.front(), 0.016);
  EXPECT_GE(diameters.back(), 0.006);
  EXPECT_EQ(std::count_if(diameters.begin(), diameters.end(),
                          [](double d) { return d > 0.008 && d < 0.010; }),
            0);
}

TEST(SizeCurve, OfOneSizeGivesItExactly) {
  Random random(4);
  EXPECT_EQ(SizeCurve(0.01).draw(3, random), (std::vector<double>{0.01, 0.01, 0.01}));
  EXPECT_DOUBLE_EQ(SizeCurve(0.01).mean_volume(), volume(0.01));
}

TEST(SizeCurve, IsContinuousInTheShare) {
  const SizeCurve curve(std::vector<Sieve>{{1.0, 0.0}, {2.0, 0.5}, {4.0, 1.0}}, PassingBy::mass);
  double before = curve.diameter_at(0.0);
  EXPECT_EQ(before, 1.0);
  for (int i = 1; i <= 1000; ++i) {
    const double diameter = curve.diameter_at(i / 1000.0);
    EXPECT_GE(diameter, before);
    before = diameter;
  }
  EXPECT_EQ(before, 4.0);
}

}  // namespace
}  // namespace plekton::apps::size_curve_test
