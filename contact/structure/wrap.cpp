// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/structure/wrap.hpp"

#include <bit>
#include <cmath>
#include <numbers>

namespace plekton::contact::structure {
namespace {

constexpr std::size_t kPlaces = 16;

/// Gauss-Legendre rule on [0, 1], and the derivative at its places of the polynomial through values
/// there. Newton's method from Tricomi's guess, Abramowitz & Stegun (1964) 22.16.6, 25.4.29;
/// barycentric differentiation, Berrut & Trefethen, SIAM Review 46 (2004), 9.3.
struct Rule {
  std::array<double, kPlaces> place;
  std::array<double, kPlaces> weight;
  std::array<std::array<double, kPlaces>, kPlaces> slope;  ///< by value, then by place

  Rule() {
    for (std::size_t i = 0; i < kPlaces; ++i) find_place(i);
    std::array<double, kPlaces> barycentric;
    for (std::size_t i = 0; i < kPlaces; ++i) {
      barycentric[i] = 1.0;
      for (std::size_t k = 0; k < kPlaces; ++k)
        if (k != i) barycentric[i] /= place[i] - place[k];
    }
    for (std::size_t i = 0; i < kPlaces; ++i) {
      slope[i][i] = 0.0;
      for (std::size_t k = 0; k < kPlaces; ++k) {
        if (k == i) continue;
        slope[k][i] = barycentric[k] / barycentric[i] / (place[i] - place[k]);
        slope[i][i] -= slope[k][i];
      }
    }
  }

 private:
  void find_place(std::size_t i) {
    constexpr double kCount = kPlaces;
    double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (kCount + 0.5));
    double by_x = 0.0;
    for (int sweep = 0; sweep < 8; ++sweep) {
      double last = 1.0, value = x;
      for (std::size_t n = 2; n <= kPlaces; ++n) {
        const double order = static_cast<double>(n);
        const double next = ((2.0 * order - 1.0) * x * value - (order - 1.0) * last) / order;
        last = value;
        value = next;
      }
      by_x = kCount * (x * value - last) / (x * x - 1.0);
      x -= value / by_x;
    }
    place[i] = 0.5 * (1.0 - x);
    weight[i] = 1.0 / ((1.0 - x * x) * by_x * by_x);
  }
};

const Rule& rule() {
  static const Rule kRule;
  return kRule;
}

/// f and its derivative, see the header; x > 0.
struct Returned {
  double share;
  double slope;
};
Returned returned(double x) {
  const double xx = x * x;
  const double sum = xx + kBend * kBend;
  return {x * xx / sum, xx * (xx + 3.0 * kBend * kBend) / (sum * sum)};
}

}  // namespace

namespace {

/// The sum of atan(y / t) over all arms, t > 0. Of two, which is what most joints have, by one
/// call: it is the argument of (t + i y1) (t + i y2).
double sum_of_angles(std::span<const double> feet, double t) {
  if (feet.size() == 2) return std::atan2(t * (feet[0] + feet[1]), t * t - feet[0] * feet[1]);
  double sum = 0.0;
  for (const double y : feet) sum += std::atan2(y, t);
  return sum;
}

using Values = std::array<double, kPlaces>;

/// The sum that stands for W, and its derivatives.
struct Sum {
  double energy = 0.0;      ///< J
  double by_squared = 0.0;  ///< N/m, by d^2
};

/// With t = T g^2, T^2 = range^2 - d^2, the integral is that of f(x) (-dphi/dg) over g from 0 to 1.
/// phi stands for the polynomial through its values at the places of the rule: so the derivative of
/// the sum, which is what is stored, needs that of phi alone, whatever the law.
/// @param feet  m, y of all arms
/// @param by_feet  gets the derivatives (N) by them
Sum integrate(double squared, std::span<const double> feet, const NormalSpring& spring,
              std::span<double> by_feet) {
  const double longest_squared = spring.range() * spring.range() - squared;
  const double longest = std::sqrt(longest_squared);
  const Rule& of = rule();
  Values share{}, by_x{}, tangent{};
  for (std::size_t i = 0; i < kPlaces; ++i) {
    tangent[i] = longest * of.place[i] * of.place[i];
    const double x = sum_of_angles(feet, tangent[i]) / std::numbers::pi;
    if (!(x > 0.0)) continue;
    const Returned back = returned(x);
    share[i] = of.weight[i] * back.share;
    by_x[i] = of.weight[i] * back.slope;
  }
  Sum sum;
  Values falls{};  // J, -dphi/dg
  for (std::size_t k = 0; k < kPlaces; ++k) {
    const double level = std::sqrt(squared + tangent[k] * tangent[k]);
    const double energy = spring.energy(level);
    double factor = 0.0;
    for (std::size_t i = 0; i < kPlaces; ++i) {
      falls[i] -= of.slope[k][i] * energy;
      factor -= share[i] * of.slope[k][i];
    }
    sum.energy += factor * energy;
    // s^2 = d^2 + (range^2 - d^2) g^4.
    const double g2 = of.place[k] * of.place[k];
    sum.by_squared -= factor * spring.force(level) * (1.0 - g2 * g2) / (2.0 * level);
  }
  for (std::size_t m = 0; m < feet.size(); ++m) {
    const double y = feet[m];
    double by_y = 0.0;
    for (std::size_t i = 0; i < kPlaces; ++i) {
      const double t = tangent[i];
      by_y += t * by_x[i] * falls[i] / (t * t + y * y);
    }
    by_feet[m] = by_y / std::numbers::pi;
    sum.by_squared += by_feet[m] * y / (2.0 * longest_squared);  // dt/d(d^2) = -t / (2 T^2)
  }
  return sum;
}

}  // namespace

WrapEnergy wrap_energy(const Vec3& separation, std::span<const Vec3> arms,
                       const NormalSpring& spring, std::span<Vec3> by_arms) {
  for (Vec3& by_arm : by_arms) by_arm.setZero();
  std::array<double, kMostArms> feet, by_feet, length;
  double sum_of_feet = 0.0;
  for (std::size_t m = 0; m < arms.size(); ++m) {
    length[m] = arms[m].norm();
    feet[m] = -separation.dot(arms[m]) / length[m];
    sum_of_feet += feet[m];
  }
  const double squared = separation.squaredNorm();
  // Of two arms the sign of x is that of the sum at all levels.
  if ((arms.size() == 2 && !(sum_of_feet > 0.0)) || !(squared < spring.range() * spring.range()))
    return {};
  const Sum sum =
      integrate(squared, {feet.data(), arms.size()}, spring, {by_feet.data(), arms.size()});
  WrapEnergy wrap{sum.energy, 2.0 * sum.by_squared * separation};
  for (std::size_t m = 0; m < arms.size(); ++m) {
    const Vec3 along = arms[m] / length[m];
    wrap.by_separation -= by_feet[m] * along;
    by_arms[m] = -by_feet[m] / length[m] * (separation + feet[m] * along);
  }
  return wrap;
}

namespace {

/// The separation is perpendicular to the facet.
Vec3 from_face(const Vec3& by_separation, const Simplex& facet, const Foot& foot,
               std::array<Vec3, 3>& on_other) {
  const Vec3 area_normal = area_normal_of(facet);
  const double area = area_normal.norm();
  const Vec3 normal = area_normal / area;
  const Vec3 along_normal = by_separation.dot(normal) * normal;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 opposite = facet.x[(k + 2) % 3] - facet.x[(k + 1) % 3];
    const Vec3 by_weight = normal.cross(opposite) / area;  // 1/m, slope of the weight
    on_other[k] += foot.weights[static_cast<int>(k)] * along_normal +
                   by_separation.dot(by_weight) * foot.separation;
  }
  return -along_normal;
}

/// The separation is perpendicular to the edge between two corners.
Vec3 from_edge(const Vec3& by_separation, const Simplex& other, std::array<std::size_t, 2> ends,
               const Foot& foot, std::array<Vec3, 3>& on_other) {
  const Vec3 edge = other.x[ends[1]] - other.x[ends[0]];
  const double length = edge.norm();
  const Vec3 along = edge / length;
  const double by_turn = by_separation.dot(along) / length;
  const Vec3 across = by_separation - by_separation.dot(along) * along;
  for (const std::size_t end : ends) on_other[end] += foot.weights[static_cast<int>(end)] * across;
  on_other[ends[0]] -= by_turn * foot.separation;
  on_other[ends[1]] += by_turn * foot.separation;
  return -across;
}

}  // namespace

Vec3 separating_forces(const Vec3& by_separation, const Simplex& other, const Foot& foot,
                       std::array<Vec3, 3>& on_other) {
  const int count = std::popcount(foot.corners);
  if (count == 3) return from_face(by_separation, other, foot, on_other);
  const auto first = static_cast<std::size_t>(std::countr_zero(foot.corners));
  if (count == 2) {
    const auto last = static_cast<std::size_t>(std::bit_width(foot.corners)) - 1;
    return from_edge(by_separation, other, {first, last}, foot, on_other);
  }
  on_other[first] += by_separation;
  return -by_separation;
}

}  // namespace plekton::contact::structure
