// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace plekton::geometry {

/// A number as the sum of two doubles that do not overlap: 106 bits. For rounding to nearest, and
/// without overflow and underflow: numbers below 1e300, products above 1e-290.
///
/// Sums are within 3 u² of their value, products within 7 u², quotients within 16 u², relative, u =
/// 2^-53; the difference and the product of two doubles are exact. Dekker, Numerische Mathematik 18
/// (1971) 224; bounds: Joldes, Muller & Popescu, ACM Trans. Math. Softw. 44 (2017) 15, algorithms
/// 6, 11 and 17.
class DoubleDouble {
 public:
  /// Zero.
  constexpr DoubleDouble() noexcept = default;
  constexpr explicit DoubleDouble(double number) noexcept : high_(number) {}
  /// @param low  at most half an ulp of high
  constexpr DoubleDouble(double high, double low) noexcept : high_(high), low_(low) {}

  /// The number, rounded.
  constexpr double high() const noexcept { return high_; }

  friend constexpr DoubleDouble operator-(const DoubleDouble& x) noexcept {
    return {-x.high_, -x.low_};
  }
  friend constexpr DoubleDouble operator+(const DoubleDouble& x, const DoubleDouble& y) noexcept {
    const DoubleDouble high = sum(x.high_, y.high_);
    const DoubleDouble low = sum(x.low_, y.low_);
    const DoubleDouble first = quick_sum(high.high_, high.low_ + low.high_);
    return quick_sum(first.high_, first.low_ + low.low_);
  }
  friend constexpr DoubleDouble operator-(const DoubleDouble& x, const DoubleDouble& y) noexcept {
    return x + -y;
  }
  friend constexpr DoubleDouble operator*(const DoubleDouble& x, const DoubleDouble& y) noexcept {
    const DoubleDouble high = product(x.high_, y.high_);
    return quick_sum(high.high_, high.low_ + (x.high_ * y.low_ + x.low_ * y.high_));
  }

  friend constexpr DoubleDouble operator/(const DoubleDouble& x, const DoubleDouble& y) noexcept {
    const double first = x.high_ / y.high_;
    const DoubleDouble rest = x - y * DoubleDouble(first);
    return quick_sum(first, rest.high_ / y.high_);
  }

  /// x - y, exactly.
  static constexpr DoubleDouble difference(double x, double y) noexcept { return sum(x, -y); }
  /// x y, exactly. Dekker and Veltkamp: halves of 26 bits have exact products.
  static constexpr DoubleDouble product(double x, double y) noexcept {
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

 private:
  /// Exact. Møller and Knuth.
  static constexpr DoubleDouble sum(double x, double y) noexcept {
    const double s = x + y;
    const double of_y = s - x;
    const double of_x = s - of_y;
    return {s, (x - of_x) + (y - of_y)};
  }
  /// Exact if |x| >= |y|. Dekker.
  static constexpr DoubleDouble quick_sum(double x, double y) noexcept {
    const double s = x + y;
    return {s, y - (s - x)};
  }

  double high_ = 0.0;
  double low_ = 0.0;
};

}  // namespace plekton::geometry
