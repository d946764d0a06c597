// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/beam_structure.hpp"

#include <gtest/gtest.h>

namespace plekton::test::a01_cantilever_test {
namespace {

struct Case {
  int bonds;
  double radius;  // m
};

class A01Cantilever : public testing::TestWithParam<Case> {};

// w = P L³ / (3 E I), theta = P L² / (2 E I): Euler-Bernoulli, exact at the nodes for any number of
// elements, however stout (length / diameter of an element from 0.6 to 12.5).
TEST_P(A01Cantilever, BendsAsEulerAndBernoulliSay) {
  const auto [bond_count, radius] = GetParam();
  constexpr double kLength = 1.0;
  constexpr double kDeflection = 1e-4;  // m; what is not linear is below its square
  const BeamSection section = dynamics::circular_section(radius, 1e9, 0.25);
  const double bending = section.young_modulus * section.second_moment;
  const double load = 3.0 * bending / (kLength * kLength * kLength) * kDeflection;
  Scene scene = chain(bond_count, kLength, section);
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(first_entry(scene.state.size()));
  loads[loads.size() - 4] = load;  // along z, on the last node

  balance(scene, loads, 1);

  const Vec3 rotation = rotation_vector(scene.state.orientation.back());
  EXPECT_NEAR(scene.state.position.back().z() / kDeflection, 1.0, 1e-5);
  EXPECT_NEAR(-rotation.y() / (load * kLength * kLength / (2.0 * bending)), 1.0, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(AllSizes, A01Cantilever,
                         testing::Values(Case{1, 0.05}, Case{1, 0.5}, Case{2, 0.05}, Case{4, 0.05},
                                         Case{8, 0.05}, Case{16, 0.05}, Case{4, 0.01},
                                         Case{8, 0.01}, Case{16, 0.01}),
                         [](const auto& sizes) {
                           return std::to_string(sizes.param.bonds) + "BondsOfRadius" +
                                  std::to_string(static_cast<int>(1e3 * sizes.param.radius)) + "mm";
                         });

}  // namespace
}  // namespace plekton::test::a01_cantilever_test
