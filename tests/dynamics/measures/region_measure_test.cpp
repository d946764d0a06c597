// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/region_measure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace plekton::dynamics::region_measure_test {
namespace {

using contact::BodyKind;
using contact::ContactRecord;
using geometry::BallRegion;
using geometry::Box;
using geometry::NodeId;

constexpr double kRounding = 1e-14;

/// Spheres of radius 1/2 and contacts that a test makes of them.
struct Made {
  std::vector<Vec3> x;
  std::vector<geometry::Sphere> spheres;
  std::vector<ContactRecord> contacts;
  std::vector<bool> is_grain;

  void add(const Vec3& centre) {
    spheres.push_back({{geometry::id_at<NodeId>(x.size())}, 0.5});
    x.push_back(centre);
    is_grain.push_back(true);
  }
  /// @param force  N, on b
  void touch(int a, int b, const Vec3& force) {
    ContactRecord contact;
    contact.a = {BodyKind::sphere, a, {}};
    contact.b = {BodyKind::sphere, b, {}};
    contact.point_a = x[static_cast<std::size_t>(a)];
    contact.point_b = x[static_cast<std::size_t>(b)];
    contact.point = 0.5 * (contact.point_a + contact.point_b);
    contact.normal = (contact.point_b - contact.point_a).normalized();
    contact.gap = -1e-3;
    contact::set_force(contact, force);
    contacts.push_back(contact);
  }
  /// @param force  N, on the plane
  void touch_plane(int a, const Vec3& foot, const Vec3& force) {
    ContactRecord contact;
    contact.a = {BodyKind::sphere, a, {}};
    contact.b = {BodyKind::plane, 0, {}};
    contact.point_a = x[static_cast<std::size_t>(a)];
    contact.point_b = contact.point = foot;
    contact.normal = (foot - contact.point_a).normalized();
    contact.gap = -1e-3;
    contact::set_force(contact, force);
    contacts.push_back(contact);
  }
  SampleView view() const { return {x, spheres, is_grain, contacts}; }
};

/// A cubic crystal of n³ unit cells from the origin on, between walls; every contact along an axis
/// bears the force of that axis.
Made crystal(int n, const Vec3& forces) {
  Made made;
  const auto number = [&](int i, int j, int k) { return (k * n + j) * n + i; };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) made.add(Vec3(i + 0.5, j + 0.5, k + 0.5));
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const std::array<int, 3> place{i, j, k};
        const int own = number(i, j, k);
        for (int axis = 0; axis < 3; ++axis) {
          const Vec3 along = Vec3::Unit(axis);
          const Vec3& centre = made.x[static_cast<std::size_t>(own)];
          const std::size_t a = static_cast<std::size_t>(axis);
          if (place[a] == 0) made.touch_plane(own, centre - 0.5 * along, -forces[axis] * along);
          if (place[a] == n - 1)
            made.touch_plane(own, centre + 0.5 * along, forces[axis] * along);
          else
            made.touch(own, number(i + (axis == 0), j + (axis == 1), k + (axis == 2)),
                       forces[axis] * along);
        }
      }
    }
  }
  return made;
}

TEST(RegionMeasure, OfACubicCrystalIsKnown) {
  const Made made = crystal(4, {1.0, 2.0, 3.0});

  const RegionMeasure all = measure_region(Box{Vec3::Zero(), Vec3::Constant(4.0)}, made.view());

  EXPECT_EQ(all.volume, 64.0);
  EXPECT_NEAR(all.porosity, 1.0 - std::numbers::pi / 6.0, kRounding);
  EXPECT_EQ(all.grains, 64U);
  EXPECT_EQ(all.rattlers, 0U);
  EXPECT_EQ(all.coordination, 6.0);  // with the walls
  EXPECT_EQ(all.contacts, 3U * 4U * 4U * 3U);
  // A force on every unit of area across each axis.
  EXPECT_LT((all.stress + Mat3(Vec3(1.0, 2.0, 3.0).asDiagonal())).norm(), kRounding);
  EXPECT_NEAR(all.mean_pressure(), 2.0, kRounding);
  EXPECT_LT((all.fabric - Mat3::Identity() / 3.0).norm(), kRounding);
}

// Whatever is cut: the bond function makes the stress of a box of unit columns the same everywhere.
TEST(RegionMeasure, HasTheStressOfAUniformSampleInAnyBoxOfWholeColumns) {
  const Made made = crystal(4, {2.0, 2.0, 2.0});

  const RegionMeasure part = measure_region(Box{{0.0, 0.0, 0.9}, {4.0, 4.0, 2.3}}, made.view());

  EXPECT_NEAR(part.stress(2, 2), -2.0, kRounding);
}

TEST(RegionMeasure, OfPartsOfASpaceAddsUpToThatOfTheSpace) {
  const Made made = crystal(3, {1.0, 2.0, 3.0});
  const Box whole{Vec3::Zero(), Vec3::Constant(3.0)};
  Box low = whole, high = whole;
  low.upper[0] = high.lower[0] = 1.234;

  const RegionMeasure all = measure_region(whole, made.view());
  const RegionMeasure a = measure_region(low, made.view());
  const RegionMeasure b = measure_region(high, made.view());

  EXPECT_LT((a.stress * a.volume + b.stress * b.volume - all.stress * all.volume).norm(), 1e-12);
  EXPECT_NEAR(a.porosity * a.volume + b.porosity * b.volume, all.porosity * all.volume, 1e-12);
  EXPECT_EQ(a.grains + b.grains, all.grains);
}

// Christoffersen, Mehrabadi & Nemat-Nasser: whatever the places of the grains, in equilibrium the
// stress times the volume is the sum of wall force (x) place. Here a bent column under an axial
// force F over a height h: -F h along z.
TEST(RegionMeasure, HasTheStressThatTheWallsExert) {
  Made made;
  made.add({0.0, 0.0, 0.5});
  made.add({0.6, 0.0, 1.3});
  made.add({0.0, 0.0, 2.1});
  const Vec3 force(0.0, 0.0, 5.0);
  made.touch_plane(0, {0.0, 0.0, 0.0}, -force);
  made.touch(0, 1, force);
  made.touch(1, 2, force);
  made.touch_plane(2, {0.0, 0.0, 2.6}, force);

  const RegionMeasure all = measure_region(Box{{-1.0, -1.0, 0.0}, {2.0, 1.0, 2.6}}, made.view());

  EXPECT_NEAR(all.stress(2, 2) * all.volume, -5.0 * 2.6, kRounding * 13.0);
  EXPECT_NEAR(all.stress(0, 0), 0.0, kRounding);
}

TEST(RegionMeasure, LeavesRattlersOutWhereItIsAsked) {
  Made made = crystal(2, Vec3::Ones());
  made.add({10.0, 10.0, 10.0});  // touches nothing
  made.add({12.0, 10.0, 10.0});  // one contact, with a wall
  made.touch_plane(9, {12.0, 10.0, 9.5}, -Vec3::UnitZ());

  const RegionMeasure all =
      measure_region(Box{Vec3::Constant(-1.0), Vec3::Constant(20.0)}, made.view());

  EXPECT_EQ(all.grains, 10U);
  EXPECT_EQ(all.rattlers, 2U);
  EXPECT_DOUBLE_EQ(all.coordination, (8.0 * 6.0 + 1.0) / 10.0);
  EXPECT_DOUBLE_EQ(all.coordination_without_rattlers, 6.0);
}

TEST(RegionMeasure, CountsNoContactOfBodiesThatOnlyComeNear) {
  Made made;
  made.add({0.0, 0.0, 0.0});
  made.add({1.0, 0.0, 0.0});
  made.touch(0, 1, Vec3::Zero());
  made.contacts[0].gap = 1e-6;

  const RegionMeasure apart = measure_region(BallRegion{Vec3::Zero(), 3.0}, made.view());
  made.contacts[0].is_bonded = true;
  const RegionMeasure glued = measure_region(BallRegion{Vec3::Zero(), 3.0}, made.view());

  EXPECT_EQ(apart.contacts, 0U);
  EXPECT_EQ(apart.coordination, 0.0);
  EXPECT_TRUE(std::isnan(apart.coordination_without_rattlers));
  EXPECT_TRUE(std::isnan(apart.fabric(0, 0)));
  EXPECT_EQ(glued.contacts, 1U);
  EXPECT_EQ(glued.coordination, 1.0);
}

TEST(RegionMeasure, TakesSpheresOfRigidBodiesForWalls) {
  Made made;
  made.add({0.0, 0.0, 0.0});
  made.add({1.0, 0.0, 0.0});
  made.touch(0, 1, {4.0, 0.0, 0.0});
  made.is_grain[1] = false;

  const RegionMeasure measure =
      measure_region(Box{Vec3::Constant(-2.0), Vec3::Constant(2.0)}, made.view());

  EXPECT_EQ(measure.grains, 1U);
  EXPECT_EQ(measure.contacts, 0U);
  EXPECT_EQ(measure.coordination, 1.0);
  // Up to the contact point, half a metre.
  EXPECT_NEAR(measure.stress(0, 0), -4.0 * 0.5 / 64.0, kRounding);
  EXPECT_NEAR(measure.porosity, 1.0 - std::numbers::pi / 6.0 / 64.0, kRounding);
}

TEST(RegionMeasure, HasTheDeviatorOfATriaxialTest) {
  RegionMeasure measure;
  measure.stress = Vec3(-1.0, -1.0, -4.0).asDiagonal();

  EXPECT_DOUBLE_EQ(measure.mean_pressure(), 2.0);
  EXPECT_DOUBLE_EQ(measure.deviator_stress(), 3.0);
}

TEST(BoxAround, HoldsAllGrains) {
  Made made = crystal(2, Vec3::Ones());
  made.add({9.0, 0.0, 0.0});
  made.is_grain.back() = false;

  EXPECT_EQ(box_around(made.view()).lower, Vec3::Zero());
  EXPECT_EQ(box_around(made.view()).upper, Vec3::Constant(2.0));
  EXPECT_EQ(box_around({}).upper, Vec3::Zero());
}

}  // namespace
}  // namespace plekton::dynamics::region_measure_test
