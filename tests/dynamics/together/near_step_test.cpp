// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/models.hpp"
#include "dynamics/loads/applied_loads.hpp"
#include "dynamics/simulation.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/sheet_facets.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/named_laws.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

/// Steps that a simulation chooses for itself, every one against the frequencies of the scene as a
/// whole with the contacts of that moment: as it knows them itself and, where structures meet, by
/// differences of the contacts' forces, of which its own estimate knows nothing.
namespace plekton::test::near_step_test {
namespace {

using contact::MaterialId;
using dynamics::Held;
using dynamics::Scene;
using dynamics::Simulation;
using dynamics::SimulationOptions;
using geometry::Mat3;
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

// Structures that meet structures.

/// How far nodes of sheets are off their mesh, in thicknesses: no edge lies exactly along another.
constexpr double kUneven = 0.02;

/// Facets of a sheet on the points of a mesh.
struct SheetBody {
  geometry::Mesh mesh;
  double thickness;  ///< m
  double modulus;    ///< Pa
  MaterialId material;
};
/// @param held  (place) -> what is held there
template <class HeldAt>
void add_body(Scene& scene, const SheetBody& body, const Vec3& velocity, const HeldAt& held) {
  const auto first = scene.state.size();
  for (const Vec3& x : body.mesh.points) {
    scene.add_node(x, held(x));
    if (held(x) == Held::nothing) scene.state.velocity.back() = velocity;
  }
  for (const auto& facet : body.mesh.facets) {
    std::array<NodeId, 3> nodes = facet;
    for (NodeId& node : nodes) node = geometry::id_at<NodeId>(first + index_of(node));
    scene.add_facet(nodes[0], nodes[1], nodes[2], 0.5 * body.thickness, body.material);
    scene.add_sheet_facet(nodes, dynamics::solid_sheet(body.thickness, body.modulus, 0.3), 900.0);
  }
}

/// One that is held at two sides, and one that is thrown onto it, turned and tilted a little.
void add_sheet_on_sheet(Scene& scene, Random& random) {
  const auto sheet = [&](int material) {
    const int cells = random.integer(2, 4);
    return SheetBody{geometry::plane_sheet({0.2, 0.2, cells, cells}), random.uniform(0.001, 0.004),
                     std::pow(10.0, random.uniform(5.0, 7.0)), MaterialId{material}};
  };
  SheetBody lower = sheet(0);
  SheetBody upper = sheet(1);
  const Mat3 turn =
      (Eigen::AngleAxisd(random.uniform(0.0, 0.05), random.direction()) *
       Eigen::AngleAxisd(random.coin() ? 0.0 : random.uniform(0.0, 0.8), Vec3::UnitZ()))
          .toRotationMatrix();
  for (Vec3& x : upper.mesh.points)
    x = 0.7 * (turn * x) + (0.5 * (lower.thickness + upper.thickness) + 0.008) * Vec3::UnitZ();
  for (SheetBody* body : {&lower, &upper})
    for (Vec3& x : body->mesh.points) x += random.in_cube(kUneven * body->thickness);
  const Vec3 down(0.0, 0.0, random.uniform(-2.0, -0.5));
  add_body(scene, lower, Vec3::Zero(), [](const Vec3& x) {
    return std::abs(x.x()) > 0.099 ? Held::everything : Held::nothing;
  });
  add_body(scene, upper, down, [](const Vec3&) { return Held::nothing; });
}

/// A chain of bars over the upper half of a cage of bars, pulled tight by what hangs at its ends.
void add_belt_on_drum(Scene& scene, Random& random) {
  const double radius = random.uniform(0.03, 0.06);
  const double bar = random.uniform(0.002, 0.006);
  const double belt = random.uniform(0.001, 0.003);
  const double modulus = std::pow(10.0, random.uniform(6.0, 8.0));
  const auto add = [&](NodeId a, NodeId b, double r, int material) {
    scene.add_cylinder(a, b, r, MaterialId{material});
    scene.add_beam(a, b, dynamics::circular_section(r, modulus, 0.3), 1500.0);
  };
  const int bars = random.integer(8, 14);
  const auto at = [](double r, double angle, double y) {
    return Vec3(r * std::cos(angle), y, r * std::sin(angle));
  };
  std::array<NodeId, 2> before{};
  std::array<NodeId, 2> first{};
  for (int i = 0; i < bars; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / bars;
    const std::array<NodeId, 2> ends{
        scene.add_node(at(radius, angle, -0.02), i % 4 == 0 ? Held::everything : Held::nothing),
        scene.add_node(at(radius, angle, 0.03))};
    add(ends[0], ends[1], bar, 0);
    for (std::size_t k = 0; k < 2; ++k) {
      if (i > 0) add(before[k], ends[k], bar, 0);
      if (i == 0) first[k] = ends[k];
      if (i + 1 == bars) add(ends[k], first[k], bar, 0);
    }
    before = ends;
  }
  const int links = random.integer(8, 16);
  const double clear = radius + bar + belt + 0.002;
  const double slant = random.uniform(-0.005, 0.005);
  const double speed = random.uniform(0.5, 2.0);
  for (int i = 0; i <= links; ++i) {
    const double angle = std::numbers::pi * i / links;
    const NodeId node = scene.add_node(at(clear / std::cos(0.5 * std::numbers::pi / links), angle,
                                          slant * (2.0 * i / links - 1.0)));
    scene.state.velocity.back() = Vec3(0.0, 0.0, -speed);
    if (i > 0) add(geometry::id_at<NodeId>(index_of(node) - 1), node, belt, 1);
    if (i == 0 || i == links) scene.properties.mass.back() += random.uniform(0.0, 0.05);
  }
}

/// A tube in a wider one, thrown at its wall.
void add_tube_in_tube(Scene& scene, Random& random) {
  const double radius = random.uniform(0.02, 0.05);
  const double length = random.uniform(0.05, 0.1);
  const double thickness = random.uniform(0.002, 0.004);
  const int around = random.integer(6, 9);
  const auto tube = [&](double r, int material) {
    return SheetBody{geometry::tube({r / std::cos(std::numbers::pi / around), length, around, 1}),
                     thickness, std::pow(10.0, random.uniform(5.0, 7.0)), MaterialId{material}};
  };
  SheetBody outer = tube(radius + 1.3 * thickness, 0);
  SheetBody inner = tube(radius, 1);
  for (SheetBody* body : {&outer, &inner})
    for (Vec3& x : body->mesh.points) x += random.in_cube(kUneven * thickness);
  const double speed = random.uniform(1.0, 3.0);
  const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
  const auto free = [](const Vec3&) { return Held::nothing; };
  add_body(scene, outer, Vec3::Zero(), free);
  add_body(scene, inner, Vec3(speed * std::cos(angle), speed * std::sin(angle), 0.0), free);
}

enum class Meeting { sheet_on_sheet, belt_on_drum, tube_in_tube };

Scene structures(Meeting kind, std::uint64_t seed) {
  Random random(seed);
  Scene scene;
  // Hard beside the structures, so that it is contacts that limit the step.
  scene.materials = {material(random), material(random)};
  for (contact::Material& of : scene.materials)
    of.young_modulus = std::pow(10.0, random.uniform(6.5, 9.0));
  if (kind == Meeting::sheet_on_sheet) add_sheet_on_sheet(scene, random);
  if (kind == Meeting::belt_on_drum) add_belt_on_drum(scene, random);
  if (kind == Meeting::tube_in_tube) add_tube_in_tube(scene, random);
  return scene;
}

/// 2 / omega_max where the forces of the last step were found, of what bonds and sheets resist and
/// of differences of the elastic forces of contacts, which are asked anew of contacts that know
/// nothing but places. Friction is left out, with which the true limit is shorter: a step above
/// this one is too long in any case.
double limit_by_forces(const Simulation& simulation, const std::vector<Vec3>& rest) {
  Scene scene = simulation.scene();
  scene.state.position = simulation.force_positions();
  const geometry::Surface surface(scene.elements.cylinders, scene.elements.facets,
                                  scene.state.size());
  const auto contacts =
      contact::linear_frictional()({.spheres = {},
                                    .surface = surface,
                                    .materials = scene.materials,
                                    .of_spheres = {},
                                    .of_structures = {MaterialId{0}, MaterialId{1}},
                                    .masses = {},
                                    .skin = 0.001,
                                    .meets_planes = {},
                                    .rest = rest});
  geometry::ThreadPool pool;
  const std::vector<Vec3> still(scene.state.size(), Vec3::Zero());
  const auto normal = [&](geometry::Positions x, contact::NodeForces& forces) {
    contacts->advance({x, still, still}, {}, 0.0, pool, forces);
  };
  return dynamics::exact_critical_step(
             scene, {simulation.bonds(), simulation.sheet_facets(), simulation.ties(), 0.0},
             simulation.loads(), {}, simulation.time(), normal)
      .dt;
}

struct LargestSteps {
  double by_springs = 0.0;  ///< over exact_critical_step()
  double by_forces = 0.0;   ///< over limit_by_forces()
  int touching = 0;         ///< looks with contacts
};
LargestSteps largest_steps(Meeting kind, std::uint64_t seed) {
  constexpr double kDuration = 0.02;  // s
  Simulation simulation(structures(kind, seed), {.motion = {.gravity = kGravity}});
  const std::vector<Vec3> rest = simulation.state().position;
  LargestSteps largest;
  std::size_t contacts = 0;
  for (int i = 0; simulation.time() < kDuration; ++i) {
    const double before = simulation.time();
    simulation.step();
    const double step = simulation.time() - before;
    const std::size_t now = simulation.contacts().counts().between_structures;
    if ((now == contacts || i % 5 != 0) && i % 40 != 0) continue;
    contacts = now;
    largest.touching += now > 0 ? 1 : 0;
    largest.by_springs = std::max(largest.by_springs, step / simulation.exact_critical_step().dt);
    if (now > 0)
      largest.by_forces = std::max(largest.by_forces, step / limit_by_forces(simulation, rest));
  }
  return largest;
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
  constexpr int kFirst = 37, kLast = 60;  // scene 54 has rings of a net under a grain
  for (int seed = kFirst; seed <= kLast; ++seed) {
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

class ChosenStepOfStructures : public testing::TestWithParam<Meeting> {};

TEST_P(ChosenStepOfStructures, IsNeverAboveItsPartOfTheCriticalOne) {
  constexpr int kScenes = 5;
  for (int seed = 1; seed <= kScenes; ++seed) {
    const LargestSteps largest = largest_steps(GetParam(), static_cast<std::uint64_t>(seed));

    EXPECT_LE(largest.by_springs, dynamics::kLargestStep) << "scene " << seed;
    EXPECT_LE(largest.by_forces, dynamics::kLargestStep) << "scene " << seed;
    EXPECT_GT(largest.touching, 0) << "scene " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, ChosenStepOfStructures,
                         testing::Values(Meeting::sheet_on_sheet, Meeting::belt_on_drum,
                                         Meeting::tube_in_tube),
                         [](const auto& of) {
                           switch (of.param) {
                             case Meeting::sheet_on_sheet:
                               return "SheetOnSheet";
                             case Meeting::belt_on_drum:
                               return "BeltOnDrum";
                             default:
                               return "TubeInTube";
                           }
                         });

}  // namespace
}  // namespace plekton::test::near_step_test
