// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_plane/plane_contacts.hpp"
#include "contact/sphere_sphere/sphere_contacts.hpp"
#include "tests/support/ball_on_surface.hpp"

#include <gtest/gtest.h>

/// Contacts give nothing to the whole: forces and moments of every kind of contact cancel to
/// round-off, and the elastic part is the gradient of its energy.
namespace plekton::test::momentum_test {
namespace {

using Law = LinearFrictional;

constexpr Material kMaterial{1e6, 0.7, 0.4};

struct Balance {
  Vec3 force = Vec3::Zero();
  Vec3 moment = Vec3::Zero();  ///< about the origin
  double largest = 0.0;        ///< N, largest force on a node
};

Balance balance_of(const NodeForces& forces, Positions x) {
  Balance balance;
  for (std::size_t i = 0; i < x.size(); ++i) {
    balance.force += forces.force[i];
    balance.moment += x[i].cross(forces.force[i]) + forces.torque[i];
    balance.largest = std::max(balance.largest, forces.force[i].norm());
  }
  return balance;
}

/// Round-off of a few dozen terms of the largest force, at distances of up to 10 m.
void expect_balanced(const Balance& balance) {
  EXPECT_NEAR(balance.force.norm(), 0.0, 1e-14 * balance.largest);
  EXPECT_NEAR(balance.moment.norm(), 0.0, 1e-13 * balance.largest);
}

TEST(Momentum, BalancesBetweenBalls) {
  Random random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const std::vector<SphereBody> balls{{NodeId{0}, 0.5, MaterialId{0}},
                                        {NodeId{1}, 0.3, MaterialId{0}}};
    const std::vector<geometry::IndexPair> pairs{{0, 1}};
    SphereContacts contacts;
    geometry::ThreadPool pool;
    contacts.rebuild(pairs, balls, MaterialPairs({kMaterial}), pool);
    const Vec3 place = random.in_cube(5.0);
    std::vector<Vec3> x{place, place + random.uniform(0.7, 0.799) * random.direction()};
    for (int step = 0; step < 5; ++step) {
      const std::vector<Vec3> v{random.in_cube(1.0), random.in_cube(1.0)};
      const std::vector<Vec3> w{random.in_cube(5.0), random.in_cube(5.0)};
      NodeForces forces(2);
      contacts.advance({x, v, w}, 1e-3, pool, forces);

      const Balance balance = balance_of(forces, x);
      ASSERT_GT(balance.largest, 0.0);
      expect_balanced(balance);
    }
  }
}

TEST(Momentum, IsHandedFromSphereToPlaneAtTheContactPoint) {
  Random random(2);
  for (int trial = 0; trial < 500; ++trial) {
    const std::vector<SphereBody> balls{{NodeId{0}, 0.5, MaterialId{0}}};
    const Plane plane{random.in_cube(5.0), random.direction(), random.in_cube(0.1), MaterialId{0}};
    const std::vector<Plane> planes{plane};
    const std::vector<geometry::IndexPair> pairs{{0, 0}};
    PlaneContacts contacts;
    contacts.rebuild(pairs, balls, planes, MaterialPairs({kMaterial}));
    const SphereBlocks no_blocks;
    contacts.share_out(balls, {&no_blocks, {}, nullptr});
    const double height = random.uniform(0.4, 0.499);
    const std::vector<Vec3> x{plane.point + 2.0 * plane.normal.unitOrthogonal() +
                              height * plane.normal};
    const std::vector<Vec3> v{random.in_cube(1.0)};
    const std::vector<Vec3> w{random.in_cube(5.0)};
    geometry::ThreadPool pool;
    NodeForces forces(1);
    contacts.advance({x, v, w}, planes, 1e-3, pool, forces);

    const PlaneAction& action = contacts.action_on(0);
    const Vec3& force = action.force;

    EXPECT_EQ(forces.force[0], -force);
    const Vec3 contact_point = x[0] - (0.5 + 0.5 * (height - 0.5)) * plane.normal;
    const Vec3 moment = contact_point.cross(force) + x[0].cross(forces.force[0]) + forces.torque[0];
    EXPECT_NEAR(moment.norm(), 0.0, 1e-13 * force.norm());
    const Vec3 about_point = (contact_point - plane.point).cross(force);
    EXPECT_NEAR((action.moment - about_point).norm(), 0.0, 1e-13 * force.norm());
    EXPECT_NEAR(action.push, -force.dot(plane.normal), 1e-13 * force.norm());
  }
}

/// Surfaces on which a ball of range 1 near the origin touches several features that hang together,
/// or not.
std::vector<Complex> surfaces_of_many_terms(Random& random) {
  std::vector<Complex> surfaces;
  for (int k = 0; k < 40; ++k) {
    surfaces.push_back(
        rotated(roughened(centred(sheet(6), 6, 0.5), 0.5, 0.1, random), random.rotation()));
    surfaces.push_back(rotated(book({80.0, 160.0, 250.0}), random.rotation()));
    surfaces.push_back(junction(5, random));
    surfaces.push_back(rotated(centred(net(6), 6, 0.3), random.rotation()));
  }
  return surfaces;
}

TEST(Momentum, BalancesBetweenASphereAndASurface) {
  Random random(3);
  int several_terms = 0;
  for (const Complex& complex : surfaces_of_many_terms(random)) {
    SphereOnSurface ball(complex, 0.9, kMaterial);
    const auto cells = all_cells(ball.surface());
    const Vec3 direction = random.direction();
    for (Vec3& v : ball.velocity()) v = random.in_cube(0.02);
    ball.x().back() = random.uniform(0.6, 0.95) * direction;
    for (int step = 0; step < 5; ++step) {
      for (Vec3& w : ball.spin()) w = random.in_cube(0.05);
      ball.step(1.0);
      PatchFinder finder(ball.surface());
      for (const Patch& patch : finder.find(ball.centre(), ball.range(), cells, ball.x())) {
        several_terms += patch.term_count > 1;
      }
      expect_balanced(balance_of(ball.forces(), ball.x()));
    }
  }
  EXPECT_GE(several_terms, 200);
}

TEST(ElasticForce, IsTheGradientOfTheEnergyWhereNoRingCloses) {
  Random random(4);
  int several_terms = 0;
  for (const Complex& complex : surfaces_of_many_terms(random)) {
    SphereOnSurface ball(complex, 0.9, {1e6, 0.7, 0.0});
    const auto cells = all_cells(ball.surface());
    const Vec3 place = random.uniform(0.7, 0.95) * random.direction();
    ball.put(place);
    CriticalFeatureFinder critical(ball.surface());
    const int patches = static_cast<int>(ball.contacts().touching());
    if (patches == 0 ||
        has_cycles_or_voids(critical, place, ball.range(), cells, ball.x(), patches))
      continue;
    several_terms += critical.find(place, ball.range(), cells, ball.x()).size() > 2;
    const auto forces = ball.forces().force;
    const std::vector<Vec3> x = ball.x();
    std::vector<Vec3> move(x.size());
    for (Vec3& m : move) m = random.in_cube(1.0);
    const auto energy_at = [&](double s) {
      for (std::size_t i = 0; i < x.size(); ++i) ball.x()[i] = x[i] + s * move[i];
      ball.step(0.0);
      return ball.contacts().elastic_energy();
    };
    const double step = 1e-7;  // m

    const double slope = (energy_at(step) - energy_at(-step)) / (2.0 * step);

    double power = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) power += forces[i].dot(move[i]);
    // Central difference over steps of 1e-7 of forces whose slope may change by k at a feature's
    // border.
    const double stiffness = ball.parameters().normal_stiffness;
    EXPECT_NEAR(slope, -power, 100.0 * stiffness * step + 1e-16 * stiffness / step);
  }
  EXPECT_GE(several_terms, 10);
}

}  // namespace
}  // namespace plekton::test::momentum_test
