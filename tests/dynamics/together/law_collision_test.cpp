// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/models.hpp"
#include "tests/support/free_bodies.hpp"
#include "tests/support/free_collision.hpp"
#include "tests/support/named_laws.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

/// Every pair of bodies collides under every contact law: no gravity, nothing held.
namespace plekton::dynamics::law_collision_test {
namespace {

using namespace test::free_bodies;
using contact::AnyLaw;
using test::kLaws;
using test::NamedLaw;

struct NamedBody {
  const char* name;
  Body (*make)();
};

const std::vector<NamedBody> kBodies{{"Ball", ball},
                                     {"Chain", chain},
                                     {"Sheet", sheet},
                                     {"Tetrahedron", tetrahedron},
                                     {"Shell", shell}};

struct Case {
  NamedLaw law;
  NamedBody still;
  NamedBody flying;
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const NamedLaw& law : kLaws) {
    for (std::size_t i = 0; i < kBodies.size(); ++i) {
      for (std::size_t j = i; j < kBodies.size(); ++j)
        cases.push_back({law, kBodies[i], kBodies[j]});
    }
  }
  return cases;
}

/// Of structures, which fall on each other with some 100 N: on one contact, an attraction of 12 N.
std::vector<Case> sticky_cases() {
  const NamedLaw sticky{"StrongAdhesion", test::with<contact::DmtAdhesion>({200.0})};
  std::vector<Case> cases;
  for (std::size_t i = 1; i < kBodies.size(); ++i) {
    for (std::size_t j = i; j < kBodies.size(); ++j)
      cases.push_back({sticky, kBodies[i], kBodies[j]});
  }
  return cases;
}

/// The node of a body that stands alone that is furthest along z, up (1) or down (-1).
Vec3 extreme_node(const Scene& scene, double side) {
  const auto& x = scene.state.position;
  return *std::max_element(x.begin(), x.end(), [&](const Vec3& p, const Vec3& q) {
    return side * p.z() < side * q.z();
  });
}

/// How a body flies at the other.
struct Flight {
  Vec3 turns = Vec3(0.2, 0.1, 0.7);       ///< rad, rotation vector
  Vec3 beside = Vec3(0.004, 0.006, 0.0);  ///< m, of the highest node of the other
  Vec3 velocity = Vec3(0.3, 0.1, -1.0);   ///< m/s
  Vec3 spin = Vec3(0.5, -1.0, 2.0);       ///< rad/s, of all nodes

  static Flight at_random(test::Random& random) {
    return {random.in_cube(2.0), random.in_cube(0.005).cwiseProduct(Vec3(1.0, 1.0, 0.0)),
            random.in_cube(0.5) - Vec3::UnitZ(), random.in_cube(2.0)};
  }
};

/// The flying body comes down on the highest node of the other, a little beside it.
Scene scene_of(const Case& item, const Flight& flight) {
  const Body still = item.still.make(), flying = item.flying.make();
  Scene still_alone, flying_alone, both;
  add(still_alone, still, Vec3::Zero(), Vec3::Zero(), Vec3::Zero());
  add(flying_alone, flying, flight.turns, Vec3::Zero(), Vec3::Zero());
  const auto radius = [](const Body& body) { return body.is_ball ? 3.0 * kRadius : kRadius; };
  const Vec3 beside = flight.beside + Vec3(0.0, 0.0, radius(still) + radius(flying) + 1e-4);
  both.materials = {{1e7, 0.3, 0.6}};
  add(both, still, Vec3::Zero(), Vec3::Zero(), Vec3::Zero());
  add(both, flying, flight.turns,
      extreme_node(still_alone, 1.0) - extreme_node(flying_alone, -1.0) + beside, flight.velocity);
  for (Vec3& spin : both.state.angular_velocity) spin = flight.spin;
  return both;
}

/// Lets the bodies collide. @returns in how many steps they touched
std::size_t collide(const Case& item, const Flight& flight) {
  const contact::PairProperties<AnyLaw> properties{{{kMaterial, kMaterial}, item.law.properties}};
  const Simulation probe(scene_of(item, flight), {.motion = {.gravity = Vec3::Zero()}},
                         contact::any_law(properties));
  Simulation simulation(scene_of(item, flight),
                        {.time_step = 0.1 * probe.time_step(), .motion = {.gravity = Vec3::Zero()}},
                        contact::any_law(properties));
  const auto before = test::momenta_of(simulation);
  const double energy = simulation.energy().initial;
  std::size_t touched = 0;
  double worst_linear = 0.0, worst_angular = 0.0, most = 0.0, worst_closure = 0.0;
  while (simulation.time() < 0.02) {
    simulation.step();
    const auto now = test::momenta_of(simulation);
    worst_linear = std::max(worst_linear, (now.linear - before.linear).norm());
    worst_angular = std::max(worst_angular, (now.angular - before.angular).norm());
    const Energy e = simulation.energy();
    most = std::max(most, e.kinetic + e.contact_elastic + e.bond_elastic);
    worst_closure = std::max(worst_closure, e.closure());
    const auto counts = simulation.contacts().counts();
    touched += counts.between_structures + counts.sphere_sphere + counts.sphere_surface > 0;
  }

  EXPECT_LE(worst_linear, 1e-10 * before.linear.norm());
  EXPECT_LE(worst_angular, 1e-10 * before.angular.norm());
  EXPECT_LE(most, (1.0 + 1e-3) * energy);
  EXPECT_LE(worst_closure, 5e-3);
  return touched;
}

class LawCollision : public testing::TestWithParam<Case> {};

TEST_P(LawCollision, KeepsBothMomentaAndGainsNoEnergy) {
  EXPECT_GT(collide(GetParam(), Flight{}), 0u);
}

TEST_P(LawCollision, KeepsBothMomentaAndGainsNoEnergyHoweverTheBodyFlies) {
  test::Random random(2016);
  int met = 0;
  for (int flight = 0; flight < 4; ++flight) {
    SCOPED_TRACE(flight);
    met += collide(GetParam(), Flight::at_random(random)) > 0;
  }
  EXPECT_GE(met, 3);  // a node may pass beside the other body
}

std::string name_of(const testing::TestParamInfo<Case>& item) {
  return std::string(item.param.law.name) + item.param.flying.name + "On" + item.param.still.name;
}

INSTANTIATE_TEST_SUITE_P(Of, LawCollision, testing::ValuesIn(all_cases()), name_of);
INSTANTIATE_TEST_SUITE_P(OfSticky, LawCollision, testing::ValuesIn(sticky_cases()), name_of);

}  // namespace
}  // namespace plekton::dynamics::law_collision_test
