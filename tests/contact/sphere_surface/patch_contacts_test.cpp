// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/patch_contacts.hpp"

#include "contact/law/linear_frictional.hpp"
#include "contact/law/material_pairs.hpp"
#include "tests/support/contact_surfaces.hpp"

#include <gtest/gtest.h>

namespace plekton::test::patch_contacts_test {
namespace {

using Minima = std::vector<Feature>;

AnyLaw::Parameters parameters() {
  return MaterialPairs({{1e6, 0.5, 0.4}})
      .combine(BodyPart{MaterialId{0}, 1.0}, BodyPart{MaterialId{0}, 1.0});
}

PatchContact slipped(const Vec3& slip, std::int64_t id) {
  ContactMemory<AnyLaw> memory;
  memory.history.keep(*parameters().law, LinearFrictional::History{slip});
  memory.normal = Vec3::UnitZ();
  return {memory, Vec3::UnitZ(), -0.1, 1.0, 1.0, id, 0, 0};
}

PatchContacts of_one_worker() {
  PatchContacts contacts;
  contacts.resize(1);
  return contacts;
}

Minima minima_of(const PatchContacts& contacts, const PatchContacts::Range& range,
                 std::size_t contact) {
  const auto of_pair = contacts.of(range);
  const auto minima = of_pair.minima_of(of_pair.contacts[contact]);
  return {minima.begin(), minima.end()};
}

TEST(PatchContacts, KeepTheMinimaOfEachContactOfAPair) {
  PatchContacts contacts = of_one_worker();
  PatchContacts::Range first, second;
  contacts.append(first, slipped(Vec3::Zero(), 1), Minima{Feature(FaceId{4})});
  contacts.append(first, slipped(Vec3::Zero(), 2), Minima{Feature(FaceId{5}), Feature(NodeId{6})});
  contacts.append(second, slipped(Vec3::Zero(), 3), Minima{Feature(FaceId{7})});

  EXPECT_EQ(contacts.size(), 3u);
  ASSERT_EQ(contacts.contacts_of(first).size(), 2u);
  EXPECT_EQ(contacts.contacts_of(first)[1].id, 2);
  EXPECT_EQ(minima_of(contacts, first, 0), Minima{Feature(FaceId{4})});
  EXPECT_EQ(minima_of(contacts, first, 1), (Minima{Feature(FaceId{5}), Feature(NodeId{6})}));
  EXPECT_EQ(minima_of(contacts, second, 0), Minima{Feature(FaceId{7})});
}

TEST(PatchContacts, GiveNumbersToThoseThatHaveNone) {
  PatchContacts contacts = of_one_worker();
  PatchContacts::Range range;
  for (const std::int64_t id : {0, 8, 0}) contacts.append(range, slipped(Vec3::Zero(), id), {});
  std::int64_t last = 10;

  contacts.assign_ids(last);

  EXPECT_EQ(contacts.contacts_of(range)[0].id, 11);
  EXPECT_EQ(contacts.contacts_of(range)[1].id, 8);
  EXPECT_EQ(contacts.contacts_of(range)[2].id, 12);
  EXPECT_EQ(last, 12);
}

TEST(PatchContacts, GoOnFromTheMinimaThatAreLeftAndLoseTheHistoryWithoutAny) {
  // Two facets side by side; the first one is torn out, and the second one gets its number.
  Complex two;
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)}) two.node(x);
  two.facet(0, 1, 2);
  two.facet(1, 3, 2);
  const Surface before = two.surface();
  const Surface after = before.left_with({}, std::vector{two.facets[1]});
  const Feature gone = before.feature_of(CellId{0});
  const Feature left = before.feature_of(CellId{1});
  PatchContacts contacts = of_one_worker();
  PatchContacts::Range range;
  const Vec3 slip(0.002, 0, 0);
  contacts.append(range, slipped(slip, 1), Minima{gone, left});
  contacts.append(range, slipped(slip, 2), Minima{gone});

  const double lost = contacts.follow(range, parameters(), geometry::SurfaceChange(before, after));

  EXPECT_EQ(minima_of(contacts, range, 0), Minima{after.feature_of(CellId{0})});
  EXPECT_FALSE(contacts.contacts_of(range)[0].memory.is_new());
  EXPECT_EQ(minima_of(contacts, range, 1), Minima{});
  EXPECT_TRUE(contacts.contacts_of(range)[1].memory.is_new());
  const double spring = 0.5 * 1e6;  // N/m, across: half of E R
  EXPECT_NEAR(lost, 0.5 * spring * slip.squaredNorm(), 1e-12);
}

}  // namespace
}  // namespace plekton::test::patch_contacts_test
