// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/any_law.hpp"
#include "tests/support/moving_scene.hpp"
#include "tests/support/named_laws.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

/// Contacts of all kinds under the law that can be any.
namespace plekton::contact {
namespace {

using Scene = test::MovingSceneOf<AnyLaw>;

class AnyLawScene : public testing::TestWithParam<test::NamedLaw> {};

TEST_P(AnyLawScene, HasTheSameBitsOnAnyNumberOfThreads) {
  Scene one(150, 0.05, 1, 1, GetParam().properties);
  Scene two(150, 0.05, 1, 2, GetParam().properties);
  Scene four(150, 0.05, 1, 4, GetParam().properties);
  for (int step = 0; step < 60; ++step) {
    for (Scene* scene : {&one, &two, &four}) scene->step(2e-3);
    for (const Scene* scene : {&two, &four}) {
      ASSERT_EQ(scene->forces().force, one.forces().force) << step;
      ASSERT_EQ(scene->forces().torque, one.forces().torque) << step;
      ASSERT_EQ(scene->contacts().dissipated(), one.contacts().dissipated()) << step;
    }
  }
  const ContactCounts counts = one.contacts().counts();
  EXPECT_GT(counts.sphere_sphere, 0u);
  EXPECT_GT(counts.sphere_surface, 0u);
  EXPECT_GT(counts.with_planes, 0u);
}

INSTANTIATE_TEST_SUITE_P(Under, AnyLawScene, testing::ValuesIn(test::kLaws),
                         [](const auto& item) { return std::string(item.param.name); });

TEST(AnyLaw, IsTheLinearOneWhereNothingIsSaid) {
  Scene any(150, 0.05, 2, 1);
  test::MovingScene linear(150, 0.05, 2, 1);
  for (int step = 0; step < 60; ++step) {
    any.step(2e-3);
    linear.step(2e-3);
    double scale = 0.0;
    for (const Vec3& force : linear.forces().force) scale = std::max(scale, force.norm());
    for (std::size_t i = 0; i < linear.forces().force.size(); ++i) {
      // One by one here, in lanes there: a few roundings in each step.
      ASSERT_LE((any.forces().force[i] - linear.forces().force[i]).norm(), 1e-12 * scale) << step;
    }
  }
}

}  // namespace
}  // namespace plekton::contact
