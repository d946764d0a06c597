// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/elementary.hpp"

#include "geometry/base/double_double.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

// Every function goes the same way. A table has its values at the multiples of 1/64, to 106 bits;
// what is left of the argument is at most about 1/80, so that its own series needs 106 bits for
// the first term alone: the rest is below 2^-13 of it, and in doubles within 2^-66.
namespace plekton::elementary {
namespace {

using Number = geometry::DoubleDouble;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

constexpr Number kHalfPi(0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54);
constexpr double kHalfPiRest = -0x1.f1976b7ed8fbcp-110;  // pi/2 - kHalfPi
constexpr Number kPi(0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53);
constexpr Number kLog2(0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56);

constexpr double kPerUnit = 64.0;  // entries of the tables

/// Below, sin(x), tan(x), asin(x) and atan(x) round to x, to a tenth of an ulp.
constexpr double kTiny = 0x1p-27;

double nearest_integer(double x) noexcept {
  return std::floor(x + 0.5);
}

// Tables, made by the compiler.

struct SineAndCosine {
  Number sine;
  Number cosine;
};

constexpr SineAndCosine sine_and_cosine_by_series(const Number& x) noexcept {
  SineAndCosine sums{Number(0.0), Number(0.0)};
  Number term(1.0);
  for (int n = 0; n < 28; ++n) {
    Number& sum = n % 2 == 0 ? sums.cosine : sums.sine;
    sum = n % 4 < 2 ? sum + term : sum - term;
    term = term * x / Number(n + 1.0);
  }
  return sums;
}

constexpr Number exponential_by_series(const Number& x) noexcept {
  Number sum(0.0), term(1.0);
  for (int n = 0; n < 26; ++n) {
    sum = sum + term;
    term = term * x / Number(n + 1.0);
  }
  return sum;
}

/// Of n / 64, to pi/4 and a little more.
constexpr auto kSinesAndCosines = [] {
  std::array<SineAndCosine, 53> table{};
  for (std::size_t n = 0; n < table.size(); ++n)
    table[n] = sine_and_cosine_by_series(Number(static_cast<double>(n) / kPerUnit));
  return table;
}();

/// Of (n - kMostLog) / 64, to log(2) / 2 and a little more, both ways.
constexpr int kMostLog = 24;
constexpr auto kExponentials = [] {
  std::array<Number, 2 * kMostLog + 1> table{};
  for (std::size_t n = 0; n < table.size(); ++n)
    table[n] = exponential_by_series(Number((static_cast<double>(n) - kMostLog) / kPerUnit));
  return table;
}();

const Number& exponential_at(double n) noexcept {
  return kExponentials[static_cast<std::size_t>(static_cast<int>(n) + kMostLog)];
}

// Functions of numbers of 106 bits.

/// @param x  rad, at most pi/4 and a little more in magnitude
SineAndCosine sine_and_cosine(const Number& x) noexcept {
  const bool is_negative = x.high() < 0.0;
  const Number size = is_negative ? -x : x;
  const double n = nearest_integer(kPerUnit * size.high());
  const SineAndCosine& known = kSinesAndCosines[static_cast<std::size_t>(n)];
  const Number rest = size - Number(n / kPerUnit);
  const double square = rest.high() * rest.high();
  const double sine_terms =
      rest.high() * square * (-1.0 / 6 + square * (1.0 / 120 - square * (1.0 / 5040)));
  const double cosine_terms =
      square * (-1.0 / 2 + square * (1.0 / 24 - square * (1.0 / 720 - square * (1.0 / 40320))));
  const Number sine_of_rest = rest + Number(sine_terms);
  const Number below(cosine_terms);  // cosine of the rest less 1
  const Number sine = known.sine + (known.cosine * sine_of_rest + known.sine * below);
  const Number cosine = known.cosine + (known.cosine * below - known.sine * sine_of_rest);
  return {is_negative ? -sine : sine, cosine};
}

/// An angle as a number of quarter turns and what is left, at most an eighth of a turn and a
/// little.
struct ReducedAngle {
  int quarters;  ///< modulo 4
  Number rest;   ///< rad
};

/// @param x  rad, reducible
ReducedAngle reduce(double x) noexcept {
  const double n = nearest_integer(x / kHalfPi.high());
  if (n == 0.0) return {0, Number(x)};
  // The first difference is exact but for the lower half of the product; n kHalfPiRest is below
  // 2^-69.
  const Number upper = Number::product(n, 0x1.921fb54442d18p+0);
  const Number lower = Number::product(n, 0x1.1a62633145c07p-54);
  const Number rest = ((Number(x) - upper) - lower) - Number(n * kHalfPiRest);
  return {static_cast<int>(static_cast<std::int64_t>(n) & 3), rest};
}

/// Whether the quotient by pi/2 still tells the nearest quarter turn, to 2^-11 of it.
bool is_reducible(double x) noexcept {
  return std::abs(x) < 0x1p40;
}

/// @param x  rad, reducible
SineAndCosine sine_and_cosine(double x) noexcept {
  const ReducedAngle angle = reduce(x);
  const auto [sine, cosine] = sine_and_cosine(angle.rest);
  switch (angle.quarters) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

/// rad, of the point (x, y), both at least 0, one of them not; neither is far above 1e150.
Number first_quadrant_angle(const Number& y, const Number& x) noexcept {
  const bool is_steep = y.high() > x.high();
  const Number& opposite = is_steep ? x : y;
  const Number& adjacent = is_steep ? y : x;
  // Within 0.004 of the angle, for which any angle of the table will do; then the tangent of the
  // rest.
  const double tangent = opposite.high() / adjacent.high();
  const double guess = tangent * (0.7854 + 0.273 * (1.0 - tangent));
  const double n = nearest_integer(kPerUnit * guess);
  const auto& [sine, cosine] = kSinesAndCosines[static_cast<std::size_t>(n)];
  const Number rest =
      n == 0.0 ? opposite / adjacent
               : (opposite * cosine - adjacent * sine) / (adjacent * cosine + opposite * sine);
  const double square = rest.high() * rest.high();
  const double terms =
      rest.high() * square *
      (-1.0 / 3 + square * (1.0 / 5 - square * (1.0 / 7 - square * (1.0 / 9 - square / 11))));
  const Number angle = Number(n / kPerUnit) + (rest + Number(terms));
  return is_steep ? kHalfPi - angle : angle;
}

/// Of a finite x > 0.
Number logarithm(double x) noexcept {
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);  // from 1/2 to 1
  if (mantissa < 0.70710678) {
    mantissa *= 2.0;
    --exponent;
  }
  // Within 0.004 of the logarithm, likewise; then that of the rest as 2 artanh.
  const double n = nearest_integer(kPerUnit * 2.0 * (mantissa - 1.0) / (mantissa + 1.0));
  const Number ratio = n == 0.0 ? Number(mantissa) : Number(mantissa) * exponential_at(-n);
  const Number half = (ratio - Number(1.0)) / (ratio + Number(1.0));
  const double square = half.high() * half.high();
  const double terms =
      2.0 * half.high() * square *
      (1.0 / 3 + square * (1.0 / 5 + square * (1.0 / 7 + square * (1.0 / 9 + square / 11))));
  const Number rest = half + half + Number(terms);
  return Number(static_cast<double>(exponent)) * kLog2 + (Number(n / kPerUnit) + rest);
}

/// e to the power of x.
double exponential(const Number& x) noexcept {
  if (x.high() > 710.0) return kInfinity;
  if (x.high() < -746.0) return 0.0;
  const double doublings = nearest_integer(x.high() / kLog2.high());
  const Number within = x - Number(doublings) * kLog2;
  const double n = nearest_integer(kPerUnit * within.high());
  const Number rest = within - Number(n / kPerUnit);
  const double r = rest.high();
  const double terms =
      r * r *
      (1.0 / 2 + r * (1.0 / 6 + r * (1.0 / 24 + r * (1.0 / 120 + r * (1.0 / 720 + r / 5040)))));
  const Number& known = exponential_at(n);
  const Number value = known + known * (rest + Number(terms));
  return std::ldexp(value.high(), static_cast<int>(doublings));
}

/// Of x >= 0.
Number square_root(const Number& x) noexcept {
  const double root = std::sqrt(x.high());
  if (root == 0.0) return Number(0.0);
  const Number rest = x - Number::product(root, root);
  return Number(root) + Number(rest.high() / (2.0 * root));
}

/// 1 for infinity, else 0; with its sign.
double infinite_part(double x) noexcept {
  return std::copysign(std::isinf(x) ? 1.0 : 0.0, x);
}

}  // namespace

double sin(double x) noexcept {
  if (std::abs(x) < kTiny) return x;
  return is_reducible(x) ? sine_and_cosine(x).sine.high() : kNan;
}

double cos(double x) noexcept {
  return is_reducible(x) ? sine_and_cosine(x).cosine.high() : kNan;
}

double tan(double x) noexcept {
  if (std::abs(x) < kTiny) return x;
  if (!is_reducible(x)) return kNan;
  const auto [sine, cosine] = sine_and_cosine(x);
  return (sine / cosine).high();
}

double asin(double x) noexcept {
  const double size = std::abs(x);
  if (size < kTiny) return x;
  if (!(size <= 1.0)) return kNan;
  const Number one(1.0), sine(size);
  const Number cosine = square_root((one - sine) * (one + sine));
  return std::copysign(first_quadrant_angle(sine, cosine).high(), x);
}

double atan(double x) noexcept {
  return atan2(x, 1.0);
}

double atan2(double y, double x) noexcept {
  if (std::isnan(x) || std::isnan(y)) return kNan;
  if (std::isinf(x) || std::isinf(y)) return atan2(infinite_part(y), infinite_part(x));
  if (y == 0.0) return std::signbit(x) ? std::copysign(kPi.high(), y) : y;
  const int exponent = std::ilogb(std::max(std::abs(x), std::abs(y)));
  const double width = std::ldexp(std::abs(x), -exponent);
  const double height = std::ldexp(std::abs(y), -exponent);
  const bool is_flat = height < kTiny * width;
  if (is_flat && x > 0.0) return y / x;
  const Number angle = first_quadrant_angle(Number(height), Number(width));
  return std::copysign((x < 0.0 ? kPi - angle : angle).high(), y);
}

double exp(double x) noexcept {
  if (std::isnan(x)) return x;
  return exponential(Number(std::clamp(x, -1000.0, 1000.0)));
}

double log(double x) noexcept {
  if (x == 0.0) return -kInfinity;
  if (!(x > 0.0)) return kNan;
  return std::isinf(x) ? x : logarithm(x).high();
}

double pow(double x, double y) noexcept {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (!(x >= 0.0) || std::isnan(y)) return kNan;
  if (x == 0.0 || std::isinf(x)) return (x == 0.0) == (y > 0.0) ? 0.0 : kInfinity;
  const Number log_x = logarithm(x);
  // Where the power overflows or vanishes, as for an infinite y, its logarithm need not be exact.
  const double rough = y * log_x.high();
  return exponential(std::abs(rough) < 1000.0 ? Number(y) * log_x : Number(rough));
}

double hypot(double x, double y) noexcept {
  if (std::isinf(x) || std::isinf(y)) return kInfinity;
  const double size = std::max(std::abs(x), std::abs(y));
  if (!(size > 0.0)) return std::abs(x) + std::abs(y);  // zero, or not a number
  if (std::isnan(x) || std::isnan(y)) return kNan;
  const int exponent = std::ilogb(size);
  const double a = std::ldexp(x, -exponent), b = std::ldexp(y, -exponent);
  return std::ldexp(square_root(Number::product(a, a) + Number::product(b, b)).high(), exponent);
}

}  // namespace plekton::elementary
