// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/double_double.hpp"

#include "tests/support/seeded_random.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace plekton::geometry::double_double_test {
namespace {

using Rational = boost::multiprecision::cpp_rational;

const Rational kRoundoff(0x1p-53);

/// What a number stands for; its lower part is what its difference from the upper part leaves.
Rational value(const DoubleDouble& x) {
  return Rational(x.high()) + Rational((x - DoubleDouble(x.high())).high());
}

double any_double(test::Random& random) {
  return std::ldexp(random.uniform(-1.0, 1.0), static_cast<int>(random.uniform(-60.0, 60.0)));
}

/// Of both signs, and now and then almost cancelling another one.
DoubleDouble any_number(test::Random& random) {
  const double high = any_double(random);
  return DoubleDouble(high) + DoubleDouble(high * random.uniform(-0x1p-54, 0x1p-54));
}

TEST(DoubleDouble, HasSumsAndProductsWithinTheirBounds) {
  test::Random random(21);
  for (int i = 0; i < 20000; ++i) {
    const DoubleDouble x = any_number(random);
    const DoubleDouble y =
        i % 2 == 0 ? any_number(random) : -x * DoubleDouble(1.0 + random.uniform(-1e-20, 1e-20));
    const Rational sum = value(x) + value(y);
    const Rational product = value(x) * value(y);
    // One more square of a roundoff for value().
    EXPECT_LE(abs(value(x + y) - sum), 4 * kRoundoff * kRoundoff * abs(sum));
    EXPECT_LE(abs(value(x * y) - product), 8 * kRoundoff * kRoundoff * abs(product));
  }
}

TEST(DoubleDouble, HasExactDifferencesOfDoubles) {
  test::Random random(22);
  for (int i = 0; i < 20000; ++i) {
    const double x = any_double(random);
    const double y = any_double(random);
    EXPECT_EQ(value(DoubleDouble::difference(x, y)), Rational(x) - Rational(y));
  }
}

}  // namespace
}  // namespace plekton::geometry::double_double_test
