// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/stiffness/nodal_stiffness.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "tests/support/beam_structure.hpp"
#include "tests/support/linear_algebra.hpp"
#include "tests/support/seeded_random.hpp"

#include <algorithm>
#include <cmath>

/// Whole stiffness matrices of small scenes, and the time step that they allow.
namespace plekton::test {

using dynamics::ContactStiffness;
using dynamics::Held;
using dynamics::NodeProperties;

/// 2 / omega_max of the free motions, from the whole matrix.
inline double true_limit(const Eigen::MatrixXd& stiffness, const NodeProperties& properties) {
  Eigen::VectorXd scale(stiffness.rows());
  for (std::size_t i = 0; i < properties.size(); ++i) {
    const Held held = properties.held[i];
    const double mass = holds_translation(held) ? 0.0 : 1.0 / std::sqrt(properties.mass[i]);
    const double inertia = holds_rotation(held) ? 0.0 : 1.0 / std::sqrt(properties.inertia[i]);
    scale.segment<6>(first_entry(i)) << mass * dynamics::free_axes(held),
        inertia * dynamics::free_turns(held);
  }
  const Eigen::MatrixXd symmetric = 0.5 * (stiffness + stiffness.transpose());
  const Eigen::MatrixXd scaled = scale.asDiagonal() * symmetric * scale.asDiagonal();
  return 2.0 / std::sqrt(eigenvalues_of(scaled).maxCoeff());
}

/// Of the bonds of a scene.
inline double true_limit(const Scene& scene) {
  BeamBonds bonds(scene.bonds, scene.state.size());
  return true_limit(stiffness_matrix(bonds, scene.state, 1e-6), scene.properties);
}

/// The stiffness matrix of contacts, spring by spring.
class ContactMatrix {
 public:
  explicit ContactMatrix(std::size_t node_count)
      : matrix_(Eigen::MatrixXd::Zero(first_entry(node_count), first_entry(node_count))) {}

  void add(NodeId ball, const geometry::CorePoint& core, const ContactStiffness& contact) {
    const Vec3& n = contact.normal;
    const Vec3 t = n.unitOrthogonal();
    add_spring(ball, core, contact, n, contact.normal_stiffness);
    add_spring(ball, core, contact, t, contact.tangential_stiffness);
    add_spring(ball, core, contact, n.cross(t), contact.tangential_stiffness);
  }

  void add_wall(NodeId ball, const ContactStiffness& contact) {
    const geometry::CorePoint nothing{{ball, ball, ball}, Vec3::Zero(), geometry::Feature(ball)};
    add(ball, nothing, contact);
  }

  const Eigen::MatrixXd& matrix() const { return matrix_; }

 private:
  /// Elongation along a direction: velocity of the contact point on b less that on a.
  void add_spring(NodeId ball, const geometry::CorePoint& core, const ContactStiffness& contact,
                  const Vec3& direction, double stiffness) {
    Eigen::VectorXd g = Eigen::VectorXd::Zero(matrix_.rows());
    const Vec3 lever = contact.normal.cross(direction);
    g.segment<3>(first_entry(index_of(ball))) -= direction;
    g.segment<3>(first_entry(index_of(ball)) + 3) -= contact.arm_a * lever;
    for (std::size_t i = 0; i < 3; ++i) {
      const double weight = core.weights[static_cast<int>(i)];
      const Eigen::Index first = first_entry(index_of(core.nodes[i]));
      g.segment<3>(first) += weight * direction;
      g.segment<3>(first + 3) -= weight * contact.arm_b * lever;
    }
    matrix_ += stiffness * g * g.transpose();
  }

  Eigen::MatrixXd matrix_;
};

/// Nodes at random, joined by beams of very different section; some nodes heavy, some held.
inline Scene random_frame(Random& random) {
  constexpr std::size_t kNodes = 7;
  Scene scene;
  for (std::size_t i = 0; i < kNodes; ++i) scene.add_node(random.in_cube(1.0));
  for (std::size_t i = 0; i < 12; ++i) {
    const std::size_t a = i < kNodes ? i : random.index(kNodes);
    const std::size_t b = i < kNodes ? (i + 1) % kNodes : random.index(kNodes);
    if (a == b) continue;
    const double radius = std::abs(random.signed_power(-2.5, 0.0));
    const auto section = dynamics::circular_section(radius, 1e3, random.uniform(-0.5, 0.5));
    scene.add_beam(geometry::id_at<NodeId>(a), geometry::id_at<NodeId>(b), section, 1.0);
  }
  for (std::size_t i = 0; i < kNodes; ++i) {
    if (random.coin()) scene.properties.mass[i] *= std::abs(random.signed_power(-2.0, 2.0));
    if (random.coin()) scene.properties.inertia[i] *= std::abs(random.signed_power(-2.0, 2.0));
    if (random.integer(0, 4) == 0)
      scene.properties.held[i] = static_cast<Held>(random.integer(1, 63));
  }
  scene.properties.held[0] = Held::nothing;
  return scene;
}

}  // namespace plekton::test
