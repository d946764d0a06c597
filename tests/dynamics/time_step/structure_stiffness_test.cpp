// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/structure_stiffness.hpp"

#include "geometry/base/state_archive.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/linear_algebra.hpp"
#include "tests/support/resisting_scene.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace plekton::test::structure_stiffness_test {
namespace {

using dynamics::ContactSprings;
using dynamics::Held;
using dynamics::IsotropicStiffness;
using dynamics::Scene;
using dynamics::StructureStiffness;
using geometry::NodeId;
using std::numbers::pi;

constexpr double kRadius = 0.005;  // m, half the thickness of facets
/// What 32 products of a power iteration may be short of in the stiffness.
constexpr double kIteration = 0.02;

/// Adds a tube around z, its nodes a little beside their places.
void add_tube(Scene& scene, double radius, double mass, const Vec3& middle) {
  const int first = static_cast<int>(scene.state.size());
  Random random(141 + scene.state.size());
  const geometry::Mesh mesh = geometry::tube({radius, 0.2, 6, 1});
  for (const Vec3& x : mesh.points) {
    scene.add_node(middle + x + random.in_cube(1e-3 * kRadius));
    scene.properties.mass.back() = mass;
    scene.properties.inertia.back() = mass;
  }
  const auto node = [&](NodeId point) { return NodeId{first + static_cast<int>(index_of(point))}; };
  for (const auto& [a, b, c] : mesh.facets)
    scene.add_facet(node(a), node(b), node(c), kRadius, contact::MaterialId{0});
}

/// A tube in a wider one that holds it all around, 1 % of a radius deep: its pushes add up to
/// nothing.
void add_sleeve(Scene& scene, double mass, const Vec3& middle) {
  constexpr double kInner = 0.1;  // m
  scene.materials = {{1e8, 0.0, 0.0}};
  add_tube(scene, kInner, mass, middle);
  add_tube(scene, kInner + 1.99 * kRadius / std::cos(pi / 6.0), 2.0 * mass, middle);
}

/// By node (N/m): the springs of patches, and what comes to them.
struct Springs {
  explicit Springs(const ResistingScene& of)
      : of_patches(of.scene.state.size(), 0.0), more(of.scene.state.size(), 0.0) {
    of.contacts->for_each_structure_stiffness(
        [&](NodeId node, const contact::PairStiffness& stiffness, double) {
          of_patches[index_of(node)] += 2.0 * stiffness.normal;
        });
    StructureStiffness structures(of.rigid);
    structures.find(*of.contacts, of.scene.properties, {of.scene.state.position, 1e-6 * kRadius},
                    0.0);
    ContactSprings springs;
    structures.add_to(springs);
    springs.for_each_single([&](NodeId node, const IsotropicStiffness& stiffness) {
      more[index_of(node)] += stiffness.translation;
      EXPECT_EQ(stiffness.rotation, 0.0);
    });
  }

  std::vector<double> of_patches, more;
};

/// 1/s², the largest magnitude of an eigenvalue of M^(-1/2) H M^(-1/2), H by central differences of
/// the forces of the contacts.
double rate_by_differences(ResistingScene& of) {
  const std::size_t count = of.scene.state.size();
  const auto size = static_cast<Eigen::Index>(3 * count);
  constexpr double kStep = 1e-9;  // m
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index k = 0; k < size; ++k) {
    double& place = of.scene.state.position[static_cast<std::size_t>(k / 3)][k % 3];
    const double before = place;
    for (const double sign : {1.0, -1.0}) {
      place = before + sign * kStep;
      of.find_forces();
      for (std::size_t i = 0; i < count; ++i)
        matrix.block<3, 1>(static_cast<Eigen::Index>(3 * i), k) -=
            sign / (2.0 * kStep) * of.forces.force[i];
    }
    place = before;
  }
  of.find_forces();
  Eigen::VectorXd roots(size);
  for (Eigen::Index k = 0; k < size; ++k)
    roots[k] = 1.0 / std::sqrt(of.scene.properties.mass[static_cast<std::size_t>(k / 3)]);
  const Eigen::MatrixXd scaled = roots.asDiagonal() * matrix * roots.asDiagonal();
  const Eigen::VectorXd values = eigenvalues_of(0.5 * (scaled + scaled.transpose()));
  return std::max(-values[0], values[size - 1]);
}

/// With the springs of its patches each node has lambda times its mass, if those are not more.
TEST(StructureStiffness, BringsEachNodeUpToTheStiffestMotionTimesItsMass) {
  Scene scene;
  add_sleeve(scene, 1.0, Vec3::Zero());
  ResistingScene sleeve(std::move(scene));
  const double rate = rate_by_differences(sleeve);

  const Springs springs(sleeve);

  int more = 0;
  for (std::size_t i = 0; i < sleeve.scene.state.size(); ++i) {
    const double expected = rate * sleeve.scene.properties.mass[i];
    const double sum = springs.of_patches[i] + springs.more[i];
    EXPECT_GE(sum, (1.0 - kIteration) * expected);
    if (springs.more[i] == 0.0) continue;
    ++more;
    EXPECT_LE(sum, (1.0 + 1e-4) * expected);
  }
  EXPECT_GT(more, 0);
}

/// What is in range was forgotten: there was none of it until the next step.
TEST(StructureStiffness, IsThereWithAStateThatIsReadBack) {
  Scene scene;
  add_sleeve(scene, 1.0, Vec3::Zero());
  ResistingScene sleeve(scene), again(scene);
  geometry::StateTree state;
  sleeve.contacts->exchange(geometry::StateArchive::writer(state), scene.planes, sleeve.pool);
  again.contacts->exchange(geometry::StateArchive::reader(state), scene.planes, again.pool);

  const Springs before(sleeve), after(again);

  EXPECT_GT(*std::ranges::max_element(before.more), 0.0);
  EXPECT_EQ(after.more, before.more);
}

TEST(StructureStiffness, OfBodiesThatDoNotTouchEachOtherIsThatOfEachAlone) {
  Scene scene;
  add_sleeve(scene, 1.0, Vec3::Zero());
  const std::size_t count = scene.state.size();
  const ResistingScene alone(scene);
  add_sleeve(scene, 1e-3, Vec3::UnitX());  // a thousand times as fast
  const ResistingScene both(std::move(scene));

  const Springs of_alone(alone), of_both(both);

  for (std::size_t i = 0; i < count; ++i)
    EXPECT_NEAR(of_both.more[i] + of_both.of_patches[i], of_alone.more[i] + of_alone.of_patches[i],
                kIteration * (of_alone.more[i] + of_alone.of_patches[i]));
}

TEST(StructureStiffness, IsNoneOfWhatIsHeldOrDoesNotTouch) {
  const auto is_some = [](double more) { return more > 0.0; };
  Scene scene;
  add_sleeve(scene, 1.0, Vec3::Zero());
  const Springs of_free{ResistingScene(scene)};
  const auto first = std::find_if(of_free.more.begin(), of_free.more.end(), is_some);
  ASSERT_NE(first, of_free.more.end());
  const auto node = static_cast<std::size_t>(first - of_free.more.begin());

  scene.properties.held[node] = Held::translation;
  EXPECT_EQ(Springs(ResistingScene(scene)).more[node], 0.0);

  scene.properties.held[node] = Held::nothing;
  for (std::size_t i = 0; i < 12; ++i) scene.state.position[i].z() += 10.0;  // out of the other one
  const Springs of_apart{ResistingScene(scene)};
  EXPECT_TRUE(std::none_of(of_apart.more.begin(), of_apart.more.end(), is_some));
}

}  // namespace
}  // namespace plekton::test::structure_stiffness_test
