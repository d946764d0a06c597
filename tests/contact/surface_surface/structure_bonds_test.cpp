// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/cohesive_frictional.hpp"
#include "tests/support/bodies_of_cells.hpp"
#include "tests/support/hollow_ball.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/structure_gradient.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

/// Structures that are glued to each other: k = 1 N/m for a contact, which a bond stretches by
/// kLimit before it fails.
namespace plekton::test::structure_bonds_test {
namespace {

using contact::CohesiveFrictional;
using StructurePair = StructurePairUnder<CohesiveFrictional>;

constexpr double kRange = 0.1;
constexpr double kOverlap = 0.005;
constexpr double kLimit = 0.002;
/// Pa, of a bond that carries 1 N/m kLimit.
constexpr double kStrength = kLimit / (0.25 * kRange * kRange);
/// Of the largest force: what rounding leaves of features that are in range and cancel.
constexpr double kRounding = 1e-9;
constexpr CohesiveFrictional::Properties kFragile{kStrength, 0.0, 0.0};

/// A body above another, which it touches at a gap of 0.
struct Lying {
  const char* name;
  Body a;
  Body b;
  Vec3 turns;
  Vec3 shift;
  double contacts;
};

std::vector<Lying> bodies_that_lie_on_each_other() {
  const double side = 0.8, length = 0.9;
  const double area = side * side / (kRange * kRange);
  const Body plate = sheet(3, 3, 2.0, 2.0, Cut::alternating);
  std::vector<Lying> all;
  for (const int cells : {1, 2, 4})
    all.push_back({"plate on plate",
                   plate,
                   sheet(cells, cells, side, side, Cut::one_way, 3),
                   {0, 0, 0.3},
                   {0.11, 0.07, 0},
                   area});
  for (const int count : {1, 3})
    all.push_back({"chain on plate",
                   plate,
                   chain(count, length),
                   {0, 0, 0.3},
                   {0.05, 0.02, 0},
                   1.0 + length / kRange});
  all.push_back({"chain along chain",
                 chain(4, 1.3),
                 chain(3, length),
                 {0, 0, 0},
                 {0.1, 0, 0},
                 1.0 + length / kRange});
  // Over the middle of a cylinder, over a joint, and joint on joint.
  for (const double x : {0.15, 0.0})
    all.push_back(
        {"chain across chain", chain(4, 1.3), chain(3, length), {0, 0, 1.2}, {x, 0, 0}, 1.0});
  all.push_back({"joint on joint", chain(4, 1.3), chain(4, length), {0, 0, 1.2}, {0, 0, 0}, 1.0});
  return all;
}

Body lifted(const Lying& lying, double gap) {
  return moved(lying.b, lying.turns, lying.shift + Vec3(0, 0, kRange + gap));
}

TEST(StructureBonds, PullWithTheContactsThatWereGluedUntilTheirStrength) {
  for (const Lying& lying : bodies_that_lie_on_each_other()) {
    SCOPED_TRACE(lying.name);
    StructurePair structure_pair(lying.a, lying.b, kRange, kFragile);
    structure_pair.place(lifted(lying, -kOverlap));
    const double limit = lying.contacts * kLimit;
    EXPECT_NEAR(structure_pair.force_on_b().z(), lying.contacts * kOverlap, kRounding * limit);
    for (const double part : {0.0, 0.3, 0.9999, 0.2, 0.9999}) {
      structure_pair.place(lifted(lying, part * kLimit));
      EXPECT_NEAR(structure_pair.force_on_b().z(), -part * limit, kRounding * limit) << part;
      EXPECT_LT((structure_pair.force_on_a() + structure_pair.force_on_b()).norm(),
                1e-15 * lying.contacts);
      EXPECT_NEAR(structure_pair.energy(), 0.5 * part * part * kLimit * limit,
                  kRounding * kLimit * limit);
    }
    structure_pair.place(lifted(lying, 1.0001 * kLimit));
    EXPECT_EQ(structure_pair.force_on_b().norm(), 0.0);
    EXPECT_EQ(structure_pair.energy(), 0.0);
    structure_pair.place(lifted(lying, 0.5 * kLimit));
    EXPECT_EQ(structure_pair.force_on_b().norm(), 0.0);
    EXPECT_EQ(structure_pair.patches(), 0u);
  }
}

// Facets beside each other whose rims fall together have no area in common, and slopes that cancel;
// all around a mesh of a net that lies flat the places are at one distance.
TEST(StructureBonds, CountBodiesThatFallTogetherAsTheyComeApartSlowly) {
  const Body square = sheet(3, 3, 0.9, 0.9);
  const double area = 0.9 * 0.9 / (kRange * kRange);
  const Body net = square_net_of(1, 0.6);
  double length = 0.0;
  for (const auto& [first, last] : net.cylinders)
    length +=
        (net.x[static_cast<std::size_t>(first)] - net.x[static_cast<std::size_t>(last)]).norm();
  const Lying cases[] = {
      {"equal sheets", square, square, {0, 0, 0}, {0, 0, 0}, area},
      {"sheets of one outline", square, sheet(2, 2, 0.9, 0.9), {0, 0, 0}, {0, 0, 0}, area},
      {"mesh on plate",
       sheet(2, 2, 3.0, 3.0),
       net,
       {0, 0, 0},
       {0.03, 0.02, 0},
       1.0 + length / kRange}};
  for (const Lying& lying : cases) {
    SCOPED_TRACE(lying.name);
    StructurePair structure_pair(lying.a, lying.b, kRange, kFragile);
    for (int i = 0; i < 100; ++i) structure_pair.place(lifted(lying, -kOverlap * (1.0 - 0.01 * i)));
    structure_pair.place(lifted(lying, 0.5 * kLimit));
    const double limit = lying.contacts * kLimit;
    EXPECT_NEAR(structure_pair.force_on_b().z(), -0.5 * limit, 0.1 * limit);
  }
}

/// Fragile ones break in shear, ductile ones slip at their strength.
TEST(StructureBonds, ShearWithTheContactsThatWereGluedUntilTheirStrength) {
  constexpr double kRatio = 0.3;
  constexpr double kShear = 0.1 * kLimit;  // N, of a bond
  for (const double rupture_distance : {0.0, kLimit}) {
    for (const Lying& lying : bodies_that_lie_on_each_other()) {
      SCOPED_TRACE(lying.name);
      // Chains that lie along each other would roll off sideways.
      const bool is_along = lying.turns.isZero();
      const Vec3 way = is_along ? Vec3::UnitX() : Vec3(std::cos(0.7), std::sin(0.7), 0.0);
      StructurePair structure_pair(lying.a, lying.b, kRange,
                                   {kStrength, 0.1 * kStrength, rupture_distance}, kRatio);
      structure_pair.place(lifted(lying, -kOverlap));
      double slid = 0.0;
      const auto slide_by = [&](double far) {
        slid += far;
        structure_pair.slide(moved(lifted(lying, -kOverlap), Vec3::Zero(), slid * way));
        return Vec3(structure_pair.force_on_b() / lying.contacts);
      };
      for (const double far : {0.5 * kShear / kRatio, 0.4999 * kShear / kRatio}) {
        const Vec3 force = slide_by(far);
        // The line through the points of a bond turns by the way over its length.
        const double turn = slid / (kRange - kOverlap);
        EXPECT_NEAR(force.z(), kOverlap, turn * kShear);
        EXPECT_NEAR(force.dot(way), -kRatio * slid, turn * turn * kShear);
        EXPECT_NEAR(force.dot(way.cross(Vec3::UnitZ())), 0.0, turn * turn * kShear);
      }
      const Vec3 force = slide_by(0.01 * kShear / kRatio);
      EXPECT_NEAR(force.dot(way), rupture_distance > 0.0 ? -kShear : 0.0, 1e-3 * kShear);
    }
  }
}

TEST(StructureBonds, YieldByTheRuptureDistance) {
  const CohesiveFrictional::Properties ductile{kStrength, 0.0, 0.5 * kLimit};
  for (const Lying& lying : bodies_that_lie_on_each_other()) {
    SCOPED_TRACE(lying.name);
    StructurePair structure_pair(lying.a, lying.b, kRange, ductile);
    const double limit = lying.contacts * kLimit;
    structure_pair.place(lifted(lying, -kOverlap));
    const auto force_at = [&](double gap) {
      structure_pair.place(lifted(lying, gap * kLimit));
      return structure_pair.force_on_b().z() / limit;
    };
    EXPECT_NEAR(force_at(0.5), -0.5, kRounding);
    EXPECT_NEAR(force_at(1.4), -1.0, kRounding);  // has yielded by 0.4
    EXPECT_NEAR(force_at(1.0), -0.6, kRounding);
    EXPECT_NEAR(force_at(-0.1), 0.5, kRounding);  // pressed from 0.4 on
    EXPECT_NEAR(force_at(1.4999), -1.0, kRounding);
    EXPECT_EQ(force_at(1.5001), 0.0);
  }
}

TEST(StructureBonds, DoNotHoldWhatHasNotTouched) {
  for (const Lying& lying : bodies_that_lie_on_each_other()) {
    StructurePair structure_pair(lying.a, lying.b, kRange, kFragile);
    structure_pair.place(lifted(lying, 0.5 * kLimit));
    EXPECT_EQ(structure_pair.force_on_b().norm(), 0.0) << lying.name;
  }
}

TEST(StructureBonds, AreFormedAnewWhereBodiesHaveParted) {
  for (const Lying& lying : bodies_that_lie_on_each_other()) {
    StructurePair structure_pair(lying.a, lying.b, kRange, kFragile);
    for (const double gap : {-kOverlap, 2.0 * kLimit, -kOverlap, 0.5 * kLimit})
      structure_pair.place(lifted(lying, gap));
    EXPECT_NEAR(structure_pair.force_on_b().z(), -0.5 * kLimit * lying.contacts,
                kRounding * kLimit * lying.contacts)
        << lying.name;
  }
}

/// Force (N) up of bonds for some contacts, between points that were opposite each other and are
/// now a distance (m) apart sideways at a gap (m).
double pull_of(double contacts, double sideways, double gap) {
  const double distance = std::hypot(sideways, kRange + gap);
  return -contacts * std::max(0.0, distance - kRange) * (kRange + gap) / distance;
}

// The near points pass from cell to cell; the material points that are glued do not.
TEST(StructureBonds, AreNotMoreWhereContactsSlideOverJointsAndFacets) {
  const CohesiveFrictional::Properties strong{10.0 * kStrength, 0.0, 0.0};
  const Body plate = sheet(3, 3, 2.0, 2.0, Cut::alternating, 5);
  const double length = 0.6;
  const std::vector<Lying> all{
      {"chain over a joint", chain(4, 1.3), chain(3, length), {0, 0, 1.2}, {-0.01, 0, 0}, 1.0},
      {"joint over a joint", chain(4, 1.3), chain(2, length), {0, 0, 1.2}, {-0.01, 0, 0}, 1.0},
      {"chain over facets",
       plate,
       chain(3, length),
       {0, 0, 0.3},
       {-0.01, 0.1, 0},
       1.0 + length / kRange},
      {"plate over facets",
       plate,
       sheet(3, 3, length, length, Cut::one_way, 3),
       {0, 0, 0.3},
       {-0.01, 0.1, 0},
       length * length / (kRange * kRange)}};
  for (const Lying& lying : all) {
    SCOPED_TRACE(lying.name);
    StructurePair structure_pair(lying.a, lying.b, kRange, strong);
    const auto force_at = [&](double sideways, double gap) {
      Body b = lifted(lying, gap);
      for (Vec3& x : b.x) x.x() += sideways;
      structure_pair.place(b);
      return structure_pair.force_on_b().z();
    };
    const double tolerance = 1e-6 * lying.contacts * kLimit;
    const double pressed = force_at(0.0, -kOverlap);
    for (double s = 0.0; s <= 0.02; s += 2.5e-4)
      EXPECT_NEAR(force_at(s, -kOverlap), pressed, tolerance) << s;
    for (double s = 0.02; s >= 0.0; s -= 2.5e-4)
      EXPECT_NEAR(force_at(s, 0.5 * kLimit), pull_of(lying.contacts, s, 0.5 * kLimit), tolerance)
          << s;
  }
}

// Plates and chains that come off one end first, with bonds of all lengths.
TEST(StructureBonds, PullAgainstTheGradientOfTheirEnergy) {
  Random random(7);
  for (const Lying& lying : bodies_that_lie_on_each_other()) {
    SCOPED_TRACE(lying.name);
    StructurePair structure_pair(lying.a, lying.b, kRange, {10.0 * kStrength, 0.0, 0.0});
    structure_pair.place(lifted(lying, -kOverlap));
    Body off = lifted(lying, 0.5 * kLimit);
    for (Vec3& x : off.x) x.z() += 0.01 * (x.x() + 0.6) + 1e-4 * random.uniform(-1.0, 1.0);
    std::vector<Vec3> direction;
    for (std::size_t i = 0; i < off.x.size(); ++i) direction.push_back(random.in_cube(1.0));
    const Slope slope = slope_along(structure_pair, off, direction, 1e-7);
    EXPECT_GT(slope.scale, 0.0);
    EXPECT_NEAR(slope.power, -slope.change, 1e-6 * slope.scale);
    const Vec3 about = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    for (std::size_t i = 0; i < structure_pair.positions().size(); ++i)
      moment += (structure_pair.positions()[i] - about).cross(structure_pair.forces()[i]);
    EXPECT_LT(moment.norm(), 1e-14 * slope.scale);
  }
}

// Its first end comes off while the other is still held: more than one contact's strength is needed
// only little by little.
TEST(StructureBonds, OfAPlateThatPeelsOffBreakOneAfterTheOther) {
  const Lying lying = bodies_that_lie_on_each_other()[2];
  StructurePair structure_pair(lying.a, lying.b, kRange, kFragile);
  structure_pair.place(lifted(lying, -kOverlap));
  const auto peeled = [&](double slope) {
    Body b = lifted(lying, -kOverlap);
    for (Vec3& x : b.x) x.z() += slope * (x.x() + 0.6);
    return b;
  };
  std::vector<double> energies;
  for (double slope = 0.0; slope < 0.1; slope += 2e-4) {
    structure_pair.place(peeled(slope));
    energies.push_back(structure_pair.energy());
    EXPECT_GT(structure_pair.force_on_b().z(), -0.5 * lying.contacts * kLimit);
  }
  EXPECT_EQ(structure_pair.force_on_b().norm(), 0.0);
  EXPECT_EQ(structure_pair.energy(), 0.0);
}

/// A strip that is folded over: its upper half lies on the lower one at a gap (m), 0.3 m beside the
/// fold and beyond.
std::vector<Vec3> folded(const Body& strip, double gap) {
  std::vector<Vec3> x = strip.x;
  for (Vec3& node : x) {
    const double beyond = node.x() - 0.3;
    if (beyond > 0.0) node = Vec3(0.3 - beyond, node.y(), kRange + gap);
  }
  return x;
}

/// N, up, on both halves of a strip that was folded over and is now at a gap.
std::array<double, 2> forces_of_folded(const CohesiveFrictional::Properties& properties,
                                       double gap) {
  const Body strip = sheet(8, 2, 2.4, 0.6);
  std::vector<Facet> facets;
  for (const auto& f : strip.facets)
    facets.push_back({{NodeId{f[0]}, NodeId{f[1]}, NodeId{f[2]}}, 0.5 * kRange});
  const geometry::Surface surface({}, facets, strip.x.size());
  geometry::ThreadPool pool;
  geometry::CellNeighbours neighbours(surface, strip.x, 0.0, true);
  contact::StructureContacts contacts(surface);
  const contact::MaterialPairs materials({contact::Material{2.0 / kRange, 0.0, 0.0}},
                                         {{{contact::MaterialId{0}, contact::MaterialId{0}},
                                           contact::AnyLaw::of<CohesiveFrictional>(properties)}});
  const std::vector<Vec3> still(strip.x.size(), Vec3::Zero());
  NodeForces forces;
  for (const double now : {-kOverlap, gap}) {
    const std::vector<Vec3> x = folded(strip, now);
    if (neighbours.update(x, pool))
      contacts.rebuild(neighbours.pairs(), {materials, {}, {contact::MaterialId{0}}});
    contacts.advance({x, still, still}, 0.0, pool);
    forces = NodeForces(x.size());
    contacts.add_forces(forces);
  }
  std::array<double, 2> up{0.0, 0.0};
  for (std::size_t i = 0; i < strip.x.size(); ++i)
    up[strip.x[i].x() > 0.4 ? 1 : 0] += forces.force[i].z();
  return up;
}

// Over 0.6 by 0.6 m it lies flat; beside the fold it touches itself anyway.
TEST(StructureBonds, HoldASheetThatIsFoldedOver) {
  for (const double part : {0.2, 0.5, 0.9}) {
    const auto glued = forces_of_folded(kFragile, part * kLimit);
    const auto loose = forces_of_folded({}, part * kLimit);
    const double contacts = (loose[1] - glued[1]) / (part * kLimit);
    EXPECT_GT(contacts, 35.9);
    EXPECT_LT(contacts, 40.0);
    EXPECT_NEAR(glued[0] - loose[0], loose[1] - glued[1], 1e-13);
  }
}

}  // namespace
}  // namespace plekton::test::structure_bonds_test
