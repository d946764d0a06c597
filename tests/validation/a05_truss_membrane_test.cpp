// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/beam_structure.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <utility>

namespace plekton::test {
namespace {

using dynamics::Held;
using geometry::index_of;
using geometry::Mat3;

constexpr double kRadius = 0.01;            // m
constexpr double kModulus = 1e7;            // Pa
constexpr double kLoad = 50.0;              // N, downward on the node in the middle
constexpr double kReference = -0.06961598;  // m, minimised energy of the same lattice (y11)
constexpr std::size_t kMiddle = 40;

/// Square membrane of 1 m, 8 x 8 cells of two facets, cut the other way by turns; bars along all
/// edges, nodes at the sides fixed, no node turns.
Scene truss_membrane() {
  Scene scene;
  const geometry::Mesh mesh = geometry::plane_sheet({1.0, 1.0, 8, 8});
  for (const Vec3& x : mesh.points) {
    const bool fixed = x.head<2>().cwiseAbs().maxCoeff() > 0.5 - 1e-9;
    scene.add_node(x, fixed ? Held::everything : Held::rotation);
  }
  std::set<std::pair<NodeId, NodeId>> edges;
  for (const auto& facet : mesh.facets) {
    for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(facet[i], facet[(i + 1) % 3]));
  }
  for (const auto& [a, b] : edges)
    scene.add_beam(a, b, dynamics::bar_section(kRadius, kModulus), 1000.0);
  return scene;
}

/// - d force / d position (N/m) of all bars, without what slack bars would take off it.
Eigen::MatrixXd stiffness_of(const Scene& scene) {
  const auto size = static_cast<Eigen::Index>(3 * scene.state.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for (const dynamics::BeamBond& bar : scene.bonds) {
    const auto a = static_cast<Eigen::Index>(3 * index_of(bar.nodes[0]));
    const auto b = static_cast<Eigen::Index>(3 * index_of(bar.nodes[1]));
    const Vec3 chord =
        scene.state.position[index_of(bar.nodes[1])] - scene.state.position[index_of(bar.nodes[0])];
    const double length = chord.norm();
    const Vec3 n = chord / length;
    const double stiffness = bar.section.young_modulus * bar.section.area / bar.length;
    const double across = std::max(0.0, stiffness * (length - bar.length) / length);
    const Mat3 k = across * Mat3::Identity() + ((stiffness - across) * n) * n.transpose();
    matrix.block<3, 3>(a, a) += k;
    matrix.block<3, 3>(b, b) += k;
    matrix.block<3, 3>(a, b) -= k;
    matrix.block<3, 3>(b, a) -= k;
  }
  return matrix;
}

/// Newton's method with the forces of the library; a flat membrane has no stiffness across itself,
/// so the first steps have some put on the diagonal.
void balance_truss(Scene& scene) {
  dynamics::BeamBonds bonds(scene.bonds, scene.state.size());
  for (int iteration = 0; iteration < 300; ++iteration) {
    const Eigen::VectorXd all = bond_forces(bonds, scene.state);
    Eigen::MatrixXd matrix = stiffness_of(scene);
    Eigen::VectorXd force(matrix.rows());
    for (std::size_t i = 0; i < scene.state.size(); ++i)
      force.segment<3>(static_cast<Eigen::Index>(3 * i)) = all.segment<3>(first_entry(i));
    force[3 * kMiddle + 2] -= kLoad;
    matrix.diagonal().array() += iteration < 30 ? 100.0 : 1e-6;  // N/m; a bar has 25 000
    for (std::size_t i = 0; i < scene.state.size(); ++i) {
      if (!holds_translation(scene.properties.held[i])) continue;
      const auto k = static_cast<Eigen::Index>(3 * i);
      matrix.middleRows<3>(k).setZero();
      matrix.middleCols<3>(k).setZero();
      matrix.block<3, 3>(k, k).setIdentity();
      force.segment<3>(k).setZero();
    }
    const Eigen::VectorXd change = matrix.ldlt().solve(force);
    const double share = std::min(1.0, 0.01 / change.lpNorm<Eigen::Infinity>());
    for (std::size_t i = 0; i < scene.state.size(); ++i)
      scene.state.position[i] += share * change.segment<3>(static_cast<Eigen::Index>(3 * i));
    if (change.lpNorm<Eigen::Infinity>() < 1e-12) return;
  }
  FAIL() << "the truss does not come to rest";
}

TEST(A05TrussMembrane, SagsUnderALoadAsItsLeastEnergySays) {
  Scene scene = truss_membrane();

  balance_truss(scene);

  std::printf("truss membrane: z = %.9f m, reference %.8f m\n", scene.state.position[kMiddle].z(),
              kReference);
  EXPECT_NEAR(scene.state.position[kMiddle].z(), kReference, 1e-6);
}

}  // namespace
}  // namespace plekton::test
