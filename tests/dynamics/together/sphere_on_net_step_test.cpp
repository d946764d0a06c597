// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/stiffness_reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// Critical steps of a sphere on a net finer than itself, against the eigenvalue of the largest
/// magnitude of differences of the contacts' forces: on bars that are short beside the sphere it is
/// their turning that is stiffest, which no spring along the normals has.
namespace plekton::test::sphere_on_net_step_test {
namespace {

using dynamics::Simulation;
constexpr contact::MaterialId kMaterial{0};
constexpr double kRadius = 0.05;  // m, of the sphere
constexpr double kWire = 0.001;   // m, radius

struct Net {
  double pitch;    // m
  int nodes;       // along each side
  double overlap;  // m
  double height;   // m, by which nodes are off the plane at random
  double mass;     // kg, of a node; the sphere weighs 1
};

/// Without friction, so that forces follow from places alone. No bonds: contacts are all there is.
Scene sphere_on(const Net& net, Random& random) {
  Scene scene;
  scene.materials = {{1e8, 0.0, 0.0}};
  const double half = 0.5 * net.pitch * (net.nodes - 1);
  for (int i = 0; i < net.nodes * net.nodes; ++i) {
    const Vec3 place(net.pitch * (i % net.nodes) - half, net.pitch * (i / net.nodes) - half,
                     random.uniform(-net.height, net.height));
    const NodeId node = scene.add_node(place);
    scene.properties.mass.back() = net.mass;
    scene.properties.inertia.back() = 1.0;
    if (i % net.nodes > 0)
      scene.add_cylinder(geometry::id_at<NodeId>(index_of(node) - 1), node, kWire, kMaterial);
    if (i >= net.nodes)
      scene.add_cylinder(
          geometry::id_at<NodeId>(index_of(node) - static_cast<std::size_t>(net.nodes)), node,
          kWire, kMaterial);
  }
  const double x = random.uniform(0.0, net.pitch);
  const double y = random.uniform(0.0, net.pitch);
  scene.add_sphere(Vec3(x, y, kRadius + kWire - net.overlap), kRadius, 1.0, kMaterial);
  scene.properties.mass.back() = 1.0;
  return scene;
}

Eigen::VectorXd contact_forces(const Scene& scene, const geometry::Surface& surface,
                               const std::vector<Vec3>& x) {
  const auto contacts = contact::linear_frictional()({.spheres = scene.elements.spheres,
                                                      .surface = surface,
                                                      .materials = scene.materials,
                                                      .of_spheres = {kMaterial},
                                                      .of_structures = {kMaterial},
                                                      .masses = {},
                                                      .skin = 0.001,
                                                      .meets_planes = {},
                                                      .rest = {}});
  geometry::ThreadPool pool;
  contact::NodeForces forces(x.size());
  const std::vector<Vec3> still(x.size(), Vec3::Zero());
  contacts->advance({x, still, still}, {}, 0.0, pool, forces);
  Eigen::VectorXd stacked = Eigen::VectorXd::Zero(first_entry(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i) stacked.segment<3>(first_entry(i)) = forces.force[i];
  return stacked;
}

/// 2 / sqrt of the eigenvalue of the largest magnitude, from the whole matrix.
double limit_by_differences(const Scene& scene) {
  const geometry::Surface surface(scene.elements.cylinders, scene.elements.facets,
                                  scene.state.size());
  const auto size = first_entry(scene.state.size());
  constexpr double kStep = 1e-9;  // m
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
  std::vector<Vec3> x = scene.state.position;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double at = x[i][axis];
      x[i][axis] = at - kStep;
      const Eigen::VectorXd before = contact_forces(scene, surface, x);
      x[i][axis] = at + kStep;
      stiffness.col(first_entry(i) + axis) =
          (before - contact_forces(scene, surface, x)) / (2.0 * kStep);
      x[i][axis] = at;
    }
  }
  return std::min(true_limit(stiffness, scene.properties),
                  true_limit(-stiffness, scene.properties));
}

constexpr std::array<Net, 7> kNets{{
    {0.1 * kRadius, 8, 0.03 * kRadius, 0.0, 1e-3},
    {0.1 * kRadius, 8, 0.03 * kRadius, 0.0, 0.1},
    {0.1 * kRadius, 8, 0.03 * kRadius, 0.01 * kRadius, 1e-3},
    {0.1 * kRadius, 8, 0.01 * kRadius, 0.0, 1e-3},
    {0.2 * kRadius, 6, 0.03 * kRadius, 0.0, 1e-3},
    {0.2 * kRadius, 6, 0.08 * kRadius, 0.02 * kRadius, 0.1},
    {0.5 * kRadius, 5, 0.02 * kRadius, 0.0, 10.0},
}};

// Some of the nets above close rings under the sphere: the weights of features change with their
// distances, which the springs of the features do not have (SpreadStiffness).
TEST(SphereOnNetStep, IsNeverEstimatedAboveWhatDifferencesOfForcesGive) {
  Random random(31);
  for (std::size_t i = 0; i < kNets.size(); ++i) {
    for (int place = 0; place < 4; ++place) {
      const Scene scene = sphere_on(kNets[i], random);
      const double limit = limit_by_differences(scene);

      const Simulation simulation(scene, {});

      EXPECT_LE(simulation.critical_step().dt, limit * (1.0 + 1e-3)) << "net " << i;
      EXPECT_LE(simulation.present_critical_step().dt, limit * (1.0 + 1e-3)) << "net " << i;
      EXPECT_GE(simulation.present_critical_step().dt, 0.25 * limit) << "net " << i;
      EXPECT_LE(simulation.exact_critical_step().dt, limit * (1.0 + 2e-3)) << "net " << i;
      EXPECT_GE(simulation.exact_critical_step().dt, limit * 0.98) << "net " << i;
    }
  }
}

// Apertures wider than the contact: no ring closes.
TEST(SphereOnNetStep, IsNeverEstimatedAboveWhatDifferencesOfForcesGiveWhereNoRingCloses) {
  Random random(32);
  int touching = 0;
  for (const double mass : {1e-3, 0.1, 10.0}) {
    for (int place = 0; place < 8; ++place) {
      const Net net{0.6 * kRadius, 5, 0.01 * kRadius, 0.0, mass};
      const Scene scene = sphere_on(net, random);
      const double limit = limit_by_differences(scene);
      if (!std::isfinite(limit)) continue;  // over a hole, it touches nothing
      ++touching;

      const Simulation simulation(scene, {});

      EXPECT_LE(simulation.critical_step().dt, limit * (1.0 + 1e-3)) << mass << ' ' << place;
      EXPECT_LE(simulation.exact_critical_step().dt, limit * (1.0 + 2e-3)) << mass << ' ' << place;
      EXPECT_GE(simulation.exact_critical_step().dt, limit * 0.98) << mass << ' ' << place;
    }
  }
  EXPECT_GT(touching, 12);
}

}  // namespace
}  // namespace plekton::test::sphere_on_net_step_test
