// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/stiffness/spring_shares.hpp"

#include "tests/support/stiffness_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plekton::test::spring_shares_test {
namespace {

using dynamics::ContactSprings;
using dynamics::NodalStiffness;

NodeId node(std::size_t n) {
  return geometry::id_at<NodeId>(n);
}

double shared_step(const ContactSprings& springs, const NodeProperties& properties) {
  NodalStiffness stiffness(properties.size(), &properties);
  dynamics::SpringShares().add(springs, properties, stiffness);
  return stiffness.critical_step(properties).dt;
}

/// Balls 0 to 3 on a surface of nodes 4 to 7, and on walls.
struct RandomContacts {
  NodeProperties properties;
  ContactSprings springs;
  ContactMatrix exact{8};
};

RandomContacts random_contacts(Random& random) {
  RandomContacts contacts;
  for (std::size_t n = 0; n < 8; ++n) {
    contacts.properties.mass.push_back(std::abs(random.signed_power(-3.0, 1.0)));
    contacts.properties.inertia.push_back(0.4 * contacts.properties.mass.back() *
                                          std::abs(random.signed_power(-2.0, 0.0)));
    contacts.properties.held.push_back(n > 5 && random.coin() ? Held::everything : Held::nothing);
  }
  for (int k = 0; k < 12; ++k) {
    const ContactStiffness contact{random.direction(), std::abs(random.signed_power(-1.0, 1.0)),
                                   std::abs(random.signed_power(-2.0, 1.0)),
                                   random.uniform(0.1, 1.0), random.uniform(0.1, 1.0)};
    const std::size_t ball = random.index(4);
    const std::size_t other = (ball + 1 + random.index(3)) % 4;
    const double w = random.unit();
    const double v = (1.0 - w) * random.unit();
    const geometry::CorePoint core{{node(4), node(5), node(6 + random.index(2))},
                                   Vec3(w, v, 1.0 - w - v),
                                   geometry::Feature(geometry::FaceId{0})};
    if (k % 3 == 0) {
      contacts.exact.add(node(ball), geometry::core_point(node(other)), contact);
      contacts.springs.add_pair(node(ball), node(other), contact);
    } else if (k % 3 == 1) {
      contacts.exact.add(node(ball), core, contact);
      contacts.springs.add_on_surface(node(ball), core, contact);
    } else {
      contacts.exact.add_wall(node(ball), contact);
      contacts.springs.add_to_wall(node(ball), contact);
    }
  }
  return contacts;
}

TEST(SpringShares, GiveAStepThatIsNeverAboveTheTrueLimit) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const RandomContacts contacts = random_contacts(random);

    const double limit = true_limit(contacts.exact.matrix(), contacts.properties);

    EXPECT_LE(shared_step(contacts.springs, contacts.properties), limit * (1.0 + 1e-12)) << i;
  }
}

// A light node that two heavy balls press from either side: all springs act along one line, so that
// the matrix of magnitudes has the eigenvalue of the matrix itself.
TEST(SpringShares, AreExactForALightNodeBetweenHeavyBalls) {
  const NodeProperties properties{{1e-3, 2.0, 5.0}, {1.0, 1.0, 1.0}, {3, Held::nothing}};
  ContactSprings springs;
  ContactMatrix exact(3);
  for (const std::size_t ball : {1U, 2U}) {
    const Vec3 normal = ball == 1 ? Vec3::UnitZ() : Vec3(-Vec3::UnitZ());
    const ContactStiffness contact{normal, 10.0, 0.0, 0.1, 0.1};
    springs.add_on_surface(node(ball), geometry::core_point(node(0)), contact);
    exact.add(node(ball), geometry::core_point(node(0)), contact);
  }

  const double limit = true_limit(exact.matrix(), properties);

  EXPECT_LE(shared_step(springs, properties), limit * (1.0 + 1e-12));
  EXPECT_GE(shared_step(springs, properties), 0.99 * limit);
}

TEST(SpringShares, LeaveNothingOfAContactToWhatIsHeld) {
  const NodeProperties properties{{0.1, 0.1}, {1.0, 1.0}, {Held::everything, Held::nothing}};
  ContactSprings springs;
  springs.add_on_surface(node(1), geometry::core_point(node(0)),
                         {Vec3::UnitZ(), 10.0, 0.0, 0.1, 0.1});

  EXPECT_NEAR(shared_step(springs, properties), 2.0 / std::sqrt(10.0 / 0.1), 1e-12);
}

}  // namespace
}  // namespace plekton::test::spring_shares_test
