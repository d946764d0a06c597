// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/reactions.hpp"
#include "tests/support/reported_scene.hpp"

#include <gtest/gtest.h>

namespace plekton::test::third_law_test {
namespace {

using contact::BodyKind;
using contact::ContactBody;
using contact::ContactRecord;
using dynamics::contact_force_on;
using dynamics::ForceAndMoment;

constexpr double kTolerance = 1e-12;

/// Sums of magnitudes, against which sums of vectors are measured.
struct Size {
  double force = 0.0;   ///< N
  double moment = 0.0;  ///< N m
};

Size size_of(const dynamics::Simulation& simulation, const std::vector<Vec3>& x) {
  Size size;
  for (std::size_t i = 0; i < x.size(); ++i) {
    size.force += simulation.forces().force[i].norm();
    size.moment +=
        x[i].norm() * simulation.forces().force[i].norm() + simulation.forces().torque[i].norm();
  }
  return size;
}

/// What acts on all nodes for which is_one() holds, about the origin.
template <class IsOne>
ForceAndMoment nodal_sum(const dynamics::Simulation& simulation, const std::vector<Vec3>& x,
                         IsOne is_one) {
  ForceAndMoment sum;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (is_one(geometry::id_at<NodeId>(i)))
      sum.add(x[i], simulation.forces().force[i], simulation.forces().torque[i]);
  }
  return sum;
}

void expect_equal(const ForceAndMoment& a, const ForceAndMoment& b, const Size& size) {
  EXPECT_LE((a.force - b.force).norm(), kTolerance * size.force);
  EXPECT_LE((a.moment - b.moment).norm(), kTolerance * size.moment);
}

class ThirdLaw : public testing::TestWithParam<NamedLaw> {
 protected:
  ThirdLaw() : simulation_(reported_.simulation(GetParam())) {
    for (int k = 0; k < 10; ++k) simulation_.step();
    x_ = simulation_.force_positions();
    contacts_ = simulation_.list_contacts();
    size_ = size_of(simulation_, x_);
  }

  ReportedScene reported_;
  dynamics::Simulation simulation_;
  std::vector<Vec3> x_;
  std::vector<ContactRecord> contacts_;
  Size size_;
};

TEST_P(ThirdLaw, HasContactsOfAllKindsInTheList) {
  const contact::ContactCounts counts = simulation_.contacts().counts();

  EXPECT_GT(counts.sphere_sphere, 0u);
  EXPECT_GT(counts.sphere_surface, 0u);
  EXPECT_GT(counts.between_structures, 0u);
  EXPECT_GT(counts.with_planes, 0u);
  EXPECT_EQ(contacts_.size(), counts.sphere_sphere + counts.sphere_surface +
                                  counts.between_structures + counts.with_planes);
}

TEST_P(ThirdLaw, ListedContactsAddUpToWhatActsOnEverySphere) {
  for (std::size_t i = 0; i < simulation_.elements().spheres.size(); ++i) {
    const NodeId node = simulation_.elements().spheres[i].nodes[0];
    const auto is_it = [&](const ContactBody& body) {
      return body.kind == BodyKind::sphere && body.index == static_cast<std::int32_t>(i);
    };

    const ForceAndMoment listed = contact_force_on(contacts_, is_it, Vec3::Zero());

    expect_equal(listed, nodal_sum(simulation_, x_, [&](NodeId n) { return n == node; }), size_);
  }
}

// Beams act and react within a structure.
TEST_P(ThirdLaw, ListedContactsAddUpToWhatActsOnEveryStructure) {
  ASSERT_EQ(simulation_.surface().structure_count(), 2u);
  for (std::int32_t s = 0; s < 2; ++s) {
    const auto is_it = [&](const ContactBody& body) {
      return body.kind == BodyKind::structure && body.index == s;
    };

    const ForceAndMoment listed = contact_force_on(contacts_, is_it, Vec3::Zero());

    expect_equal(listed,
                 nodal_sum(simulation_, x_,
                           [&](NodeId n) {
                             return simulation_.surface().structure_of(n) ==
                                    geometry::StructureId{s};
                           }),
                 size_);
  }
}

TEST_P(ThirdLaw, PlanesBearTheOppositeOfWhatTheyDoToTheNodes) {
  ForceAndMoment of_planes;
  for (std::size_t i = 0; i < simulation_.planes().size(); ++i) {
    const ForceAndMoment reaction = simulation_.plane_reaction(i);
    of_planes.add(simulation_.force_point(i), reaction.force, reaction.moment);
    EXPECT_GT(reaction.force.norm(), 0.0);
  }

  const ForceAndMoment on_nodes = nodal_sum(simulation_, x_, [](NodeId) { return true; });

  expect_equal({-of_planes.force, -of_planes.moment}, on_nodes, size_);
}

// Without damping the velocity of a node changes by (F / m + g) dt in a step, rounded to eps of
// itself.
TEST_P(ThirdLaw, ReactionsWeightAndInertiaAddUpToZero) {
  const std::vector<Vec3> before = simulation_.state().velocity;
  simulation_.step();
  Vec3 sum = Vec3::Zero();
  double rounding = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Vec3& after = simulation_.state().velocity[i];
    const double mass = simulation_.properties().mass[i];
    sum += mass * (simulation_.gravity() - (after - before[i]) / simulation_.time_step());
    rounding += 4.0 * std::numeric_limits<double>::epsilon() * mass * after.norm() /
                simulation_.time_step();
  }
  for (std::size_t i = 0; i < simulation_.planes().size(); ++i)
    sum -= simulation_.plane_reaction(i).force;
  sum -= simulation_.support_reaction(reported_.rim, Vec3::Zero()).force;

  EXPECT_LE(sum.norm(), kTolerance * size_.force + rounding);
}

TEST_P(ThirdLaw, HoldsToTheBitForAnyNumberOfThreads) {
  for (const int threads : {2, 4}) {
    dynamics::Simulation other = reported_.simulation(GetParam(), threads);
    for (int k = 0; k < 10; ++k) other.step();
    const std::vector<ContactRecord> contacts = other.list_contacts();
    ASSERT_EQ(contacts.size(), contacts_.size());
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      EXPECT_EQ(contacts[i].id, contacts_[i].id);
      EXPECT_EQ(contacts[i].a, contacts_[i].a);
      EXPECT_EQ(contacts[i].b, contacts_[i].b);
      EXPECT_EQ(contacts[i].force(), contacts_[i].force());
      EXPECT_EQ(contacts[i].moment, contacts_[i].moment);
    }
    EXPECT_EQ(other.unbalanced_force_ratio(), simulation_.unbalanced_force_ratio());
  }
}

INSTANTIATE_TEST_SUITE_P(Of, ThirdLaw, testing::ValuesIn(kLaws),
                         [](const auto& law) { return std::string(law.param.name); });

}  // namespace
}  // namespace plekton::test::third_law_test
