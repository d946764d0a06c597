// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/structure_contacts.hpp"

#include "tests/support/bodies_of_cells.hpp"
#include "tests/support/structure_gradient.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>

/// Structure against structure: k = 1 N/m, so a force over the overlap is a number of contacts.
namespace plekton::test::structure_contacts_test {
namespace {

constexpr double kRange = 0.1;
constexpr double kOverlap = 0.005;
constexpr double kHeight = kRange - kOverlap;

struct Resultant {
  Vec3 force;
  Vec3 moment;
};

/// Where a body is, at a place s of a path.
struct Pose {
  Vec3 turns;
  Vec3 shift;
};
using Path = std::function<Pose(double)>;

Resultant at(StructurePair& structure_pair, const Body& b, const Pose& pose) {
  structure_pair.place(moved(b, pose.turns, pose.shift));
  return {structure_pair.force_on_b(), structure_pair.moment_on_b(pose.shift)};
}

/// Largest change of force and moment in a step, over the largest force.
Resultant largest_change(const Body& a, const Body& b, const Path& path, int steps) {
  StructurePair structure_pair(a, b, kRange);
  Resultant before = at(structure_pair, b, path(0.0));
  double force = 0.0, moment = 0.0, largest = before.force.norm();
  for (int i = 1; i <= steps; ++i) {
    const Resultant now = at(structure_pair, b, path(static_cast<double>(i) / steps));
    force = std::max(force, (now.force - before.force).norm());
    moment = std::max(moment, (now.moment - before.moment).norm());
    largest = std::max(largest, now.force.norm());
    before = now;
  }
  return {Vec3(force / largest, 0, 0), Vec3(moment / largest, 0, 0)};
}

/// Steps a tenth as long, changes a tenth as large where the force is smooth, and no more than the
/// root of that where shares begin and end (tilt_share.hpp). Below is what is left where the
/// overlap of two nearly parallel facets begins as a sliver: the contact that is counted besides
/// the 64 of the area moves by up to 0.1 of the half side, 1e-3 of all.
constexpr double kSliverForce = 1e-4;
constexpr double kSliverMoment = 1e-3 * 0.6;

void expect_continuous(const Body& a, const Body& b, const Path& path, const char* what) {
  const Resultant coarse = largest_change(a, b, path, 200);
  const Resultant fine = largest_change(a, b, path, 2000);
  EXPECT_LT(fine.force.x(), std::max(0.2 * coarse.force.x(), kSliverForce)) << what;
  EXPECT_LT(fine.moment.x(), std::max(0.35 * coarse.moment.x(), kSliverMoment)) << what;
}

TEST(StructureContacts, PressFlatSquaresAlikeInAnyTriangulation) {
  const double side = 0.8;
  const Pose pose{{0.0, 0.0, 0.3}, {0.11, 0.07, kHeight}};
  const double contacts = side * side / (kRange * kRange);
  for (const int cells_a : {1, 2, 4, 8}) {
    const Body a = sheet(cells_a, cells_a, 2.0, 2.0, Cut::alternating);
    for (const int cells_b : {1, 2, 4, 8}) {
      const Body b = sheet(cells_b, cells_b, side, side, Cut::one_way, 3);
      StructurePair structure_pair(a, b, kRange);
      const Resultant found = at(structure_pair, b, pose);
      const double force = contacts * kOverlap;
      EXPECT_NEAR(found.force.z(), force, 1e-6 * force) << cells_a << ' ' << cells_b;
      EXPECT_LT(found.force.head<2>().norm(), 1e-6 * force) << cells_a << ' ' << cells_b;
      EXPECT_LT(found.moment.norm(), 1e-6 * force * side) << cells_a << ' ' << cells_b;
      EXPECT_EQ(structure_pair.patches(), 1u);
    }
  }
}

// Sides of both meshes that lie on each other leave overlaps of facets that are lines up to
// rounding. Each is part of the one contact, and no node gets more than what lies around it.
TEST(StructureContacts, CountSquaresOnceWhoseMeshesFallTogether) {
  struct Case {
    int cells_a, columns_b, rows_b;
    double shift;
  };
  for (const auto& [cells_a, columns_b, rows_b, shift] :
       {Case{10, 4, 4, 0.0}, Case{10, 8, 8, 0.0}, Case{20, 8, 8, 0.0}, Case{10, 10, 10, 0.02},
        Case{10, 11, 10, 0.02}, Case{10, 1, 10, 0.02}, Case{10, 2, 10, 0.02}}) {
    const Body b = sheet(columns_b, rows_b, 0.4, 0.4);
    for (const double turn : {0.0, 1e-14, 1e-10, 1e-8, 1e-6, 1e-5}) {
      StructurePair structure_pair(sheet(cells_a, cells_a, 1.0, 1.0), b, kRange);
      const Resultant found = at(structure_pair, b, {{0.0, 0.0, turn}, {0.0, shift, kHeight}});
      EXPECT_NEAR(structure_pair.energy() / (0.5 * kOverlap * kOverlap), 16.0, 1e-6) << cells_a;
      EXPECT_NEAR(found.force.z() / kOverlap, 16.0, 1e-6) << cells_a << ' ' << turn;
      for (const Vec3& force : structure_pair.forces()) EXPECT_LT(force.norm(), 16.0 * kOverlap);
      EXPECT_EQ(structure_pair.patches(), 1u);
    }
  }
}

// All edges of two equal sheets lie on each other, those of the rims too. Turned by a small angle t
// they have the part 1 - t / 2 of their area in common. Where rims cross, contacts of sum 0 are left
// that are 0.1 of half a side apart at most (DoNotJumpToAnEndWhenTilted): a moment of one contact
// there, whatever the size of the sheets.
TEST(StructureContacts, PushEqualSheetsThatLieOnEachOtherNearTheirMiddle) {
  const double side = 0.4;
  const double contacts = side * side / (kRange * kRange);
  for (const int cells : {1, 2, 4, 10}) {
    const Body one = sheet(cells, cells, side, side);
    for (const double turn : {0.0, 1e-14, 1e-10, 1e-8, 1e-6, 1e-5}) {
      StructurePair structure_pair(one, one, kRange);
      const Resultant found = at(structure_pair, one, {{0.0, 0.0, turn}, {0.0, 0.0, kHeight}});
      EXPECT_NEAR(found.force.z() / kOverlap, contacts * (1.0 - 0.5 * turn), 1e-6) << turn;
      EXPECT_LT(found.moment.norm(), 1.001 * kOverlap * 0.1 * 0.5 * side) << cells << ' ' << turn;
    }
  }
}

TEST(StructureContacts, PressInProportionToTheAreaOfContact) {
  const Body a = sheet(3, 3, 2.0, 2.0, Cut::alternating, 5);
  const auto extent = [&](double width) {
    const Body b = sheet(2, 3, width, 0.6, Cut::one_way, 4);
    StructurePair structure_pair(a, b, kRange);
    return at(structure_pair, b, {{0.0, 0.0, 0.2}, {0.05, 0.0, kHeight}}).force.z() / kOverlap;
  };
  EXPECT_NEAR(extent(0.8) / extent(0.2), 4.0, 1e-6);
}

TEST(StructureContacts, DoNotJumpToAnEndWhenTilted) {
  const Body a = sheet(3, 3, 2.0, 2.0, Cut::alternating, 5);
  for (const Body& b : {sheet(2, 2, 0.8, 0.8, Cut::one_way, 3), sheet(1, 1, 0.05, 0.05),
                        chain(3, 0.9), chain(1, 0.05)}) {
    StructurePair structure_pair(a, b, kRange);
    const double reach = 0.5 * (b.x.back() - b.x.front()).norm();
    const Resultant tilted = at(structure_pair, b, {{1e-9, 1e-9, 0.3}, {0.05, 0.02, kHeight}});
    // A level body is pushed at its centre; this tilt is a millionth of what a single corner takes.
    EXPECT_LT(tilted.moment.norm(), 1e-4 * reach * tilted.force.norm());
  }
}

TEST(StructureContacts, ChangeContinuouslyWhileASheetTiltsTurnsAndSlidesOff) {
  const Body a = sheet(3, 3, 2.0, 2.0, Cut::alternating, 7);
  const Body b = sheet(2, 2, 0.8, 0.8, Cut::alternating, 3);
  const auto path = [](Vec3 turns, Vec3 turn_by, Vec3 shift, Vec3 shift_by) {
    return [=](double s) { return Pose{turns + s * turn_by, shift + s * shift_by}; };
  };
  const Vec3 none = Vec3::Zero();
  const Vec3 above(0.11, 0.07, kHeight);
  const double tilt = contact::structure::kLargestTilt;
  expect_continuous(a, b, path({0, 0, 0.3}, {6 * tilt, 2 * tilt, 0}, above, none), "tilt");
  expect_continuous(a, b, path({-2 * tilt, tilt, 0.3}, {4 * tilt, 0, 0}, above, none), "level out");
  expect_continuous(a, b, path({5 * tilt, 0, 0.3}, {0.02, 0, 0}, above, {0, 0, 0.008}), "tip up");
  expect_continuous(a, b, path(none, {0, 0, 3.0}, above, none), "turn");
  expect_continuous(a, b, path({0.01, 0, 0}, {0, 0, 3.0}, above, none), "turn tilted");
  expect_continuous(a, b, path({0, 0, 0.3}, none, above, {1.6, 0, 0}), "slide off");
  expect_continuous(a, b, path({0.003, -0.01, 0.3}, none, above, {1.6, 0, 0}), "slide off tilted");
  expect_continuous(a, b, path({0, 0, 0.3}, none, Vec3(0.11, 0.07, 1.01 * kRange), {0, 0, -0.005}),
                    "lower");
}

TEST(StructureContacts, ChangeContinuouslyFromCrossedToParallelCylinders) {
  const Body a = chain(4, 2.0);
  const Body b = chain(3, 0.9);
  const double tilt = contact::structure::kLargestTilt;
  const auto turn = [](double from, double to) {
    return [=](double s) { return Pose{{0, 0, from + s * (to - from)}, {0.05, 0.01, kHeight}}; };
  };
  expect_continuous(a, b, turn(0.5 * std::numbers::pi, 0.02), "crossed to nearly parallel");
  expect_continuous(a, b, turn(0.03, 0.0), "the last two degrees");
  expect_continuous(
      a, b,
      [](double s) {
        return Pose{{0, 0, 0}, {0.05, 0.1 * (s - 0.5), kHeight}};
      },
      "sideways");
  expect_continuous(
      a, b,
      [=](double s) {
        return Pose{{0, 4 * tilt * (s - 0.5), 0}, {0.051, 0, kHeight}};
      },
      "tilt");
  expect_continuous(
      a, b,
      [](double s) {
        return Pose{{0.2, 0.02, 1.4}, {0.05 + 0.6 * s, 0.02, kHeight}};
      },
      "across joints");
}

TEST(StructureContacts, AreStifferInProportionToTheLengthOfContact) {
  const Body a = chain(4, 4.0);
  for (const double length : {0.3, 0.9, 2.7}) {
    const Body b = chain(3, length);
    StructurePair structure_pair(a, b, kRange);
    const double contacts =
        at(structure_pair, b, {{0, 0, 0}, {0.03, 0, kHeight}}).force.z() / kOverlap;
    // The length with both round ends, in diameters.
    EXPECT_NEAR(contacts, (length + kRange) / kRange, 1e-9 * contacts);
  }
}

TEST(StructureContacts, CountCrossedCylindersOnceAlsoAtJoints) {
  const Body a = chain(4, 2.0);
  const Body b = chain(3, 0.9);
  for (int i = 0; i <= 400; ++i) {
    const double x = -0.3 + 0.6 * i / 400;
    StructurePair structure_pair(a, b, kRange);
    const Resultant found = at(structure_pair, b, {{0, 0, 1.2}, {x, 0.01, kHeight}});
    EXPECT_NEAR(found.force.z(), kOverlap, 1e-12 * kRange) << x;
    EXPECT_LT(found.force.head<2>().norm(), 1e-12 * kRange) << x;
  }
}

TEST(StructureContacts, CarryALoweredSheetOnAllItsNodes) {
  const Body table = sheet(2, 2, 3.0, 3.0);
  const Body cloth = sheet(6, 6, 1.2, 1.2, Cut::alternating);
  StructurePair structure_pair(table, cloth, kRange);
  structure_pair.place(moved(cloth, {0, 0, 0.2}, {0.1, 0.05, kHeight}));
  for (std::size_t i = structure_pair.first_node_of_b(); i < structure_pair.positions().size();
       ++i) {
    EXPECT_GT(structure_pair.forces()[i].z(), 0.0) << "node " << i;
  }
}

// Where it crosses the seam moves along all of it with the least turn: nothing may depend on that.
TEST(StructureContacts, PushACylinderAcrossASeamNoHarderWhateverTheAngle) {
  const Body a = sheet(1, 1, 2.0, 2.0);  // its seam is the diagonal
  const Body b = chain(1, 0.9);
  for (const double slope : {0.0, 1e-5, 1e-4, 2.5e-4, 2e-3}) {
    for (const double angle : {1e-13, 1e-11, 1e-9, 1e-7, 1e-5, 1e-3, 1e-1}) {
      for (const double along : {-0.3, 0.0, 0.17}) {
        StructurePair structure_pair(a, b, kRange);
        const double turn = -0.25 * std::numbers::pi + angle;
        const Vec3 shift(along * std::cos(turn), along * std::sin(turn), kHeight);
        const Resultant found = at(structure_pair, b, {{0.0, slope, turn}, shift});
        for (const Vec3& force : structure_pair.forces())
          EXPECT_LT(force.norm(), 1.1 * found.force.norm()) << slope << ' ' << angle;
        EXPECT_LT(found.force.head<2>().norm(), 1e-2 * found.force.z()) << slope << ' ' << angle;
      }
    }
  }
}

TEST(StructureContacts, CountACylinderAlongASeamOnce) {
  const Body a = sheet(4, 4, 2.0, 2.0);
  const Body b = chain(3, 0.9);
  const double contacts = (0.9 + kRange) / kRange;
  for (const double y : {-1e-3, -1e-12, -1e-17, 0.0, 1e-17, 1e-12, 1e-3}) {
    StructurePair structure_pair(a, b, kRange);
    const Resultant found = at(structure_pair, b, {{0, 0, 0}, {0.05, y, kHeight}});
    EXPECT_NEAR(found.force.z() / kOverlap, contacts, 1e-6 * contacts) << y;
  }
}

// Most of the bar is below the plane of the facet that its short end lies over, beyond the ridge.
TEST(StructureContacts, CountABarAcrossARidgeOnceWhicheverSideMostOfItIsOn) {
  Body ridge = sheet(2, 2, 1.0, 1.0);
  for (Vec3& x : ridge.x) x.z() = -0.2 * std::abs(x.y());
  for (const double overlap : {1e-5, 1e-4, 1e-3}) {
    Body bar;
    bar.x = {{0.1, -1.5, kRange - overlap}, {0.1, 0.3, kRange - overlap}};
    bar.cylinders = {{0, 1}};
    StructurePair structure_pair(ridge, bar, kRange);
    structure_pair.place(bar);
    // In range is what is nearer to the ridge than overlap / 0.2 on either side: 0.1 of a range.
    EXPECT_GT(structure_pair.energy(), (1.0 - 1e-9) * 0.5 * overlap * overlap) << overlap;
    EXPECT_LT(structure_pair.energy(), 1.1 * 0.5 * overlap * overlap) << overlap;
  }
}

TEST(StructureContacts, AnswerCoresThatMeetWithFiniteForces) {
  const Pose poses[] = {{{0, 0, 0}, {0, 0, 0}},
                        {{0, 0, 0.3}, {0.1, 0.05, 0}},
                        {{0, 0.7, 0}, {0.1, 0.05, 0}},
                        {{0.5 * std::numbers::pi, 0, 0}, {0, 0, 0}}};
  for (const Body& a : {sheet(2, 2, 1.0, 1.0), chain(3, 1.2)}) {
    for (const Body& b :
         {sheet(2, 2, 1.0, 1.0), sheet(1, 1, 0.4, 0.4), chain(3, 1.2), chain(2, 1)}) {
      for (const Pose& pose : poses) {
        StructurePair structure_pair(a, b, kRange);
        at(structure_pair, b, pose);
        EXPECT_TRUE(std::isfinite(structure_pair.energy()));
        for (const Vec3& force : structure_pair.forces()) EXPECT_TRUE(force.allFinite());
      }
    }
  }
}

// What pushes on either side of a crossing cancels, and what is left acts far from where it came
// from: friction there would turn nodes by levers of metres.
TEST(StructureContacts, KeepTheirPlaceAmongTheNodesWhereForcesCancel) {
  const Body square = sheet(1, 1, 1.0, 1.0);
  int records = 0;
  for (const double offset : {1e-6, 1e-5, 1e-4, 1e-3, -1e-5}) {
    for (const double turn : {0.0, 0.3, 1.0}) {
      StructurePair structure_pair(square, square, kRange);
      at(structure_pair, square, {{0.1, 0.0, turn}, {0.01, 0.02, offset}});
      structure_pair.contacts().for_each_record(
          structure_pair.positions(), [&](const contact::ContactRecord& record) {
            ++records;
            EXPECT_LT(record.point.cwiseAbs().maxCoeff(), 0.8) << offset << ' ' << turn;
          });
    }
  }
  EXPECT_GT(records, 0);
}

/// Random poses of random bodies, from parallel to steep, whose cores do not meet.
template <class Visit>
void for_each_random_structure_pair(int count, Visit visit) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int k = 0; k < count; ++k) {
    const double tilt = k % 4 == 0 ? 0.0 : k % 4 == 1 ? 1e-4 : k % 4 == 2 ? 2e-3 : 0.3;
    const Body a = k % 2 == 0
                       ? sheet(3, 2, 1.3, 1.0, Cut::alternating, 1u + static_cast<unsigned>(k))
                       : chain(4, 1.3);
    const Body b = k % 3 == 0 ? chain(3, 0.9) : sheet(2, 3, 0.8, 0.9, Cut::one_way, 5);
    const double turn = k % 5 == 0 ? 3e-3 : 1.0;
    Body placed = moved(b, {tilt * u(random), tilt * u(random), turn * u(random)},
                        {0.1 * u(random), 0.02 * u(random), 0.0});
    double lowest = 0.0;
    for (const Vec3& x : placed.x) lowest = std::min(lowest, x.z());
    for (Vec3& x : placed.x) x.z() += kRange - 0.006 - lowest;
    visit(a, placed, k);
  }
}

TEST(StructureContacts, BalanceForcesAndMoments) {
  for_each_random_structure_pair(60, [](const Body& a, const Body& b, int k) {
    StructurePair structure_pair(a, b, kRange);
    structure_pair.place(b);
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    double scale = 0.0;
    for (std::size_t i = 0; i < structure_pair.positions().size(); ++i) {
      force += structure_pair.forces()[i];
      moment += structure_pair.positions()[i].cross(structure_pair.forces()[i]);
      scale += structure_pair.forces()[i].norm();
    }
    EXPECT_LE(force.norm(), 1e-12 * scale) << k;
    EXPECT_LE(moment.norm(), 1e-12 * scale) << k;
  });
}

TEST(StructureContacts, PushAgainstTheGradientOfTheirEnergy) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for_each_random_structure_pair(60, [&](const Body& a, const Body& b, int k) {
    StructurePair structure_pair(a, b, kRange);
    std::vector<Vec3> direction;
    for (std::size_t i = 0; i < b.x.size(); ++i)
      direction.emplace_back(normal(random), normal(random), normal(random));
    // Central differences: error of order h^2 times the third derivative, about (k / largest tilt)
    // / (largest tilt * size)^2 where bodies are nearly parallel.
    const Slope slope = slope_along(structure_pair, b, direction, 2e-8);
    EXPECT_NEAR(slope.power, -slope.change, 2e-5 * slope.scale) << k;
  });
}

TEST(StructureContacts, GainNoEnergyInAClosedCycle) {
  const Body a = sheet(3, 3, 2.0, 2.0, Cut::alternating, 7);
  const Body b = sheet(2, 2, 0.5, 0.5, Cut::one_way, 3);
  StructurePair structure_pair(a, b, kRange);
  const auto pose = [](double s) {
    const double t = 2.0 * std::numbers::pi * s;
    return Pose{{0.01 * std::sin(t), 0.01 * std::cos(2 * t) - 0.01, 0.4 * std::sin(t)},
                {0.9 * std::sin(t), 0.3 * std::sin(2 * t), kHeight + 0.004 * std::sin(3 * t)}};
  };
  double work = 0.0, turned_over = 0.0;
  constexpr int kSteps = 4000;
  Body before = moved(b, pose(0.0).turns, pose(0.0).shift);
  for (int i = 1; i <= kSteps; ++i) {
    const Pose now = pose(static_cast<double>(i) / kSteps);
    const Body after = moved(b, now.turns, now.shift);
    Body middle = after;
    for (std::size_t n = 0; n < after.x.size(); ++n) middle.x[n] = 0.5 * (before.x[n] + after.x[n]);
    structure_pair.place(middle);
    double step = 0.0;
    for (std::size_t n = 0; n < after.x.size(); ++n)
      step += structure_pair.forces()[structure_pair.first_node_of_b() + n].dot(after.x[n] -
                                                                                before.x[n]);
    work += step;
    turned_over += std::abs(step);
    before = after;
  }
  EXPECT_LT(std::abs(work), 1e-4 * turned_over);
}

}  // namespace
}  // namespace plekton::test::structure_contacts_test
