// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/dmt_adhesion.hpp"
#include "contact/law/hertz_mindlin.hpp"
#include "tests/support/hollow_ball.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/structure_rule_reference.hpp"

#include <gtest/gtest.h>

/// Regions of contact of two structures that close rings: counted by pieces, from one energy.
namespace plekton::test::structure_rings_test {
namespace {

constexpr double kRange = 0.1;

/// Relative difference between the forces on b's nodes and the slope of the energy.
template <class Law>
double error_of_forces(StructurePairUnder<Law>& structure_pair, const Body& b, Random& random) {
  std::vector<Vec3> ways;
  for (std::size_t i = 0; i < b.x.size(); ++i) ways.push_back(random.in_cube(1.0));
  structure_pair.place(b);
  double slope = 0.0, scale = 0.0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const Vec3& force = structure_pair.forces()[structure_pair.first_node_of_b() + i];
    slope -= force.dot(ways[i]);
    scale += force.norm() * ways[i].norm();
  }
  const auto energy_at = [&](double way) {
    Body there = b;
    for (std::size_t i = 0; i < ways.size(); ++i) there.x[i] += way * ways[i];
    structure_pair.place(there);
    return structure_pair.energy();
  };
  const auto difference = [&](double way) {
    return (8.0 * (energy_at(way) - energy_at(-way)) - energy_at(2.0 * way) +
            energy_at(-2.0 * way)) /
           (12.0 * way);
  };
  // A place where the force has a kink may lie within the longer way.
  return std::min(std::abs(difference(1e-6) - slope), std::abs(difference(1e-7) - slope)) / scale;
}

// All around a mesh that lies flat the places are at one distance, and no rounding of their
// energies may become a force of its own there: the moment is none, as at a tilt that tells them
// apart.
TEST(StructureRings, OfNetsThatLieFlatPushWithoutAMoment) {
  const Body plate = sheet(2, 2, 3.0, 3.0);
  for (const Body& net : {square_net_of(1, 0.6), square_net_of(3, 0.3)}) {
    for (const double tilt : {0.0, 1e-15, 1e-12, 1e-9}) {
      for (const double turn : {0.0, 0.3}) {
        StructurePairUnder<contact::LinearFrictional> pair(plate, net, kRange);
        const Vec3 shift(0.03, 0.02, kRange - 1e-5);
        pair.place(moved(net, {tilt, 0.0, turn}, shift));
        const double force = pair.force_on_b().z();
        EXPECT_GT(force, 0.0);
        EXPECT_LT(pair.moment_on_b(shift).norm(), 0.05 * force) << tilt << ' ' << turn;
        for (const Vec3& on_node : pair.forces()) EXPECT_LT(on_node.norm(), force) << tilt;
      }
    }
  }
}

/// A ball on a hole, or a net on a net: both have rings that nothing fills.
template <class Law>
void expect_gradients(const contact::PropertiesOf<Law>& properties) {
  Random random(4);
  const Body plate = plate_with_hole_of(12, 0.5, 2.0);
  const double across = 0.5 * std::cos(std::numbers::pi / 12);
  StructurePairUnder<Law> on_plate(plate, hollow_ball(8), kRange, properties);
  const Body net = square_net_of(3, 0.07);
  StructurePairUnder<Law> on_net(net, net, kRange, properties);
  for (int trial = 0; trial < 10; ++trial) {
    const double distance = 1.0 + kRange - random.uniform(0.02, 0.05);
    const Body ball = moved(
        hollow_ball(8), 3.0 * random.in_cube(1.0),
        Vec3(0.0, 0.0, std::sqrt(distance * distance - across * across)) + random.in_cube(0.003));
    EXPECT_LT(error_of_forces(on_plate, ball, random), 1e-7) << "ball " << trial;
    Body other = moved(net, {0.01, 0.02, 0.6}, Vec3(0.02, 0.01, kRange - 0.01));
    for (Vec3& x : other.x) x += random.in_cube(0.002);
    EXPECT_LT(error_of_forces(on_net, other, random), 1e-7) << "net " << trial;
  }
}

TEST(StructureRings, PushAgainstTheGradientOfTheirEnergy) {
  expect_gradients<contact::LinearFrictional>({});
}
TEST(StructureRings, PushAgainstTheGradientOfTheirEnergyUnderHertz) {
  expect_gradients<contact::HertzMindlin>({});
}
TEST(StructureRings, PushAgainstTheGradientOfTheirEnergyWithAdhesion) {
  expect_gradients<contact::DmtAdhesion>({1e-3});
}

/// The end of a bar in the middle of a dimple: a pass on an edge closes a ring half the square of a
/// slope below the top that fills it.
Body dimple(double slope) {
  const Vec3 top(0.0, 0.0, 1.0);
  Body dimple;
  dimple.x = {top, top + 0.5 * Vec3(1.0, 0.0, -slope), Vec3(0.1, 0.4, 0.6), Vec3(-0.3, 0.0, 0.7),
              Vec3(0.1, -0.4, 0.6)};
  for (int k = 1; k <= 4; ++k) dimple.facets.push_back({0, k, k % 4 + 1});
  for (Vec3& x : dimple.x) x *= kRange / 1.2;
  return dimple;
}

// As of spheres (ring_limits_test.cpp): where levels that are nearer than 1e-12 of the deepest
// overlap were taken for one the force jumped by 1e-6 of that of one contact.
TEST(StructureRings, ChangeTheForceByNoMoreThanTheSlopeOfAPassDoes) {
  const Body bar = moved(chain(1, 0.4), {0.0, 0.5 * std::numbers::pi, 0.0}, {0.0, 0.0, -0.2});
  ASSERT_LT(bar.x[0].head<2>().norm(), 1e-16);
  StructurePair structure_pair(bar, dimple(0.0), kRange);
  const auto force_at = [&](double slope) -> Vec3 {
    structure_pair.place(dimple(slope));
    return structure_pair.force_on_b();
  };
  // Of up to four terms that turn by as much, each with a force of the top's overlap or less.
  constexpr double kTop = kRange * (1.0 - 1.0 / 1.2);
  for (double slope = 1e-7; slope < 1e-5; slope *= 1.05) {
    const double change = (force_at(1.05 * slope) - force_at(slope)).norm();
    ASSERT_LT(change, kTop * (4.0 * 0.05 * slope + 4e-8)) << slope;
  }
}

// Bars that cross at 34 degrees touch at points. Nets give back up to a twelfth too much for every
// mesh in range (cycle_weights.hpp), and what bends of the wires keep besides (wrap.hpp).
TEST(StructureRings, OfBarsOnBarsNeverPushLessThanPieces) {
  Random random(5);
  const Body net = square_net_of(3, 0.06);
  StructurePair structure_pair(net, net, kRange);
  int below_without = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Body other = moved(net, {0.0, 0.0, 0.6}, Vec3(0.03 * random.unit(), 0.03 * random.unit(), 0.0));
    const double overlap = random.uniform(0.004, 0.02);
    for (Vec3& x : other.x) x += Vec3(0.0, 0.0, kRange - overlap) + random.in_cube(0.002);
    const ReferenceStructurePair pieces = reference_structure_pair(net, other, kRange);
    structure_pair.place(other);
    EXPECT_GT(structure_pair.energy(), (1.0 - 1e-9) * pieces.energy) << trial;
    EXPECT_GT(structure_pair.force_on_b().z(), 0.0) << trial;
    below_without += pieces.has_rings;
  }
  EXPECT_GT(below_without, 20);
}

}  // namespace
}  // namespace plekton::test::structure_rings_test
