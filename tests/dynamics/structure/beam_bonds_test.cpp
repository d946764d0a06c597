// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/beam_bonds.hpp"

#include "tests/support/beam_structure.hpp"
#include "tests/support/seeded_random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <vector>

namespace plekton::test::beam_bonds_test {
namespace {

using testing::HasSubstr;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kLength = 1.3;
const BeamSection kSection = dynamics::circular_section(0.2, 7.0, 0.25);

/// Nodes at random, each joined to the next and to a few others.
Scene random_frame(std::size_t node_count, Random& random) {
  Scene scene;
  for (std::size_t i = 0; i < node_count; ++i) scene.add_node(random.in_cube(3.0));
  for (std::size_t i = 0; i < 3 * node_count; ++i) {
    const std::size_t a = random.index(node_count);
    const std::size_t b = i < node_count ? (a + 1) % node_count : random.index(node_count);
    if (a != b)
      scene.add_beam(geometry::id_at<NodeId>(a), geometry::id_at<NodeId>(b), kSection, 1e3);
  }
  return scene;
}

TEST(BeamBonds, DoWhatEachBondDoesAlone) {
  Random random(7);
  Scene scene = random_frame(100, random);
  for (Vec3& position : scene.state.position) position += random.in_cube(0.1);
  for (Quat& orientation : scene.state.orientation) orientation = Quat(random.rotation());
  BeamBonds bonds(scene.bonds, scene.state.size());

  const Eigen::VectorXd together = bond_forces(bonds, scene.state);

  Eigen::VectorXd sum = Eigen::VectorXd::Zero(together.size());
  Eigen::VectorXd size = sum;
  double energy = 0.0;
  for (std::size_t i = 0; i < scene.bonds.size(); ++i) {
    BeamBonds alone({&scene.bonds[i], 1}, scene.state.size());
    const Eigen::VectorXd forces = bond_forces(alone, scene.state);
    sum += forces;
    size += forces.cwiseAbs();
    energy += alone.elastic_energy();
    EXPECT_EQ(bonds.axial_force(i), alone.axial_force(0));
  }
  // Both sums are rounded once for each of the few bonds of a node, in their own order.
  constexpr double kMostBondsOfANode = 32.0;
  for (Eigen::Index k = 0; k < sum.size(); ++k)
    EXPECT_NEAR(together[k], sum[k], 2.0 * kMostBondsOfANode * kEpsilon * size[k]);
  const auto count = static_cast<double>(scene.bonds.size());
  EXPECT_NEAR(bonds.elastic_energy(), energy, 2.0 * count * kEpsilon * energy);
}

TEST(BeamBonds, AddTheSameBitsForAnyNumberOfThreads) {
  Random random(6);
  Scene scene = random_frame(300, random);
  for (Vec3& position : scene.state.position) position += random.in_cube(0.1);
  const auto forces_with = [&](int threads) {
    geometry::ThreadPool pool(threads);
    BeamBonds bonds(scene.bonds, scene.state.size());
    contact::NodeForces forces(scene.state.size());
    bonds.advance(scene.state, pool);
    bonds.add_forces(forces, pool);
    return forces;
  };

  const contact::NodeForces one = forces_with(1);

  for (const int threads : {2, 3, 4}) {
    const contact::NodeForces many = forces_with(threads);
    EXPECT_EQ(many.force, one.force);
    EXPECT_EQ(many.torque, one.torque);
  }
}

TEST(BeamBonds, AddToWhatIsThereAlready) {
  Scene scene = chain(1, kLength, kSection);
  scene.state.position[1].x() += 0.1;
  BeamBonds bonds(scene.bonds, 2);
  geometry::ThreadPool pool;
  contact::NodeForces forces(2);
  forces.force[1] = Vec3(0.0, 5.0, 0.0);

  bonds.advance(scene.state, pool);
  bonds.add_forces(forces, pool);

  EXPECT_EQ(forces.force[1].y(), 5.0);
  EXPECT_LT(forces.force[1].x(), 0.0);
}

TEST(BeamBonds, ListEveryProblemOfEveryBond) {
  Scene scene = chain(2, kLength, kSection);
  std::vector<BeamBond> bonds = scene.bonds;
  bonds[0].length = 0.0;
  bonds[0].section.young_modulus = std::numeric_limits<double>::quiet_NaN();
  bonds[1].nodes = {NodeId{7}, NodeId{7}};

  try {
    BeamBonds(bonds, 3);
    FAIL() << "expected std::invalid_argument";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("bond 0 (nodes 0, 1): length at rest is 0 m"));
    EXPECT_THAT(error.what(), HasSubstr("bond 0 (nodes 0, 1): Young's modulus is nan Pa"));
    EXPECT_THAT(error.what(), HasSubstr("bond 1 (nodes 7, 7): there is no node 7, only 3 nodes"));
    EXPECT_THAT(error.what(), HasSubstr("both ends are the same node"));
  }
}

}  // namespace
}  // namespace plekton::test::beam_bonds_test
