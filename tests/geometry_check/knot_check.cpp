// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/geometry_check/knot_check.hpp"

#include "tests/support/contact_rule_reference.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace plekton::geometry_check {
namespace {

using geometry::Vec3;
using std::numbers::pi;
using test::Random;

constexpr double kRange = SpreadTouch::kRange;

/// rad, of the arms.
std::vector<double> any_angles(int kind, Random& random) {
  const auto any = [&] { return random.uniform(0.0, 2.0 * pi); };
  const double first = any(), second = any();
  std::vector<double> angles;
  switch (kind) {
    case 0:
      return {first, first + pi};
    case 1:
      return {first, first + pi, second, second + pi};
    case 2:
      return {first, first + pi, second};
    case 3: {
      const int count = random.integer(3, 6);
      for (int i = 0; i < count; ++i) angles.push_back(first + 2.0 * pi * i / count);
      return angles;
    }
    default:
      for (int i = random.integer(2, 6); i > 0; --i) angles.push_back(any());
      return angles;
  }
}

Vec3 along(double angle) {
  return {std::cos(angle), std::sin(angle), 0.0};
}

/// J, of the pieces that are in range.
double energy_of_pieces(const Knot& knot, const geometry::Surface& surface, const Vec3& centre) {
  return test::reference_contact(centre, kRange, test::cell_nodes(surface), knot.complex.x,
                                 [](double overlap) { return overlap; })
      .energy;
}

}  // namespace

Knot any_knot(Random& random) {
  const int kind = random.integer(0, 4);
  Knot knot{{}, kind < 2, std::pow(10.0, random.uniform(-3.0, -1.0)), Vec3::Zero()};
  const auto angles = any_angles(kind, random);
  const int node = knot.complex.node(Vec3::Zero());
  for (const double angle : angles)
    knot.complex.cylinder(node, knot.complex.node(random.uniform(0.3, 1.5) * along(angle)));
  knot.way = along(random.coin() ? angles[0] : random.uniform(0.0, 2.0 * pi));
  return knot;
}

double excess_of_knot(const Knot& knot, const Vec3& foot, const SpreadRule& rule) {
  const geometry::Surface surface = knot.complex.surface();
  const Vec3 centre = foot + (kRange - knot.depth) * Vec3::UnitZ();
  const double more =
      rule(surface, centre, knot.complex.x).energy - energy_of_pieces(knot, surface, centre);
  return more / (0.5 * knot.depth * knot.depth);
}

bool rolls_evenly(const Knot& knot, const SpreadRule& rule) {
  // The node is in range as far as half a chord.
  const double half_chord = std::sqrt(knot.depth * (2.0 * kRange - knot.depth));
  const double most = knot.is_of_straight_wires ? 0.0 : kMostOfKnots;
  constexpr int kPlaces = 10;
  for (int i = -kPlaces; i <= kPlaces; ++i) {
    const double more = excess_of_knot(knot, half_chord * i / kPlaces * knot.way, rule);
    // Distances are rounded to some eps, and overlaps are 1e-3 at least.
    if (!(more >= -1e-9 && more <= most + 1e-9)) return false;
  }
  return true;
}

}  // namespace plekton::geometry_check
