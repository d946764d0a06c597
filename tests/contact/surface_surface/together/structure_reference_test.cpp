// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/core_pair.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/structure_rule_reference.hpp"

#include <gtest/gtest.h>

#include <numbers>

/// Structure against structure where they touch at points, against the reference "cells minus
/// seams": chains, folded sheets, corners of shells. Chains that bend around the other body keep
/// more of their contacts than that (wrapped_joints_test.cpp).
namespace plekton::test::structure_reference_test {
namespace {

constexpr double kRange = 0.1;
/// Bodies less parallel than this touch at points (extended.hpp).
constexpr double kLargestCosine = 0.89;

/// A chain with a bend at every joint.
Body bent_chain(int count, double bend, Random& random) {
  Body body;
  Vec3 x(-0.5 * count * 0.4, 0.0, 0.0);
  for (int i = 0; i <= count; ++i) {
    body.x.push_back(x);
    const double angle = bend * random.uniform(-1.0, 1.0);
    x += 0.4 * Vec3(std::cos(angle), std::sin(angle), 0.3 * random.uniform(-1.0, 1.0));
    if (i < count) body.cylinders.push_back({i, i + 1});
  }
  return body;
}

/// A sheet of two panels, each two cells wide, that meet in a ridge along x at z = 0 and fall away
/// on both sides.
Body folded_sheet(double slope) {
  Body body = sheet(3, 4, 1.2, 1.0, Cut::alternating, 3);
  for (Vec3& x : body.x) {
    if (std::abs(x.y()) < 0.15) x.y() = 0.0;  // the middle row is the ridge
    x.z() = -slope * std::abs(x.y());
  }
  return body;
}

/// The corner of a shell at the origin, of a number of facets around a tip that points down.
Body shell_corner(int facets, double steepness) {
  Body body;
  body.x.emplace_back(0.0, 0.0, 0.0);
  for (int k = 0; k < facets; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / facets;
    body.x.emplace_back(0.5 * std::cos(angle), 0.5 * std::sin(angle), 0.5 * steepness);
    body.facets.push_back({0, 1 + k, 1 + (k + 1) % facets});
  }
  return body;
}

/// Cores that meet are another matter.
bool cores_meet(const Body& a, const Body& b) {
  const auto core = [](const NodeList& cell, const std::vector<Vec3>& x) {
    geometry::Core result;
    for (const int node : cell) result.x[result.count++] = x[static_cast<std::size_t>(node)];
    return result;
  };
  for (const NodeList& cell_a : cells_of(a)) {
    for (const NodeList& cell_b : cells_of(b)) {
      const auto points = geometry::closest_points(core(cell_a, a.x), core(cell_b, b.x));
      if (points.relation == geometry::Relation::touching_or_crossing) return true;
    }
  }
  return false;
}

struct Seen {
  int compared = 0;
  int several_pairs = 0;  ///< compared structure pairs of more than one pair of cells
  int several_parts = 0;  ///< and of more than one contact
};

/// Lowers b on a at random places in random attitudes.
Seen compare(const Body& a, const Body& b, double reach, double largest_turn, bool is_upside_down,
             unsigned seed, int trials = 600) {
  Random random(seed);
  StructurePair structure_pair(a, b, kRange);
  Seen seen;
  for (int trial = 0; trial < trials; ++trial) {
    const Vec3 turns(
        random.uniform(-largest_turn, largest_turn) + (is_upside_down ? std::numbers::pi : 0.0),
        random.uniform(-largest_turn, largest_turn), random.uniform(0.0, 2.0 * std::numbers::pi));
    const Vec3 shift(random.uniform(-reach, reach), random.uniform(-reach, reach),
                     random.uniform(-0.1, 0.12));
    const Body placed = moved(b, turns, shift);
    const ReferenceStructurePair expected = reference_structure_pair(a, placed, kRange);
    if (expected.pairs == 0 || expected.has_rings || expected.has_wraps) continue;
    if (expected.most_parallel > kLargestCosine || cores_meet(a, placed)) continue;

    structure_pair.place(placed);

    const double tolerance = 1e-10 * kRange * expected.pairs;
    EXPECT_NEAR((structure_pair.force_on_b() - expected.force).norm(), 0.0, tolerance)
        << "trial " << trial;
    EXPECT_EQ(structure_pair.patches(), static_cast<std::size_t>(expected.components));
    if (::testing::Test::HasFailure()) return seen;
    ++seen.compared;
    seen.several_pairs += expected.pairs > 1;
    seen.several_parts += expected.components > 1;
  }
  return seen;
}

TEST(StructureContactsAgainstReference, AgreeOnChainsAcrossChains) {
  Random random(1);
  Seen seen;
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Seen now =
        compare(bent_chain(4, 0.5, random), bent_chain(3, 0.5, random), 0.5, 0.3, false, seed);
    seen.compared += now.compared;
    seen.several_pairs += now.several_pairs;
    seen.several_parts += now.several_parts;
  }
  EXPECT_GT(seen.compared, 300);
  EXPECT_GT(seen.several_pairs, 100);
  EXPECT_GT(seen.several_parts, 3);
}

TEST(StructureContactsAgainstReference, AgreeOnFoldedSheetsRidgeAcrossRidge) {
  const Seen seen = compare(folded_sheet(1.2), folded_sheet(1.2), 0.3, 0.1, true, 2);
  EXPECT_GT(seen.compared, 50);
  EXPECT_GT(seen.several_pairs, 50);
}

TEST(StructureContactsAgainstReference, AgreeOnCornersOfShellsOnSheets) {
  for (const int facets : {3, 4, 6}) {
    SCOPED_TRACE(facets);
    const Seen seen = compare(sheet(4, 4, 1.6, 1.6, Cut::alternating, 5), shell_corner(facets, 1.0),
                              0.7, 0.2, false, 3);
    EXPECT_GT(seen.compared, 50);
    EXPECT_GT(seen.several_pairs, 50);
  }
}

TEST(StructureContactsAgainstReference, AgreeOnChainsOverFoldsAndCorners) {
  Random random(4);
  const Seen on_fold =
      compare(folded_sheet(1.2), bent_chain(3, 0.4, random), 0.4, 0.3, false, 5, 1200);
  EXPECT_GT(on_fold.compared, 50);
  const Seen on_corner =
      compare(moved(shell_corner(4, 1.0), {std::numbers::pi, 0, 0}, Vec3::Zero()),
              bent_chain(3, 0.4, random), 0.4, 0.2, false, 6, 1200);
  EXPECT_GT(on_corner.compared, 10);
}

}  // namespace
}  // namespace plekton::test::structure_reference_test
