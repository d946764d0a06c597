// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/surface_contacts_state.hpp"

#include "contact/law/linear_frictional.hpp"
#include "contact/law/material_pairs.hpp"
#include "tests/support/contact_surfaces.hpp"

#include <gtest/gtest.h>

namespace plekton::test::surface_contacts_state_test {
namespace {

const AnyLaw::Functions* law() {
  return MaterialPairs({{1e6, 0.5, 0.4}}).properties(MaterialId{0}, MaterialId{0}).law;
}

SurfaceContactsState one_contact() {
  ContactMemory<AnyLaw> memory;
  memory.history.keep(*law(), LinearFrictional::History{Vec3(1, 2, 3)});
  memory.normal = Vec3::UnitZ();
  SurfaceContactsState state;
  state.largest_overlap_ratio = 0.25;
  state.contacts.push_back({{5, 2},
                            {memory, Vec3(0, 0, 0.5), -0.1, 11.0, 12.0, 13, 0, 0},
                            {Feature(FaceId{1}), Feature(NodeId{0})}});
  SurfaceForce record{};
  record.share = 0.5F;
  record.core = geometry::core_point(NodeId{3});
  record.force = Vec3(4, 5, 6);
  record.torque_a = Vec3(7, 8, 9);
  record.torque_b = Vec3(10, 11, 12);
  record.elastic = 13.0;
  state.forces.push_back({0, record});
  return state;
}

/// What is read of what is written.
SurfaceContactsState read_back(SurfaceContactsState state) {
  const Surface surface = sheet(1).surface();
  const auto law_of = [](const geometry::IndexPair&) { return law(); };
  geometry::StateTree tree;
  state.exchange(geometry::StateArchive::writer(tree), surface, law_of);
  SurfaceContactsState read;
  read.exchange(geometry::StateArchive::reader(tree), surface, law_of);
  return read;
}

TEST(SurfaceContactsState, IsReadAsItWasWritten) {
  const SurfaceContactsState read = read_back(one_contact());

  EXPECT_EQ(read.largest_overlap_ratio, 0.25);
  ASSERT_EQ(read.contacts.size(), 1u);
  const auto& kept = read.contacts[0];
  EXPECT_EQ(kept.pair, (geometry::IndexPair{5, 2}));
  EXPECT_EQ(kept.minima, (std::vector{Feature(FaceId{1}), Feature(NodeId{0})}));
  EXPECT_EQ(kept.contact.memory.history.as<LinearFrictional::History>().elastic_slip,
            Vec3(1, 2, 3));
  EXPECT_EQ(kept.contact.memory.normal, Vec3::UnitZ());
  EXPECT_EQ(kept.contact.foot, Vec3(0, 0, 0.5));
  EXPECT_EQ(kept.contact.gap, -0.1);
  EXPECT_EQ(kept.contact.elastic_force, 11.0);
  EXPECT_EQ(kept.contact.elastic_energy, 12.0);
  EXPECT_EQ(kept.contact.id, 13);
  ASSERT_EQ(read.forces.size(), 1u);
  EXPECT_EQ(read.forces[0].contact, 0u);
  EXPECT_EQ(read.forces[0].record.share, 0.5F);
  EXPECT_EQ(read.forces[0].record.core.feature, Feature(NodeId{3}));
  EXPECT_EQ(read.forces[0].record.force, Vec3(4, 5, 6));
  EXPECT_EQ(read.forces[0].record.torque_a, Vec3(7, 8, 9));
  EXPECT_EQ(read.forces[0].record.torque_b, Vec3(10, 11, 12));
  EXPECT_EQ(read.forces[0].record.elastic, 13.0);
}

TEST(SurfaceContactsState, IsRefusedWithAMinimumThatTheSurfaceDoesNotHave) {
  SurfaceContactsState state = one_contact();
  state.contacts[0].minima[0] = Feature(FaceId{2});  // of two

  EXPECT_THROW(read_back(state), geometry::StateMismatch);
}

TEST(SurfaceContactsState, IsRefusedWithAForceOfAContactThatIsNotThere) {
  SurfaceContactsState state = one_contact();
  state.forces[0].contact = 1;

  EXPECT_THROW(read_back(state), geometry::StateMismatch);
}

}  // namespace
}  // namespace plekton::test::surface_contacts_state_test
