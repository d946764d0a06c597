// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/damped_sheets.hpp"

#include "dynamics/scene_check.hpp"
#include "tests/support/linear_algebra.hpp"
#include "tests/support/loaded_scene.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/sheet_structure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace plekton::test::damped_sheets_test {
namespace {

using dynamics::FacetDashpot;
using dynamics::Mat3;
using dynamics::SheetDamping;
using dynamics::SheetSection;
using testing::HasSubstr;

/// Two facets of a limp sheet, tilted in space, with nodes of different masses.
Scene pair_of_facets() {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.3}};
  const std::array<Vec3, 4> places{Vec3(0, 0, 0), Vec3(0.3, 0.02, 0.1), Vec3(0.05, 0.25, -0.03),
                                   Vec3(0.36, 0.27, 0.08)};
  for (const Vec3& place : places) scene.add_node(place, Held::rotation);
  const SheetSection section{5e3, 0.35, 0.0, 1e-3};
  for (const std::array<int, 3>& corners : {std::array{0, 1, 2}, std::array{1, 3, 2}}) {
    std::array<NodeId, 3> nodes{};
    for (std::size_t k = 0; k < 3; ++k) nodes[k] = NodeId{corners[k]};
    scene.add_sheet_facet(nodes, section, 900.0);
  }
  scene.properties.mass[1] *= 3.0;
  return scene;
}

/// Forces of the elastic sheet for a small displacement along v, over its size: -K v.
Eigen::VectorXd elastic_rate(const Scene& scene, const std::vector<Vec3>& v) {
  constexpr double kStep = 1e-7;  // s
  Eigen::VectorXd displacement = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * v.size()));
  for (std::size_t i = 0; i < v.size(); ++i)
    displacement.segment<3>(static_cast<Eigen::Index>(6 * i)) = kStep * v[i];
  dynamics::SheetFacets sheets(scene.sheet_facets, scene.state.size());
  return (sheet_forces(sheets, moved(scene.state, displacement)) -
          sheet_forces(sheets, moved(scene.state, -displacement))) /
         (2.0 * kStep);
}

std::vector<Vec3> damping_forces(const Scene& scene, const SheetDamping& damping,
                                 const std::vector<Vec3>& v) {
  dynamics::DampedSheets damped(damping, scene.sheet_facets, scene.properties);
  NodeState state = scene.state;
  state.velocity = v;
  geometry::ThreadPool pool;
  contact::NodeForces forces(state.size());
  damped.act({0.0, 0.0, 0.0}, state, pool).add_to(forces, pool);
  return forces.force;
}

Scene first_facet_alone() {
  Scene scene = pair_of_facets();
  scene.sheet_facets.resize(1);
  return scene;
}

std::vector<Vec3> random_velocities(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> v;
  for (std::size_t i = 0; i < count; ++i) v.push_back(random.in_cube(1.0));
  return v;
}

TEST(DampedSheets, ResistInProportionToTheStiffnessOfTheSheet) {
  const Scene scene = first_facet_alone();
  const double time = dashpot_of(scene.sheet_facets[0], 0.2, scene.properties).relaxation_time;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const std::vector<Vec3> v = random_velocities(scene.state.size(), seed);
    const Eigen::VectorXd expected = time * elastic_rate(scene, v);
    const std::vector<Vec3> forces = damping_forces(scene, {{0}, 0.2}, v);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 force = expected.segment<3>(static_cast<Eigen::Index>(6 * i));
      EXPECT_LT((forces[i] - force).norm(), 1e-5 * expected.norm()) << i;
    }
  }
}

/// The largest eigenvalue of M^-1 K, K column by column from the elastic forces.
TEST(DampedSheets, AreCriticalForTheFastestStretchingOfAFacetAtARatioOfOne) {
  Scene scene = first_facet_alone();
  for (const Held held : {Held::rotation, Held::everything}) {
    scene.properties.held[2] = held;
    Eigen::Matrix<double, 9, 9> scaled;
    for (int column = 0; column < 9; ++column) {
      std::vector<Vec3> v(scene.state.size(), Vec3::Zero());
      v[static_cast<std::size_t>(column / 3)][column % 3] = 1.0;
      const Eigen::VectorXd forces = elastic_rate(scene, v);
      for (int row = 0; row < 9; ++row) {
        const auto a = static_cast<std::size_t>(row / 3), b = static_cast<std::size_t>(column / 3);
        const bool is_held = dynamics::holds_translation(scene.properties.held[a]) ||
                             dynamics::holds_translation(scene.properties.held[b]);
        scaled(row, column) =
            is_held ? 0.0
                    : -forces[6 * (row / 3) + row % 3] /
                          std::sqrt(scene.properties.mass[a] * scene.properties.mass[b]);
      }
    }
    const double largest = eigenvalues_of(0.5 * (scaled + scaled.transpose()))[8];
    EXPECT_NEAR(dashpot_of(scene.sheet_facets[0], 1.0, scene.properties).relaxation_time,
                2.0 / std::sqrt(largest), 1e-5 * 2.0 / std::sqrt(largest));
  }
}

TEST(DampedSheets, DoNotResistWhatTheyMoveAndTurnWith) {
  const Scene scene = pair_of_facets();
  const Vec3 spin(3.0, -2.0, 5.0);
  std::vector<Vec3> v;
  for (const Vec3& x : scene.state.position) v.push_back(Vec3(7, 8, 9) + spin.cross(x));
  // N, of stretching at this speed
  const double scale = elastic_rate(scene, random_velocities(4, 1)).norm();
  for (const Vec3& force : damping_forces(scene, {{0, 1}, 0.5}, v))
    EXPECT_LT(force.norm(), 1e-12 * scale);
}

TEST(DampedSheets, LeaveBothMomentaAloneAndAreCountedInTheEnergy) {
  Scene scene = pair_of_facets();
  scene.loads.sheet_damping.push_back({{0, 1}, 0.1});
  const std::vector<Vec3> v = random_velocities(4, 3);
  for (std::size_t i = 0; i < 4; ++i) scene.state.velocity[i] = 0.5 * v[i];
  const auto momenta = [](const LoadedSimulation& simulation) {
    Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
    for (std::size_t i = 0; i < simulation.state().size(); ++i) {
      const Vec3 momentum = simulation.properties().mass[i] * simulation.state().velocity[i];
      sum.head<3>() += momentum;
      sum.tail<3>() += simulation.state().position[i].cross(momentum);
    }
    return sum;
  };
  LoadedSimulation simulation(scene, {});
  const auto before = momenta(simulation);

  const double error = closure_until(simulation, 0.05);

  EXPECT_LT((momenta(simulation) - before).head<3>().norm(), 1e-12 * before.norm());
  EXPECT_LT((momenta(simulation) - before).tail<3>().norm(), 1e-3 * before.norm());
  EXPECT_GT(simulation.energy().damping, 0.1 * simulation.energy().turnover());
  EXPECT_EQ(simulation.energy().external_work, 0.0);
  EXPECT_LT(error, 5e-3);
}

TEST(DampedSheets, DampNothingWhereAllNodesAreHeld) {
  Scene scene = first_facet_alone();
  scene.properties.held.assign(4, Held::everything);
  const FacetDashpot dashpot = dashpot_of(scene.sheet_facets[0], 0.7, scene.properties);
  EXPECT_EQ(dashpot.relaxation_time, 0.0);
  EXPECT_EQ(dashpot.resistance, Mat3::Zero());
}

TEST(DampedSheets, EndWhereAFacetIsTorn) {
  const Scene scene = pair_of_facets();
  dynamics::DampedSheets damped({{0, 1}, 0.3}, scene.sheet_facets, scene.properties);
  dynamics::SheetFacets sheets(scene.sheet_facets, scene.state.size());
  sheets.break_facet(0, scene.state, 0.0);
  damped.follow(sheets);
  NodeState state = scene.state;
  state.velocity = random_velocities(4, 5);
  geometry::ThreadPool pool;
  contact::NodeForces forces(state.size());
  damped.act({0.0, 0.0, 0.0}, state, pool).add_to(forces, pool);
  EXPECT_EQ(forces.force[0], Vec3::Zero());
  EXPECT_GT(forces.force[3].norm(), 0.0);
}

TEST(DampedSheets, AreRefusedWithAFacetThatIsNotThereOrANegativeRatio) {
  Scene scene = pair_of_facets();
  scene.loads.sheet_damping.push_back({{0, 2, 0}, -0.1});
  scene.loads.sheet_damping.push_back({{}, 0.1});
  try {
    dynamics::check(scene);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("there is no sheet facet 2, only 2 sheet facets"));
    EXPECT_THAT(error.what(), HasSubstr("sheet damping 0: names sheet facet 0 twice"));
    EXPECT_THAT(error.what(), HasSubstr("sheet damping 1: has no sheet facets"));
    EXPECT_THAT(error.what(), HasSubstr("its ratio must be finite and not negative"));
  }
}

}  // namespace
}  // namespace plekton::test::damped_sheets_test
