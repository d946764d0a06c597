// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace plekton::geometry {

/// A number as the sum of two doubles that do not overlap: 106 bits. For rounding to nearest, and
/// without overflow and underflow: numbers below 1e300, products above 1e-290.
///
/// Sums are within 3 u² of their value, products within 7 u², relative, u = 2^-53; the difference
/// of two doubles is exact. Dekker, Numerische Mathematik 18 (1971) 224; bounds: Joldes, Muller &
/// Popescu, ACM Trans. Math. Softw. 44 (2017) 15, algorithms 6 and 11.
class DoubleDouble {
 public:
  explicit DoubleDouble(double number) noexcept : high_(number) {}

  double high() const noexcept { return high_; }

  friend DoubleDouble operator-(const DoubleDouble& x) noexcept { return {-x.high_, -x.low_}; }
  friend DoubleDouble operator+(const DoubleDouble& x, const DoubleDouble& y) noexcept {
    const DoubleDouble high = sum(x.high_, y.high_);
    const DoubleDouble low = sum(x.low_, y.low_);
    const DoubleDouble first = quick_sum(high.high_, high.low_ + low.high_);
    return quick_sum(first.high_, first.low_ + low.low_);
  }
  friend DoubleDouble operator-(const DoubleDouble& x, const DoubleDouble& y) noexcept {
    return x + -y;
  }
  friend DoubleDouble operator*(const DoubleDouble& x, const DoubleDouble& y) noexcept {
    const DoubleDouble high = product(x.high_, y.high_);
    return quick_sum(high.high_, high.low_ + (x.high_ * y.low_ + x.low_ * y.high_));
  }

  /// x - y, exactly.
  static DoubleDouble difference(double x, double y) noexcept { return sum(x, -y); }

 private:
  DoubleDouble(double high, double low) noexcept : high_(high), low_(low) {}

  /// Exact. Møller and Knuth.
  static DoubleDouble sum(double x, double y) noexcept {
    const double s = x + y;
    const double of_y = s - x;
    const double of_x = s - of_y;
    return {s, (x - of_x) + (y - of_y)};
  }
  /// Exact if |x| >= |y|. Dekker.
  static DoubleDouble quick_sum(double x, double y) noexcept {
    const double s = x + y;
    return {s, y - (s - x)};
  }
  /// Exact. Dekker and Veltkamp: halves of 26 bits have exact products.
  static DoubleDouble product(double x, double y) noexcept {
    const auto upper_half = [](double number) {
      const double scaled = 134217729.0 * number;  // 2^27 + 1
      return scaled - (scaled - number);
    };
    const double p = x * y;
    const double xh = upper_half(x);
    const double yh = upper_half(y);
    const double xl = x - xh;
    const double yl = y - yh;
    return {p, ((xh * yh - p) + xh * yl + xl * yh) + xl * yl};
  }

  double high_;
  double low_ = 0.0;
};

}  // namespace plekton::geometry
