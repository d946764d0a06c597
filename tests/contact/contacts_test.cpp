// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neighbor/neighbours.hpp"
#include "tests/support/moving_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace plekton::test::contacts_test {
namespace {

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

TEST(Contacts, GiveTheSameBitsForAnyNumberOfThreads) {
  constexpr int kSpheres = 1600;  // several blocks of contacts for each thread
  MovingScene one(kSpheres, 0.05, 1, 1);
  MovingScene two(kSpheres, 0.05, 1, 2);
  MovingScene four(kSpheres, 0.05, 1, 4);
  for (int step = 0; step < 200; ++step) {
    for (MovingScene* scene : {&one, &two, &four}) scene->step(2e-3);
    for (const MovingScene* scene : {&two, &four}) {
      ASSERT_TRUE(same_bits(scene->forces().force, one.forces().force)) << "step " << step;
      ASSERT_TRUE(same_bits(scene->forces().torque, one.forces().torque)) << "step " << step;
      ASSERT_EQ(scene->contacts().dissipated(), one.contacts().dissipated());
      ASSERT_EQ(scene->contacts().counts().sphere_surface, one.contacts().counts().sphere_surface);
    }
  }
  const ContactCounts counts = one.contacts().counts();
  EXPECT_GE(counts.sphere_sphere, 600u);
  EXPECT_GE(counts.sphere_surface, 200u);
  EXPECT_GE(counts.with_planes, 200u);
}

/// But for the order in which up to some twenty contacts of a node are added.
void expect_same_sums(const std::vector<Vec3>& sums, const std::vector<Vec3>& expected) {
  double largest = 0.0;
  for (const Vec3& sum : expected) largest = std::max(largest, sum.cwiseAbs().maxCoeff());
  for (std::size_t i = 0; i < sums.size(); ++i)
    ASSERT_LE((sums[i] - expected[i]).cwiseAbs().maxCoeff(), 1e-14 * largest) << "node " << i;
}

TEST(Contacts, KeepTheirHistoriesWhenTheListsAreMadeAnew) {
  // The wider skin lists other pairs, in other places of the lists; what touches does not depend on
  // it.
  MovingScene wide(300, 0.5, 2, 1);
  MovingScene narrow(300, 1e-3, 2, 1);
  MovingScene none(300, 0.0, 2, 1);
  for (int step = 0; step < 200; ++step) {
    for (MovingScene* scene : {&wide, &narrow, &none}) scene->step(2e-3);
    for (const MovingScene* scene : {&narrow, &none}) {
      expect_same_sums(scene->forces().force, wide.forces().force);
      expect_same_sums(scene->forces().torque, wide.forces().torque);
    }
  }
  EXPECT_EQ(wide.contacts().neighbours().rebuild_count(), 1);
  EXPECT_GE(narrow.contacts().neighbours().rebuild_count(), 50);
  // The sum over the contacts is in another order.
  EXPECT_NEAR(narrow.contacts().dissipated(), wide.contacts().dissipated(),
              1e-12 * wide.contacts().dissipated());
}

/// One sphere that slides on a plane, the lists made anew every few steps.
TEST(Contacts, LoadOneSpringWhileASphereSlidesOnAPlane) {
  const std::vector<Sphere> spheres{{{NodeId{0}}, 0.5}};
  const Surface surface({}, {}, 1);
  const Material material{1e6, 0.5, 1e3};
  SceneContacts contacts(spheres, surface, {MaterialPairs({material}), {MaterialId{0}}, {}}, 0.05);
  const std::vector<Plane> planes{{Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), MaterialId{0}}};
  std::vector<Vec3> x{Vec3(0, 0, 0.49)};
  const std::vector<Vec3> v{Vec3(0.01, 0.02, 0)};
  const std::vector<Vec3> w{Vec3::Zero()};
  geometry::ThreadPool pool;
  for (int step = 1; step <= 100; ++step) {
    x[0] += v[0];
    NodeForces forces(1);
    contacts.advance({x, v, w}, planes, 1.0, pool, forces);
    const Vec3 expected = -0.5e6 * 0.5 * step * v[0];
    ASSERT_NEAR((forces.force[0] - forces.force[0][2] * Vec3::UnitZ() - expected).norm(), 0.0,
                1e-9 * expected.norm());
  }
  EXPECT_GE(contacts.neighbours().rebuild_count(), 30);
}

/// A body sinks towards a floor at z = 0 in small steps of which the length is known.
template <class Bodies>
void expect_the_floor_is_touched_at_once(SceneContacts& contacts, Bodies& x, double radius,
                                         double step) {
  const std::vector<Plane> planes{{Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), MaterialId{0}}};
  const std::vector<Vec3> zero(x.size(), Vec3::Zero());
  geometry::ThreadPool pool;
  NodeForces forces(x.size());
  while (x[0].z() > 0.9 * radius) {
    for (Vec3& position : x) position.z() -= step;
    contacts.advance({x, zero, zero, step}, planes, 1e-3, pool, forces);
    ASSERT_EQ(contacts.counts().with_planes > 0, x[0].z() < radius) << "at " << x[0].z();
  }
}

TEST(Contacts, SeeWhereAStructureMeetsAPlaneThoughThereAreNoSpheres) {
  std::vector<Vec3> x{Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 1, 1)};
  const std::vector<geometry::Facet> facets{{{NodeId{0}, NodeId{1}, NodeId{2}}, 0.1}};
  const Surface surface({}, facets, 3);
  const std::vector<Sphere> no_spheres;
  SceneContacts contacts(no_spheres, surface,
                         {MaterialPairs({Material{1e6, 0.5, 0.4}}), {}, {MaterialId{0}}}, 0.02);

  expect_the_floor_is_touched_at_once(contacts, x, 0.1, 1e-3);
}

TEST(Contacts, SeeWhereASphereMeetsAPlaneThoughTheSkinHasGrown) {
  std::vector<Vec3> x{Vec3(0, 0, 40)};
  const std::vector<Sphere> spheres{{{NodeId{0}}, 1.0}};
  const Surface surface({}, {}, 1);
  SceneContacts contacts(spheres, surface,
                         {MaterialPairs({Material{1e6, 0.5, 0.4}}), {MaterialId{0}}, {}}, 0.02);
  contacts.tune_skin(1.0);

  expect_the_floor_is_touched_at_once(contacts, x, 1.0, 0.04);

  EXPECT_GT(contacts.neighbours().skin(), 0.3);
}

TEST(Contacts, PushASphereOutHoweverDeepItStartsBehindAPlane) {
  std::vector<Vec3> x{Vec3(0, 0, 0)};
  const std::vector<Sphere> spheres{{{NodeId{0}}, 1.0}};
  const Surface surface({}, {}, 1);
  const std::vector<Plane> floor{{Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), MaterialId{0}}};
  const std::vector<Vec3> still(1, Vec3::Zero());
  geometry::ThreadPool pool(1);
  for (const double height : {0.5, -0.5, -1.0, -1.5, -4.0}) {
    SceneContacts contacts(spheres, surface,
                           {MaterialPairs({Material{1e6, 0.5, 0.4}}), {MaterialId{0}}, {}}, 0.02);
    x[0].z() = height;
    NodeForces forces(1);
    contacts.advance({x, still, still}, floor, 1e-3, pool, forces);

    // A few roundings of the stiffness 1e6 N/m times the overlap.
    EXPECT_NEAR(forces.force[0].z(), 1e6 * (1.0 - height), 1e-14 * 1e6 * 5.0) << height;
  }
}

}  // namespace
}  // namespace plekton::test::contacts_test
