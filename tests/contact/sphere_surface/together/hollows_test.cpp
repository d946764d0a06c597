// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/contact_rule_reference.hpp"
#include "tests/support/contact_surfaces.hpp"
#include "tests/support/force_jumps.hpp"

#include <gtest/gtest.h>

/// A ball that covers closed bodies from all sides.
namespace plekton::test::hollows_test {
namespace {

/// What passes from one top to another where two tie, in contacts of the depth of the tops: of a
/// ring of two passes at most this for each direction (cycle_weights.hpp). Inside a closed shell
/// all tops are about equally far, in all directions.
constexpr double kHandOverInside = 0.055;

/// Holes begin at a mean over their rings, not where the shallowest pass does: of the energy of a
/// ring of two passes at most this (cycle_weights.hpp).
constexpr double kMeanOfHoles = 0.04;

/// How fast the force changes, by distance: all passes of a shell are nearly on one level, and turn
/// the force as they tie. Seen: 166.
constexpr double kSteepest = 200.0;

/// Closed shells about the origin, of which no node is farther than 1.
std::vector<Complex> closed_shells() {
  std::vector<Complex> shells;
  for (int splits = 0; splits < 2; ++splits) shells.push_back(ball(splits));
  for (int n = 1; n < 3; ++n) {
    const double size = 1.0 / (0.5 * n * std::sqrt(3.0));
    const auto centred = [&](const Vec3& x) { return Vec3(size * (x - Vec3::Constant(0.5 * n))); };
    shells.push_back(mapped(cube(n), centred));
    shells.push_back(mapped(cube(n), [&](const Vec3& x) {
      return Vec3(centred(x).cwiseProduct(Vec3(1.0, 0.7, 0.4)));
    }));
  }
  return shells;
}

/// Two unit cubes that share a wall: two hollows. The origin is in the middle of one of them.
Complex twin_box() {
  Complex box = mapped(cube(1), [](const Vec3& x) { return Vec3(x - Vec3(1.0, 0.5, 0.5)); });
  const auto at = [&](const Vec3& x) {
    for (std::size_t i = 0; i < box.x.size(); ++i) {
      if (box.x[i] == x) return static_cast<int>(i);
    }
    return box.node(x);
  };
  const std::vector<Facet> first = box.facets;
  for (const Facet& facet : first) {
    std::array<int, 3> mirrored{};
    bool is_wall = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 x = box.x[index_of(facet.nodes[k])];
      is_wall = is_wall && x[0] == 0.0;
      mirrored[k] = at(Vec3(-x[0], x[1], x[2]));
    }
    if (!is_wall) box.facet(mirrored[0], mirrored[2], mirrored[1]);
  }
  return mapped(box, [](const Vec3& x) { return Vec3(x + Vec3(0.5, 0.0, 0.0)); });
}

TEST(GrainThatCoversAClosedShell, FeelsAForceThatFollowsItsMotionAcrossTheCentre) {
  for (const double range : {1.05, 2.0}) {
    for (const Complex& shell : closed_shells()) {
      SCOPED_TRACE(::testing::Message() << "range " << range << ", nodes " << shell.x.size());
      for (const Vec3& way : {Vec3(0.2, 0.013, 0.007), Vec3(0.1, 0.0, 0.0), Vec3(0.1, 0.1, 0.1)}) {
        expect_no_jump(shell, range, range, -way, way, 200, kHandOverInside);
      }
    }
  }
}

TEST(GrainThatCoversAClosedShell, FeelsNoForceInTheMiddleAndLittleBesideIt) {
  for (const Complex& shell : closed_shells()) {
    const Surface surface = shell.surface();
    PatchFinder finder(surface);
    const double range = 1.3;
    const auto cells = all_cells(surface);
    const auto force_at = [&](const Vec3& centre) {
      return total_contact(finder, centre, range, cells, shell.x).force;
    };

    // Diagonals of the cubes are not symmetric, and share out a little unevenly.
    const Vec3 middle = force_at(Vec3::Zero());

    EXPECT_LT(middle.norm(), 0.05 * range);
    for (double step = 1e-14; step < 1e-3; step *= 10.0) {
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LT((force_at(step * Vec3::Unit(axis)) - middle).norm(),
                  kSteepest * step + kHandOverInside)
            << shell.x.size() << " nodes, axis " << axis << ", step " << step;
      }
    }
  }
}

TEST(GrainThatCoversAClosedShell, HasTheEnergyOfOneContactForEachPiece) {
  Random random(1);
  std::vector<Complex> shells = closed_shells();
  shells.push_back(twin_box());
  for (const Complex& shell : shells) {
    const Surface surface = shell.surface();
    PatchFinder finder(surface);
    const auto cells = all_cells(surface);
    const auto nodes = cell_nodes(surface);
    for (int trial = 0; trial < 50; ++trial) {
      const Vec3 centre = random.in_cube(0.5);
      const double range = random.uniform(1.0, 3.0);

      const TotalContact total = total_contact(finder, centre, range, cells, shell.x);

      const auto expected =
          reference_contact(centre, range, nodes, shell.x, [](double overlap) { return overlap; });
      ASSERT_NEAR(total.energy, expected.energy, kMeanOfHoles * expected.energy);
    }
  }
}

TEST(GrainThatCoversAClosedShell, FeelsTheSameWhateverTheOrderInWhichItWasCreated) {
  Random random(2);
  std::vector<Complex> shells = closed_shells();
  shells.push_back(twin_box());
  for (const Complex& first : shells) {
    const Surface first_surface = first.surface();
    PatchFinder first_finder(first_surface);
    for (int trial = 0; trial < 20; ++trial) {
      const Complex second = reordered(first, random);
      const Surface second_surface = second.surface();
      PatchFinder second_finder(second_surface);
      const double range = random.uniform(1.3, 3.0);
      const auto cells = all_cells(first_surface);
      for (const Vec3& centre : {Vec3(0, 0, 0), Vec3(random.in_cube(0.1)), Vec3(0, 0.01, 0)}) {
        const Vec3 force = total_contact(first_finder, centre, range, cells, first.x).force;
        ASSERT_NEAR(
            (total_contact(second_finder, centre, range, cells, second.x).force - force).norm(),
            0.0, 1e-11 * range)
            << first.x.size() << " nodes";
      }
    }
  }
}

TEST(GrainOnADustOfClosedShells, IsPushedByASmallOneAsOnceFromItsMiddle) {
  Random random(3);
  const double size = 1e-3;
  for (const Complex& shell : closed_shells()) {
    const Complex dust = mapped(shell, [&](const Vec3& x) { return Vec3(size * x); });
    const Surface surface = dust.surface();
    PatchFinder finder(surface);
    const double overlap = 0.05;
    const Vec3 away = (1.0 - overlap) * random.direction();

    const TotalContact total = total_contact(finder, away, 1.0, all_cells(surface), dust.x);

    EXPECT_EQ(total.patches, 1);
    EXPECT_NEAR(total.force.norm(), overlap, 2.0 * size);
    EXPECT_LT(total.force.normalized().cross(away.normalized()).norm(), 2.0 * size);
  }
}

TEST(GrainThatCoversTwoHollowsWithACommonWall, FeelsAForceThatFollowsItsMotion) {
  const Complex box = twin_box();
  for (const double range : {1.7, 1.8, 2.5}) {
    for (const Vec3& way : {Vec3(0.2, 0.013, 0.007), Vec3(0.2, 0.0, 0.0), Vec3(0.0, 0.1, 0.0)})
      expect_no_jump(box, range, range, -way, way, 200, kHandOverInside);
  }
}

}  // namespace
}  // namespace plekton::test::hollows_test
