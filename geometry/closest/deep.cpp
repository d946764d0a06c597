// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/deep.hpp"

#include "geometry/base/lexicographic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plekton::geometry {
namespace {

using Corners = std::span<const Vec3>;

/// Vectors along the sides of a core (m), without those that have no length.
struct Sides {
  std::array<Vec3, 3> along;
  std::size_t count = 0;

  explicit Sides(Corners x) {
    const std::size_t sides = x.size() == 3 ? 3 : x.size() - 1;
    for (std::size_t k = 0; k < sides; ++k) {
      const Vec3 u = x[(k + 1) % x.size()] - x[k];
      const double length = u.stableNorm();
      if (length > 0.0) along[count++] = u / length;
    }
  }
};

/// A direction across two unit vectors. The cross product of nearly parallel ones is mostly
/// rounding error, which may lead along them; what it has of either is taken off.
Vec3 across(const Vec3& u, const Vec3& v) {
  Vec3 n = u.cross(v);
  const double length = n.stableNorm();
  if (!(length > 0.0)) return Vec3::Zero();
  n /= length;
  for (int pass = 0; pass < 2; ++pass) {
    n -= n.dot(u) * u;
    n -= n.dot(v) * v;
  }
  return n;
}

class Search {
 public:
  Search(Corners a, Corners b, const Vec3& side) : a_(a), b_(b), side_(side) {}

  /// Tries a direction, of any length but zero, both ways.
  void offer(const Vec3& direction) {
    const double length = direction.stableNorm();
    if (!(length > 0.0)) return;
    const Vec3 unit = direction / length;
    offer_one_way(unit);
    offer_one_way(-unit);
  }
  const DeepSeparation& best() const { return best_; }
  bool is_empty() const { return !std::isfinite(best_.depth); }

 private:
  /// How far b has to go along n until all of it is beyond all of a.
  double depth(const Vec3& n) const {
    double front_of_a = -std::numeric_limits<double>::infinity();
    double back_of_b = std::numeric_limits<double>::infinity();
    for (const Vec3& x : a_) front_of_a = std::max(front_of_a, n.dot(x - a_[0]));
    for (const Vec3& x : b_) back_of_b = std::min(back_of_b, n.dot(x - a_[0]));
    return std::max(front_of_a - back_of_b, 0.0);
  }

  void offer_one_way(const Vec3& n) {
    const double found = depth(n);
    const bool is_better = found < best_.depth || (found == best_.depth && is_preferred(n));
    if (is_better) best_ = {n, found};
  }

  /// On the asked side, or, where that does not say, the one with the first positive component.
  bool is_preferred(const Vec3& n) const {
    const double now = side_.dot(best_.direction);
    const double then = side_.dot(n);
    if (now != then) return then > now;
    return lexicographically_less(best_.direction, n);
  }

  Corners a_;
  Corners b_;
  const Vec3& side_;
  DeepSeparation best_{Vec3::UnitZ(), std::numeric_limits<double>::infinity()};
};

}  // namespace

DeepSeparation deep_separation(std::span<const Vec3> a, std::span<const Vec3> b,
                               const Vec3& side) noexcept {
  const Sides of_a(a);
  const Sides of_b(b);
  Search search(a, b, side);
  if (of_a.count > 1) search.offer(across(of_a.along[0], of_a.along[1]));
  if (of_b.count > 1) search.offer(across(of_b.along[0], of_b.along[1]));
  for (std::size_t i = 0; i < of_a.count; ++i) {
    for (std::size_t k = 0; k < of_b.count; ++k) search.offer(across(of_a.along[i], of_b.along[k]));
  }
  if (search.is_empty() && of_a.count > 0) search.offer(of_a.along[0].unitOrthogonal());
  if (search.is_empty() && of_b.count > 0) search.offer(of_b.along[0].unitOrthogonal());
  if (search.is_empty()) search.offer(Vec3::UnitZ());
  return search.best();
}

}  // namespace plekton::geometry
