// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/pack.hpp"

#include <Eigen/Core>

#include <cmath>

namespace plekton::geometry {

/// A number that knows its derivatives by N variables (forward differentiation): a formula written
/// once gives its value and its gradient, both to round-off. Comparisons look at the value.
/// Source: Griewank & Walther, Evaluating Derivatives (2008), chapter 3.
template <int N>
struct Dual {
  using Slopes = Eigen::Array<double, N, 1, Eigen::DontAlign>;

  double value;
  Slopes slopes;

  Dual() = default;
  /// A constant.
  Dual(double x) : value(x), slopes(Slopes::Zero()) {}  // NOLINT: a number, as in a formula
  Dual(double x, const Slopes& derivatives) : value(x), slopes(derivatives) {}

  static Dual variable(double x, int which) {
    Dual dual(x);
    dual.slopes[which] = 1.0;
    return dual;
  }

  friend Dual operator+(const Dual& x, const Dual& y) {
    return {x.value + y.value, x.slopes + y.slopes};
  }
  friend Dual operator-(const Dual& x, const Dual& y) {
    return {x.value - y.value, x.slopes - y.slopes};
  }
  friend Dual operator-(const Dual& x) { return {-x.value, -x.slopes}; }
  friend Dual operator*(const Dual& x, const Dual& y) {
    return {x.value * y.value, x.slopes * y.value + y.slopes * x.value};
  }
  friend Dual operator*(double x, const Dual& y) { return {x * y.value, x * y.slopes}; }
  friend Dual operator*(const Dual& x, double y) { return y * x; }
  friend Dual operator/(const Dual& x, const Dual& y) {
    const double quotient = x.value / y.value;
    return {quotient, (x.slopes - quotient * y.slopes) / y.value};
  }
  friend bool operator<(const Dual& x, const Dual& y) { return x.value < y.value; }
  friend bool operator>(const Dual& x, const Dual& y) { return x.value > y.value; }
};

template <int N>
PackVec3<Dual<N>> operator*(double x, const PackVec3<Dual<N>>& v) {
  return {x * v.x, x * v.y, x * v.z};
}

/// f(x), given f's value and derivative at x.
template <int N>
Dual<N> chain(const Dual<N>& x, double value, double derivative) {
  return {value, derivative * x.slopes};
}

/// Of a number that is not negative. At 0, where no derivative exists, it counts as constant.
template <int N>
Dual<N> square_root(const Dual<N>& x) {
  const double root = std::sqrt(x.value);
  return chain(x, root, root > 0.0 ? 0.5 / root : 0.0);
}

}  // namespace plekton::geometry
