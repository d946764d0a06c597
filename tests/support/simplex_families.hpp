// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/seeded_random.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

/// Families of pairs of points, segments and triangles that are hard for floating-point arithmetic.
namespace plekton::test {

template <std::size_t kCountA, std::size_t kCountB>
struct SimplexPair {
  std::array<Vec3, kCountA> a;
  std::array<Vec3, kCountB> b;
};

enum class PairFamily {
  generic,
  distant,
  near_parallel,      ///< sides and faces parallel up to 1e-16 to 1e-3
  parallel_far_away,  ///< the same at 1e6
  length_ratio,       ///< one is 1e-6 to 1e6 times the other
  needles,            ///< one side 1e-9 to 1e-3 of the others
  caps,               ///< one corner 1e-9 to 1e-3 off the opposite side
  coplanar,           ///< in one plane, up to 1e-17 to 1e-8 or exactly
  touching,           ///< a corner of one on the other, up to rounding, or a common corner
  crossing,           ///< a corner of one behind the face of the other
  small_gap,          ///< a distance of 1e-12 to 1e-4 of the size
  tiny,               ///< size 1e-9
  slightly_crossed,   ///< sides over each other, at an angle of 1e-9 to 1e-2
  integer_grid,
  degenerate,  ///< collinear or coincident corners
};
inline constexpr std::array kPairFamilies{PairFamily::generic,
                                          PairFamily::distant,
                                          PairFamily::near_parallel,
                                          PairFamily::parallel_far_away,
                                          PairFamily::length_ratio,
                                          PairFamily::needles,
                                          PairFamily::caps,
                                          PairFamily::coplanar,
                                          PairFamily::touching,
                                          PairFamily::crossing,
                                          PairFamily::small_gap,
                                          PairFamily::tiny,
                                          PairFamily::slightly_crossed,
                                          PairFamily::integer_grid,
                                          PairFamily::degenerate};
inline constexpr std::array kPairFamilyNames{
    "generic",   "distant", "near parallel",    "parallel at 1e6", "length ratio",
    "needles",   "caps",    "coplanar",         "touching",        "crossing",
    "small gap", "tiny",    "slightly crossed", "integer grid",    "degenerate"};

template <std::size_t kCountA, std::size_t kCountB>
class SimplexFamilies {
 public:
  using Pair = SimplexPair<kCountA, kCountB>;

  explicit SimplexFamilies(std::uint64_t seed) : random_(seed) {}

  Pair draw(PairFamily family) {
    switch (family) {
      case PairFamily::generic:
        return anywhere();
      case PairFamily::distant:
        return moved(anywhere(), random_.uniform(1.0, 10.0) * random_.direction());
      case PairFamily::near_parallel:
        return near_parallel();
      case PairFamily::parallel_far_away:
        return shifted(near_parallel(), 1e6 * random_.direction());
      case PairFamily::length_ratio:
        return length_ratio();
      case PairFamily::needles:
      case PairFamily::caps:
        return slivers(family == PairFamily::caps);
      case PairFamily::coplanar:
        return coplanar();
      case PairFamily::touching:
        return near_touch(random_.coin() ? 0.0 : random_.signed_power(-17.0, -10.0));
      case PairFamily::crossing:
        return near_touch(-random_.uniform(0.0, 0.5));
      case PairFamily::small_gap:
        return near_touch(std::pow(10.0, random_.uniform(-12.0, -4.0)));
      case PairFamily::tiny:
        return scaled(draw(kPairFamilies[random_.index(8)]), 1e-9);
      case PairFamily::slightly_crossed:
        return slightly_crossed();
      case PairFamily::integer_grid:
        return on_grid(random_.integer(1, 4));
      case PairFamily::degenerate:
        break;
    }
    return degenerate();
  }

 private:
  template <std::size_t kCount>
  std::array<Vec3, kCount> simplex() {
    std::array<Vec3, kCount> x;
    for (Vec3& corner : x) corner = random_.in_cube(1.0);
    return x;
  }
  Pair anywhere() { return {simplex<kCountA>(), simplex<kCountB>()}; }

  static Pair moved(Pair pair, const Vec3& way) {
    for (Vec3& corner : pair.b) corner += way;
    return pair;
  }
  static Pair shifted(Pair pair, const Vec3& way) {
    for (Vec3& corner : pair.a) corner += way;
    return moved(pair, way);
  }
  static Pair scaled(Pair pair, double factor) {
    for (Vec3& corner : pair.a) corner *= factor;
    for (Vec3& corner : pair.b) corner *= factor;
    return pair;
  }

  /// b's sides lead along those of a.
  Pair near_parallel() {
    Pair pair = anywhere();
    const double angle =
        random_.integer(0, 4) == 0 ? 0.0 : std::pow(10.0, random_.uniform(-16.0, -3.0));
    for (std::size_t k = 1; k < kCountB; ++k) {
      const Vec3 along = pair.a[k % kCountA] - pair.a[0];
      pair.b[k] = pair.b[0] + random_.uniform(-2.0, 2.0) * along + angle * random_.in_cube(1.0);
    }
    return pair;
  }

  Pair length_ratio() {
    Pair pair = anywhere();
    const double ratio = std::pow(10.0, random_.uniform(-6.0, 0.0));
    const Vec3 at = random_.in_cube(1.0);
    for (Vec3& corner : random_.coin() ? std::span<Vec3>(pair.a) : std::span<Vec3>(pair.b))
      corner = at + ratio * corner;
    return pair;
  }

  template <std::size_t kCount>
  void make_sliver(std::array<Vec3, kCount>& x, bool is_cap) {
    if constexpr (kCount == 3) {
      const double height = std::pow(10.0, random_.uniform(-9.0, -3.0));
      const double share = is_cap ? random_.uniform(0.1, 0.9) : 0.0;
      x[2] = x[0] + share * (x[1] - x[0]) + height * random_.direction();
      std::swap(x[random_.index(3)], x[2]);
    }
  }
  Pair slivers(bool is_cap) {
    Pair pair = random_.coin() ? anywhere() : near_touch(random_.signed_power(-9.0, 0.0));
    make_sliver(pair.a, is_cap);
    if (random_.coin()) make_sliver(pair.b, is_cap);
    return pair;
  }

  Pair coplanar() {
    Pair pair = anywhere();
    const double off = random_.coin() ? 0.0 : std::pow(10.0, random_.uniform(-17.0, -8.0));
    const auto flatten = [&](auto& x) {
      for (Vec3& corner : x) corner[2] = off * random_.uniform(-1.0, 1.0);
    };
    flatten(pair.a);
    flatten(pair.b);
    if (random_.coin()) return pair;
    const Mat3 turn = random_.rotation();
    for (Vec3& corner : pair.a) corner = turn * corner;
    for (Vec3& corner : pair.b) corner = turn * corner;
    return pair;
  }

  template <std::size_t kCount>
  Vec3 point_of(const std::array<Vec3, kCount>& x) {
    Vec3 point = x[0];
    double left = 1.0;
    for (std::size_t k = 1; k < kCount; ++k) {
      const double share = left * (random_.coin() ? 0.5 * random_.integer(0, 2) : random_.unit());
      left -= share;
      point += share * (x[k] - x[0]);
    }
    return point;
  }

  /// b is moved so that one of its points comes to one of a, this far off along a direction across
  /// a side of a.
  Pair near_touch(double gap) {
    Pair pair = anywhere();
    Vec3 across = random_.direction();
    if constexpr (kCountA > 1) across = across.cross(pair.a[1] - pair.a[0]).normalized();
    return moved(pair, point_of(pair.a) - point_of(pair.b) + gap * across);
  }

  /// First side along a direction through a point, the rest behind it.
  template <std::size_t kCount>
  void lay(std::array<Vec3, kCount>& x, const Vec3& at, const Vec3& along, const Vec3& behind) {
    x[0] = at;
    if constexpr (kCount > 1) {
      x[0] = at - random_.uniform(0.1, 1.0) * along;
      x[1] = at + random_.uniform(0.1, 1.0) * along;
    }
    if constexpr (kCount > 2)
      x[2] = at + random_.uniform(-1.0, 1.0) * along + random_.uniform(0.1, 1.0) * behind;
  }
  Pair slightly_crossed() {
    const Mat3 frame = random_.rotation();
    const double angle = std::pow(10.0, random_.uniform(-9.0, -2.0));
    const Vec3 along_b = std::cos(angle) * frame.col(0) + std::sin(angle) * frame.col(1);
    const Vec3 at = random_.in_cube(1.0);
    const Vec3 up = frame.col(2);
    Pair pair;
    lay(pair.a, at, frame.col(0), -up);
    lay(pair.b, at + std::pow(10.0, random_.uniform(-3.0, 0.0)) * up, along_b, up);
    return pair;
  }

  Pair on_grid(int half) {
    Pair pair;
    for (Vec3& corner : pair.a) corner = random_.on_lattice(-half, half);
    for (Vec3& corner : pair.b) corner = random_.on_lattice(-half, half);
    return pair;
  }

  Pair degenerate() {
    Pair pair = on_grid(4);
    const auto collapse = [&](auto& x) {
      const Vec3 step =
          random_.integer(0, 2) == 0 ? Vec3::Zero().eval() : random_.on_lattice(-2, 2);
      for (Vec3& corner : x) corner = x[0] + random_.integer(-3, 3) * step;
    };
    collapse(pair.a);
    if (random_.coin()) collapse(pair.b);
    if (random_.coin()) return pair;
    const Mat3 turn = random_.rotation();
    for (Vec3& corner : pair.a) corner = turn * corner;
    for (Vec3& corner : pair.b) corner = turn * corner;
    return pair;
  }

  Random random_;
};

}  // namespace plekton::test
