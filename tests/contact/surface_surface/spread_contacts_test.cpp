// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/bodies_of_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

/// Friction of sheets that lie on each other is a field.
namespace plekton::test {
namespace {

constexpr double kRange = 0.02;
constexpr double kOverlap = 1e-4;
constexpr double kFriction = 0.5;
constexpr double kRadius = 0.3;

/// A disc in the plane z = 0: rings of 6 k nodes about its centre.
Body disc(int rings, double radius) {
  Body body;
  body.x.emplace_back(0.0, 0.0, 0.0);
  const auto first_of = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  for (int ring = 1; ring <= rings; ++ring) {
    for (int i = 0; i < 6 * ring; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / (6 * ring);
      const double r = radius * ring / rings;
      body.x.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    }
  }
  for (int ring = 1; ring <= rings; ++ring) {
    const auto outer = [&](int i) { return first_of(ring) + i % (6 * ring); };
    const auto inner = [&](int i) {
      return ring == 1 ? 0 : first_of(ring - 1) + i % (6 * (ring - 1));
    };
    for (int sector = 0; sector < 6; ++sector) {
      for (int i = 0; i < ring; ++i) {
        const int o = sector * ring + i, n = sector * (ring - 1) + i;
        body.facets.push_back({inner(n), outer(o), outer(o + 1)});
        if (i + 1 < ring) body.facets.push_back({inner(n), outer(o + 1), inner(n + 1)});
      }
    }
  }
  return body;
}

struct Turned {
  double normal_force;
  Vec3 force;
  double torque;  ///< about the axis
};

/// A disc that lies flat on a sheet and is turned about an axis until all of it slips.
Turned turn(double off_centre) {
  const Body b = disc(6, kRadius);
  StructurePairUnder<contact::LinearFrictional> structure_pair(
      sheet(5, 5, 1.4, 1.4, Cut::alternating, 3), b, kRange, {}, 1.0, kFriction);
  const Vec3 axis(off_centre, 0.0, 0.0);
  const Vec3 lift(0.03, 0.02, kRange - kOverlap);
  const auto turned = [&](double angle) {
    Body placed = moved(b, Vec3::Zero(), -axis);
    return moved(placed, {0.0, 0.0, angle}, axis + lift);
  };
  structure_pair.place(turned(0.0));
  // A spring slips after friction * overlap: everything but the axis itself is far beyond that.
  for (int i = 1; i <= 200; ++i) structure_pair.slide(turned(1e-3 * i));
  return {structure_pair.force_on_b().z(), structure_pair.force_on_b(),
          structure_pair.moment_on_b(axis + lift).z()};
}

// Two thirds of the radius is the mean arm of a disc: torque 2/3 mu N R.
TEST(SpreadFriction, ResistsTheTurnOfADiscAboutItsCentre) {
  const Turned found = turn(0.0);

  const double limit = kFriction * found.normal_force;
  EXPECT_NEAR(-found.torque / (limit * kRadius), 2.0 / 3.0, 0.05 * 2.0 / 3.0);
  EXPECT_LT(found.force.head<2>().norm(), 0.02 * limit);
}

// Integrals over the disc of the unit vectors across the arms from an axis 0.3 R off: a resultant
// of 0.297 mu N, and 0.622 mu N R about the centre (numerical quadrature of 1e6 points).
TEST(SpreadFriction, ResistsTheTurnOfADiscAboutAnAxisBesideItsCentre) {
  const Turned found = turn(0.3 * kRadius);

  const double limit = kFriction * found.normal_force;
  const double resultant = found.force.head<2>().norm();
  EXPECT_NEAR(resultant / limit, 0.297, 0.05 * 0.297);
  // About the centre, at (-0.3 R, 0) from the axis: the disc is turned by 0.2 there.
  const Vec3 arm = 0.3 * kRadius * Vec3(std::cos(0.2), std::sin(0.2), 0.0);
  const double about_centre = found.torque + arm.cross(found.force).z();
  EXPECT_NEAR(-about_centre / (limit * kRadius), 0.622, 0.05 * 0.622);
}

// Half of what would move it: nothing slips, and what is put in comes back.
TEST(SpreadFriction, GivesBackWhatIsPutInBelowItsLimit) {
  const Body b = sheet(4, 4, 0.4, 0.4);
  StructurePairUnder<contact::LinearFrictional> structure_pair(
      sheet(5, 5, 1.4, 1.4, Cut::alternating, 3), b, kRange, {}, 1.0, kFriction);
  const auto at = [&](double x) {
    return moved(b, {0.0, 0.0, 0.1}, {0.03 + x, 0.02, kRange - kOverlap});
  };
  structure_pair.place(at(0.0));
  const double energy = structure_pair.energy();
  const double contacts = 0.4 * 0.4 / (kRange * kRange);
  const double way = 0.5 * kFriction * kOverlap;
  for (int i = 1; i <= 10; ++i) structure_pair.slide(at(0.1 * i * way));
  EXPECT_NEAR(structure_pair.force_on_b().x(), -contacts * way, 1e-3 * contacts * way);
  for (int i = 9; i >= 0; --i) structure_pair.slide(at(0.1 * i * way));
  EXPECT_NEAR(structure_pair.energy(), energy, 1e-6 * energy);
  EXPECT_LT(std::abs(structure_pair.force_on_b().x()), 1e-3 * contacts * way);
}

}  // namespace
}  // namespace plekton::test
