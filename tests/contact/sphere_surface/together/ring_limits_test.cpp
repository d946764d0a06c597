// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/contact_rule_reference.hpp"
#include "tests/support/contact_surfaces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

/// Rings where rounding decides: features at the range, levels that tie, a ball's centre on the
/// surface; and very many rings.
namespace plekton::test::ring_limits_test {
namespace {

/// A range and its neighbours, from some last digits below it to 1e-9 above.
std::vector<double> ranges_about(double range) {
  std::vector<double> ranges;
  for (int k = -3; k <= 3; ++k)
    ranges.push_back(range * (1.0 + k * std::numeric_limits<double>::epsilon()));
  for (double more = 1e-15; more < 1e-8; more *= 1.2) ranges.push_back(range + more);
  return ranges;
}

TEST(RingsAtTheRange, FollowIt) {
  Random random(3);
  const std::vector<Complex> lattices{centred(net(6), 6, 0.3), centred(sheet(6), 6, 0.3), ball(1),
                                      plate_with_hole(6, 0.3, 1.0)};
  for (const Complex& complex : lattices) {
    const Surface surface = complex.surface();
    PatchFinder finder(surface);
    const auto cells = all_cells(surface);
    for (const Vec3& centre :
         {Vec3(-0.5, -0.5, 0.4881), Vec3(0.0, 0.0, 0.4881), Vec3(0.15, 0.15, 0.4881),
          Vec3(0.0, 0.0, 0.0), Vec3(0.15, 0.0, 0.0), Vec3(1e-3, 2e-3, 1e-9)}) {
      const Vec3& node = complex.x[random.index(complex.x.size())];
      const double range = (node - centre).norm();
      if (range == 0.0) continue;
      const double beyond = total_contact(finder, centre, range + 1e-8, cells, complex.x).energy;
      for (const double at : ranges_about(range)) {
        const TotalContact total = total_contact(finder, centre, at, cells, complex.x);
        ASSERT_TRUE(total.force.allFinite());
        ASSERT_NEAR(total.energy, beyond, 1e-6) << at - range;
      }
    }
  }
}

/// A pass on an edge closes a ring half the square of a slope below the top that fills it.
Complex dimple(double scale, bool is_below, double slope = 6e-7) {
  const Vec3 top(0.0, 0.0, 1.0);
  Complex dimple;
  dimple.node(top);
  dimple.node(top + 0.5 * Vec3(1.0, 0.0, -slope));
  dimple.node(Vec3(0.1, 0.4, 0.6));
  dimple.node(Vec3(-0.3, 0.0, 0.7));
  dimple.node(Vec3(0.1, -0.4, 0.6));
  for (int k = 1; k <= 4; ++k) dimple.facet(0, k, k % 4 + 1);
  for (Vec3& x : dimple.x) {
    x *= scale;
    if (is_below) x = Vec3(x.x(), -x.y(), -x.z());
  }
  return dimple;
}

TEST(RingsThatTie, GiveBackWhatTheyDoByThemselves) {
  constexpr double kRange = 1.2;
  const auto energy_of = [&](const Complex& complex) {
    const Surface surface = complex.surface();
    PatchFinder finder(surface);
    return total_contact(finder, Vec3::Zero(), kRange, all_cells(surface), complex.x).energy;
  };
  for (const double farther : {0.0, 1e-13, 2.5e-13, 5e-13, 9e-13, 3e-12, 1e-9}) {
    const Complex near = dimple(1.0, false);
    const Complex far = dimple(1.0 + farther, true);
    Complex both = near;
    const int first = static_cast<int>(both.x.size());
    for (const Vec3& x : far.x) both.node(x);
    for (int k = 1; k <= 4; ++k) both.facet(first, first + k, first + k % 4 + 1);

    EXPECT_NEAR(energy_of(both), energy_of(near) + energy_of(far), 1e-12) << farther;
  }
}

// Where a difference of 1e-12 of the range was taken for a tie the force jumped by 1.4e-6 of one
// contact.
TEST(RingsThatTie, ChangeTheForceByNoMoreThanTheSlopeDoes) {
  constexpr double kRange = 1.2;
  const auto force_at = [](double slope) -> Vec3 {
    const Complex complex = dimple(1.0, false, slope);
    const Surface surface = complex.surface();
    PatchFinder finder(surface);
    return total_contact(finder, Vec3::Zero(), kRange, all_cells(surface), complex.x).force;
  };
  // Of up to four terms that turn by as much, each with a force of the overlap 0.2 or less.
  for (double slope = 1e-7; slope < 1e-5; slope *= 1.05) {
    const double change = (force_at(1.05 * slope) - force_at(slope)).norm();
    ASSERT_LT(change, 4.0 * 0.2 * 0.05 * slope + 0.2 * 4e-8) << slope;
  }
}

TEST(RingsAroundTheCentre, PushNoMoreThanRingsBesideIt) {
  Random random(5);
  double worst = 0.0;
  for (int trial = 0; trial < 300; ++trial) {
    const Complex complex = random_complex(random, random.coin());
    if (complex.facets.empty() && complex.cylinders.empty()) continue;
    const Surface surface = complex.surface();
    PatchFinder finder(surface);
    const auto cells = all_cells(surface);
    const Vec3 way = std::pow(10.0, random.uniform(-18.0, -6.0)) * random.in_cube(1.0);
    const Vec3 centre = complex.x[random.index(complex.x.size())] + way;

    const TotalContact total = total_contact(finder, centre, 2.0, cells, complex.x);

    ASSERT_TRUE(total.force.allFinite());
    worst = std::max(worst, total.force.norm() / 2.0);
  }
  EXPECT_LT(worst, 20.0);
}

/// Rings of a net that hang together below the range: edges less nodes in range, and one.
int meshes_in(const Complex& net, const Vec3& centre, double range) {
  const auto is_in = [&](geometry::NodeId node) {
    return (net.x[index_of(node)] - centre).norm() < range;
  };
  int rings = 1;
  for (std::size_t i = 0; i < net.x.size(); ++i) rings -= is_in(id_at<geometry::NodeId>(i));
  for (const Cylinder& bar : net.cylinders) rings += is_in(bar.nodes[0]) && is_in(bar.nodes[1]);
  return rings;
}

TEST(RingsOfAFineNet, AreOneContactAtLeastAndLittleMoreForEachRing) {
  constexpr double kRange = 1.0;
  for (const int meshes : {8, 16, 24}) {
    const Complex complex = centred(net(meshes), meshes, 1.2 / meshes);
    const Surface surface = complex.surface();
    PatchFinder finder(surface);
    const auto cells = all_cells(surface);
    const auto nodes = cell_nodes(surface);
    for (const double overlap : {0.02, 0.05, 0.1}) {
      const Vec3 centre(0.013, 0.027, kRange - overlap);

      const TotalContact total = total_contact(finder, centre, kRange, cells, complex.x);

      const auto pieces =
          reference_contact(centre, kRange, nodes, complex.x, [](double o) { return o; });
      // Each of up to 240 rings is 6.4 % of a contact at its shallowest pass too much at most, as
      // one of four equal passes is (cycle_weights.hpp).
      const double most = 0.064 * static_cast<double>(meshes_in(complex, centre, kRange));
      EXPECT_GE(total.energy, pieces.energy * (1.0 - 1e-12)) << meshes << ", " << overlap;
      EXPECT_LE(total.energy, pieces.energy + most * 0.5 * overlap * overlap)
          << meshes << ", " << overlap;
    }
  }
}

}  // namespace
}  // namespace plekton::test::ring_limits_test
