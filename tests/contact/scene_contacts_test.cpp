// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/any_law.hpp"
#include "tests/support/moving_scene.hpp"
#include "tests/support/named_laws.hpp"

#include <gtest/gtest.h>

#include <string>

/// Contacts of all kinds under each law.
namespace plekton::contact::scene_contacts_test {
namespace {

using Scene = test::MovingScene;

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

TEST(SceneContacts, AreUnderTheLinearLawWhereNothingIsSaid) {
  Scene any(150, 0.05, 2, 1);
  Scene linear(150, 0.05, 2, 1, AnyLaw::of<LinearFrictional>());
  for (int step = 0; step < 60; ++step) {
    any.step(2e-3);
    linear.step(2e-3);
    ASSERT_EQ(any.forces().force, linear.forces().force) << step;
  }
}

}  // namespace
}  // namespace plekton::contact::scene_contacts_test
