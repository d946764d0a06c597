// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/elementary.hpp"

#include "geometry/base/bit_hash.hpp"
#include "tests/support/seeded_random.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace plekton::elementary_test {
namespace {

/// 50 digits, by other algorithms than ours.
using Exact = boost::multiprecision::cpp_bin_float_50;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// From zero, in units of the last place of the result.
double error_of(double result, const Exact& exact) {
  const double ulp = std::nextafter(std::abs(result), kInfinity) - std::abs(result);
  return std::abs(static_cast<double>((Exact(result) - exact) / Exact(ulp)));
}

/// 2 to a uniform power, with a random sign.
double signed_power(test::Random& random, double low, double high) {
  return (random.coin() ? 1.0 : -1.0) * std::exp2(random.uniform(low, high));
}

struct Function {
  const char* name;
  std::function<double(double)> ours;
  std::function<Exact(Exact)> exact;
  std::function<double(test::Random&)> argument;
};

std::vector<Function> functions() {
  using test::Random;
  const auto any_angle = [](Random& random) { return signed_power(random, -40.0, 40.0); };
  const auto up_to = [](double most) {
    return [most](Random& random) { return random.uniform(-most, most); };
  };
  const auto power = [](double low, double high) {
    return [=](Random& random) { return signed_power(random, low, high); };
  };
  const auto positive = [](double low, double high) {
    return [=](Random& random) { return std::exp2(random.uniform(low, high)); };
  };
  return {
      {"sin", elementary::sin, [](Exact x) { return Exact(sin(x)); }, any_angle},
      {"cos", elementary::cos, [](Exact x) { return Exact(cos(x)); }, any_angle},
      {"tan", elementary::tan, [](Exact x) { return Exact(tan(x)); }, any_angle},
      {"sin, a turn", elementary::sin, [](Exact x) { return Exact(sin(x)); }, up_to(7.0)},
      {"cos, a turn", elementary::cos, [](Exact x) { return Exact(cos(x)); }, up_to(7.0)},
      {"asin", elementary::asin, [](Exact x) { return Exact(asin(x)); }, up_to(1.0)},
      {"asin, small", elementary::asin, [](Exact x) { return Exact(asin(x)); }, power(-40.0, 0.0)},
      {"atan", elementary::atan, [](Exact x) { return Exact(atan(x)); }, power(-40.0, 60.0)},
      {"exp", elementary::exp, [](Exact x) { return Exact(exp(x)); }, up_to(700.0)},
      {"exp, small", elementary::exp, [](Exact x) { return Exact(exp(x)); }, power(-60.0, 0.0)},
      {"log", elementary::log, [](Exact x) { return Exact(log(x)); }, positive(-1000.0, 1000.0)},
      {"log near 1", elementary::log, [](Exact x) { return Exact(log(x)); }, positive(-0.1, 0.1)},
      {"pow, of a gas", [](double x) { return elementary::pow(x, 1.4); },
       [](Exact x) { return Exact(pow(x, Exact(1.4))); }, positive(-5.0, 5.0)},
      {"pow, large", [](double x) { return elementary::pow(x, -100.7); },
       [](Exact x) { return Exact(pow(x, Exact(-100.7))); }, positive(-10.0, 10.0)},
      {"hypot", [](double x) { return elementary::hypot(x, 0.3); },
       [](Exact x) { return Exact(sqrt(x * x + Exact(0.3) * Exact(0.3))); }, power(-40.0, 40.0)},
      {"atan2, in front", [](double y) { return elementary::atan2(y, 0.3); },
       [](Exact y) { return Exact(atan2(y, Exact(0.3))); }, power(-60.0, 60.0)},
      {"atan2, behind", [](double y) { return elementary::atan2(y, -0.3); },
       [](Exact y) { return Exact(atan2(y, Exact(-0.3))); }, power(-60.0, 60.0)},
  };
}

TEST(Elementary, IsWithinTheErrorThatItStates) {
  for (const Function& function : functions()) {
    test::Random random(7);
    double largest = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const double x = function.argument(random);
      largest = std::max(largest, error_of(function.ours(x), function.exact(Exact(x))));
    }
    EXPECT_LE(largest, 0.501) << function.name;
  }
}

// Numerators of the continued fraction of pi, which are the whole numbers nearest to multiples of
// it, and roundings of such multiples: most of the angle cancels.
TEST(Elementary, IsExactNextToMultiplesOfPi) {
  for (const double x : {22.0, 355.0, 710.0, 103993.0, 312689.0, 1146408.0, 80143857.0,
                         0x1.921fb54442d18p+1, 0x1.921fb54442d18p+20}) {
    EXPECT_LE(error_of(elementary::sin(x), Exact(sin(Exact(x)))), 0.501) << x;
    EXPECT_LE(error_of(elementary::tan(x), Exact(tan(Exact(x)))), 0.501) << x;
  }
}

// The same on every processor and with every compiler: the numbers are those of a build for SSE2
// with GCC 12, and no tolerance belongs here.
TEST(Elementary, HasTheBitsThatItHasElsewhere) {
  geometry::BitHash hash;
  for (const Function& function : functions()) {
    test::Random random(11);
    for (int i = 0; i < 2000; ++i) {
      const double uniform = random.uniform(-1.0, 1.0);  // no function of the library on the way
      hash.add(function.ours(function.name[0] == 'l' || function.name[0] == 'p' ? uniform + 1.5
                                                                                : uniform));
    }
  }

  EXPECT_EQ(hash.value(), 13646770674210000613U);
}

TEST(Elementary, IsExactWhereTheResultIs) {
  EXPECT_EQ(elementary::pow(10.0, 3.0), 1000.0);
  EXPECT_EQ(elementary::pow(10.0, 22.0), 1e22);
  EXPECT_EQ(elementary::pow(0.25, 1.5), 0.125);
  EXPECT_EQ(elementary::pow(0.3, 1.0), 0.3);
  EXPECT_EQ(elementary::pow(2.0, -1074.0), 0x1p-1074);
  EXPECT_EQ(elementary::hypot(3e300, 4e300), 5e300);
  EXPECT_EQ(elementary::hypot(3e-320, 4e-320), 5e-320);
  EXPECT_EQ(elementary::exp(0.0), 1.0);
  EXPECT_EQ(elementary::log(1.0), 0.0);
  EXPECT_EQ(elementary::cos(0.0), 1.0);
  EXPECT_EQ(elementary::asin(1.0), std::acos(0.0));
}

TEST(Elementary, HasTheLimitsAndSignsOfTheCLibrary) {
  for (const double x : {0.0, -0.0, 1.0, -1.0, kInfinity, -kInfinity, 1e-320, -1e300}) {
    for (const double y : {0.0, -0.0, 1.0, -1.0, kInfinity, -kInfinity, 1e-320, -1e300}) {
      EXPECT_EQ(elementary::atan2(y, x), std::atan2(y, x)) << y << ' ' << x;
      EXPECT_EQ(std::signbit(elementary::atan2(y, x)), std::signbit(std::atan2(y, x)));
      EXPECT_EQ(elementary::hypot(y, x), std::hypot(y, x)) << y << ' ' << x;
      if (x < 0.0 || std::signbit(x)) continue;
      EXPECT_EQ(elementary::pow(x, y), std::pow(x, y)) << x << ' ' << y;
    }
  }
  EXPECT_EQ(elementary::exp(kInfinity), kInfinity);
  EXPECT_EQ(elementary::exp(-kInfinity), 0.0);
  EXPECT_EQ(elementary::exp(710.0), kInfinity);
  EXPECT_EQ(elementary::log(0.0), -kInfinity);
  EXPECT_EQ(elementary::log(kInfinity), kInfinity);
  EXPECT_TRUE(std::signbit(elementary::sin(-0.0)));
  for (const double none :
       {elementary::log(-1.0), elementary::asin(1.5), elementary::pow(-1.0, 0.5),
        elementary::sin(kInfinity), elementary::cos(0x1p40), elementary::exp(std::nan("")),
        elementary::atan2(std::nan(""), 1.0), elementary::hypot(1.0, std::nan(""))})
    EXPECT_TRUE(std::isnan(none));
}

}  // namespace
}  // namespace plekton::elementary_test
