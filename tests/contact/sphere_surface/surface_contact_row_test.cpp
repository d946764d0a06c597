// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/surface_contact_row.hpp"

#include "contact/law/material_pairs.hpp"
#include "tests/support/contact_surfaces.hpp"

#include <gtest/gtest.h>

namespace plekton::test::surface_contact_row_test {
namespace {

SurfaceForce term(const Vec3& force, const Vec3& torque_a, std::int32_t face) {
  SurfaceForce record{};
  record.core.feature = Feature(FaceId{face});
  record.force = force;
  record.torque_a = torque_a;
  record.torque_b = Vec3::Zero();
  return record;
}

TEST(SurfaceContactRow, DoesToTheSphereWhatAllItsTermsDo) {
  const SphereSurfacePair pair{
      1.0,
      1.1,
      1.1,
      0.0,
      NodeId{0},
      MaterialPairs({{1e6, 0.5, 0.4}})
          .combine(BodyPart{MaterialId{0}, 1.0}, BodyPart{MaterialId{0}, 0.1})};
  PatchContact contact{};
  contact.memory.normal = -Vec3::UnitZ();
  contact.foot = Vec3(0, 0, -1.0);
  contact.gap = -0.1;
  contact.elastic_force = 5.0;
  contact.id = 9;
  const std::vector<SurfaceForce> terms{term(Vec3(1, 0, -2), Vec3(0.1, 0.2, 0), 4),
                                        term(Vec3(0, 3, -4), Vec3(0, 0.5, 0.3), 6)};
  const std::vector<Vec3> x{Vec3(7, 8, 9)};

  const ContactRecord row = row_of(pair, {2, 3}, contact, terms, x);

  EXPECT_EQ(row.id, 9);
  EXPECT_EQ(row.a, (ContactBody{BodyKind::sphere, 2, Feature(NodeId{0})}));
  EXPECT_EQ(row.b, (ContactBody{BodyKind::structure, 3, Feature(FaceId{4})}));
  EXPECT_EQ(row.force(), Vec3(1, 3, -6));
  EXPECT_EQ(row.normal_force, Vec3(0, 0, -6));
  EXPECT_EQ(row.tangential_force, Vec3(1, 3, 0));
  // The contact point is amid the overlap, from 0.9 m to 1 m below the centre.
  EXPECT_NEAR((row.point - Vec3(7, 8, 9 - 0.95)).norm(), 0.0, 1e-14);
  // What acts on the sphere at that point and the moment there turn it as its torques do.
  const Vec3 torque = -(row.point - x[0]).cross(row.force()) - row.moment;
  EXPECT_NEAR((torque - Vec3(0.1, 0.7, 0.3)).norm(), 0.0, 1e-14);
}

}  // namespace
}  // namespace plekton::test::surface_contact_row_test
