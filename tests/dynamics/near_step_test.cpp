// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/named_laws.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// Steps that a simulation chooses for itself, every one against the frequencies of the scene as a
/// whole with the contacts of that moment.
namespace plekton::test {
namespace {

using contact::MaterialId;
using dynamics::Held;
using dynamics::Scene;
using dynamics::Simulation;
using dynamics::SimulationOptions;
using geometry::NodeId;
const Vec3 kGravity(0.0, 0.0, -9.81);

contact::Material material(Random& random) {
  return {std::pow(10.0, random.uniform(5.5, 7.5)), random.uniform(0.0, 1.0),
          random.uniform(0.0, 0.8)};
}

void add_spheres(Scene& scene, Random& random, int count, double height) {
  for (int i = 0; i < count; ++i) {
    const double radius = random.uniform(0.005, 0.02);
    const Vec3 place(0.045 * (i % 3 - 1) + random.uniform(-0.002, 0.002),
                     0.045 * (i / 3 % 3 - 1) + random.uniform(-0.002, 0.002),
                     height + 0.022 + 0.045 * (i / 9));
    scene.add_sphere(place, radius, random.uniform(500.0, 3000.0), MaterialId{0});
    scene.state.velocity.back() = Vec3(0.0, 0.0, random.uniform(-3.0, 0.0)) + random.in_cube(0.5);
  }
}

/// A sheet of 0.2 m, thin or thick, held at two sides.
void add_sheet(Scene& scene, Random& random, double height) {
  const int cells = random.integer(2, 6);
  const geometry::Mesh mesh = geometry::plane_sheet({0.2, 0.2, cells, cells});
  const double thickness = random.uniform(0.001, 0.004);
  const auto first = scene.state.size();
  for (const Vec3& x : mesh.points)
    scene.add_node(x + Vec3(0.0, 0.0, height),
                   std::abs(x.x()) > 0.099 ? Held::everything : Held::nothing);
  const double modulus = std::pow(10.0, random.uniform(5.0, 7.0));
  for (const auto& facet : mesh.facets) {
    std::array<NodeId, 3> nodes = facet;
    for (NodeId& node : nodes) node = geometry::id_at<NodeId>(first + index_of(node));
    scene.add_facet(nodes[0], nodes[1], nodes[2], 0.5 * thickness, MaterialId{1});
    scene.add_sheet_facet(nodes, dynamics::solid_sheet(thickness, modulus, 0.3), 900.0);
  }
}

/// A net of 0.2 m, held at two sides.
void add_net(Scene& scene, Random& random, double height) {
  const int cells = random.integer(4, 16);
  const double radius = random.uniform(0.0005, 0.002);
  const auto section =
      dynamics::circular_section(radius, std::pow(10.0, random.uniform(7.0, 9.0)), 0.3);
  const auto first = scene.state.size();
  const auto node = [&](int i, int k) {
    return geometry::id_at<NodeId>(first + static_cast<std::size_t>(i * (cells + 1) + k));
  };
  const auto add = [&](NodeId a, NodeId b) {
    scene.add_cylinder(a, b, radius, MaterialId{1});
    scene.add_beam(a, b, section, 1500.0);
  };
  for (int i = 0; i <= cells; ++i) {
    for (int k = 0; k <= cells; ++k) {
      scene.add_node(Vec3(0.2 * i / cells - 0.1, 0.2 * k / cells - 0.1, height),
                     i == 0 || i == cells ? Held::everything : Held::nothing);
      if (i > 0) add(node(i - 1, k), node(i, k));
      if (k > 0) add(node(i, k - 1), node(i, k));
    }
  }
}

Scene random_scene(std::uint64_t seed) {
  Random random(seed);
  Scene scene;
  scene.materials = {material(random), material(random)};
  const int kind = random.integer(0, 3);
  if (kind == 0) scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), MaterialId{1}});
  if (kind == 1) add_sheet(scene, random, 0.0);
  if (kind == 2) add_net(scene, random, 0.0);
  if (kind == 3) {
    add_sheet(scene, random, 0.0);
    add_net(scene, random, 0.006);
  }
  add_spheres(scene, random, random.integer(1, 12), kind == 3 ? 0.01 : 0.004);
  return scene;
}

/// The largest of all steps over the critical one of that moment.
double largest_step(std::uint64_t seed, double duration, const contact::ContactModel& model) {
  Simulation simulation(random_scene(seed), {.motion = {.gravity = kGravity}}, model);
  double largest = 0.0;
  std::size_t contacts = 0;
  for (int i = 0; simulation.time() < duration; ++i) {
    const double before = simulation.time();
    simulation.step();
    const auto counts = simulation.contacts().counts();
    const std::size_t now = counts.sphere_sphere + counts.sphere_surface +
                            counts.between_structures + counts.with_planes;
    if (now == contacts && i % 40 != 0) continue;
    contacts = now;
    largest = std::max(largest, (simulation.time() - before) / simulation.exact_critical_step().dt);
  }
  return largest;
}

TEST(ChosenStep, IsNeverAboveItsPartOfTheCriticalOneInAnyOfManyScenes) {
  constexpr int kScenes = 24;
  for (int seed = 1; seed <= kScenes; ++seed) {
    const double largest =
        largest_step(static_cast<std::uint64_t>(seed), 0.02, contact::linear_frictional());

    EXPECT_LE(largest, dynamics::kLargestStep) << "scene " << seed;
  }
}

TEST(ChosenStep, IsNeverAboveItsPartWithDashpotsEither) {
  constexpr int kScenes = 60;  // scene 54 has rings of a net under a grain
  for (int seed = 1; seed <= kScenes; ++seed) {
    const double xi = Random(static_cast<std::uint64_t>(100 + seed)).uniform(0.05, 1.0);
    const auto law = with<contact::LinearFrictional>({}, {}, {xi});
    contact::PairProperties<contact::AnyLaw> properties;
    for (const auto& [a, b] : {std::pair{0, 0}, std::pair{0, 1}, std::pair{1, 1}})
      properties[{MaterialId{a}, MaterialId{b}}] = law;
    const double largest =
        largest_step(static_cast<std::uint64_t>(seed), 0.02, contact::any_law(properties));

    EXPECT_LE(largest, dynamics::kLargestStep) << "scene " << seed;
  }
}

}  // namespace
}  // namespace plekton::test
