// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/single_feature_contact.hpp"

#include "contact/law/dmt_adhesion.hpp"
#include "contact/sphere_surface/normal_part.hpp"
#include "tests/support/contact_surfaces.hpp"
#include "tests/support/named_laws.hpp"

#include <gtest/gtest.h>

namespace plekton::test::single_feature_contact_test {
namespace {

using contact::AnyLaw;
using contact::DmtAdhesion;
using contact::NormalPart;

const AnyLaw::Parameters kParameters =
    AnyLaw::combine(with<DmtAdhesion>({1.0}), {{1e4, 0.3, 0.5}, 0.3}, {{1e4, 0.3, 0.5}, 0.1});
const AnyLaw::Parameters kElastic = AnyLaw::without_attraction(kParameters);
const NormalPart kNormal(kElastic, AnyLaw::attraction(kParameters));

/// As SurfaceContacts finds it for patches of any number of terms.
PatchState general_state(const Patch& patch, std::span<const PatchTerm> terms, NodeId ball,
                         double radius, double range, const Motion& motion) {
  std::vector<PatchTermForce> term_forces(terms.size());
  PatchState state = patch_state(
      patch, terms, range, kNormal, [](const PatchTerm&, double elastic) { return elastic; },
      term_forces);
  set_kinematics(state, ball, radius, range, terms, term_forces, motion);
  return state;
}

TEST(LoneContact, HasTheStateOfAPatchToTheLastBit) {
  Random random(1);
  int compared = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Complex complex = random.coin() ? sheet(4) : sheet_with_fin(0.1, random);
    const NodeId ball{complex.node(Vec3::Zero())};
    const Surface surface = complex.surface();
    PatchFinder finder(surface);
    std::vector<Vec3> velocity;
    std::vector<Vec3> spin;
    for (std::size_t i = 0; i < complex.x.size(); ++i) {
      velocity.push_back(random.in_cube(1.0));
      spin.push_back(random.in_cube(10.0));
    }
    for (int place = 0; place < 50; ++place) {
      const double radius = random.uniform(0.1, 0.5);
      const double range = radius + 0.1;
      const Vec3 centre(random.uniform(0.0, 4.0), random.uniform(0.0, 4.0),
                        random.uniform(0.8, 1.0) * range);
      complex.x[index_of(ball)] = centre;
      const Motion motion{complex.x, velocity, spin};
      for (const Patch& patch : finder.find(centre, range, all_cells(surface), complex.x)) {
        const auto terms = finder.terms(patch);
        if (!is_single_feature(terms)) continue;
        ++compared;

        const PatchState lone =
            single_feature_state(terms[0], kNormal, ball, radius, range, motion);

        const PatchState general = general_state(patch, terms, ball, radius, range, motion);
        ASSERT_EQ(lone.root, general.root);
        ASSERT_EQ(lone.normal, general.normal);
        ASSERT_EQ(lone.gap, general.gap);
        ASSERT_EQ(lone.elastic_force, general.elastic_force);
        ASSERT_EQ(lone.elastic_energy, general.elastic_energy);
        ASSERT_EQ(lone.foot, general.foot);
        ASSERT_EQ(lone.lever_a, general.lever_a);
        ASSERT_EQ(lone.relative_velocity, general.relative_velocity);
        ASSERT_EQ(lone.twist_rate, general.twist_rate);
      }
    }
  }
  EXPECT_GT(compared, 5000);
}

}  // namespace
}  // namespace plekton::test::single_feature_contact_test
