// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"
#include "dynamics/state/rotation_step.hpp"
#include "dynamics/structure/beam_bonds.hpp"

#include <Eigen/LU>

#include <cmath>
#include <stdexcept>
#include <vector>

/// Statics of beams, from the forces of the library alone. A displacement has six entries for each
/// node: translation (m), then rotation vector (rad) in world axes.
namespace plekton::test {

using dynamics::BeamBond;
using dynamics::BeamBonds;
using dynamics::BeamSection;
using dynamics::NodeState;
using dynamics::Scene;
using geometry::NodeId;
using geometry::Quat;
using geometry::Vec3;

inline Eigen::Index first_entry(std::size_t node) {
  return static_cast<Eigen::Index>(6 * node);
}

/// The state after a displacement; rotations are exact.
inline NodeState displaced(NodeState state, const Eigen::VectorXd& displacement) {
  for (std::size_t i = 0; i < state.size(); ++i) {
    state.position[i] += displacement.segment<3>(first_entry(i));
    state.orientation[i] =
        dynamics::turned(state.orientation[i], displacement.segment<3>(first_entry(i) + 3), 1.0);
    state.orientation[i].normalize();
  }
  return state;
}

/// Forces (N) and torques (N m) of the bonds on the nodes.
inline Eigen::VectorXd bond_forces(BeamBonds& bonds, const NodeState& state) {
  geometry::ThreadPool pool;
  contact::NodeForces forces(state.size());
  bonds.advance(state, pool);
  bonds.add_forces(forces, pool);
  Eigen::VectorXd stacked(first_entry(state.size()));
  for (std::size_t i = 0; i < state.size(); ++i) {
    stacked.segment<6>(first_entry(i)) << forces.force[i], forces.torque[i];
  }
  return stacked;
}

/// - d force / d displacement by central differences: error of second order in the step (m and
/// rad).
inline Eigen::MatrixXd stiffness_matrix(BeamBonds& bonds, const NodeState& state, double step) {
  const Eigen::Index size = first_entry(state.size());
  Eigen::MatrixXd stiffness(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const Eigen::VectorXd change = step * Eigen::VectorXd::Unit(size, i);
    stiffness.col(i) = (bond_forces(bonds, displaced(state, -change)) -
                        bond_forces(bonds, displaced(state, change))) /
                       (2.0 * step);
  }
  return stiffness;
}

/// Straight beams of equal length along x, from the origin; no node is held.
inline Scene chain(int bond_count, double total_length, const BeamSection& section,
                   double density = 1000.0) {
  Scene scene;
  for (int i = 0; i <= bond_count; ++i) {
    const NodeId node = scene.add_node(Vec3(total_length * i / bond_count, 0.0, 0.0));
    if (i > 0)
      scene.add_beam(geometry::id_at<NodeId>(geometry::index_of(node) - 1), node, section, density);
  }
  return scene;
}

/// Entries that may change: all but those of the first node, which is clamped, and what is held.
inline std::vector<Eigen::Index> free_entries(const Scene& scene) {
  std::vector<Eigen::Index> entries;
  for (std::size_t i = 1; i < scene.state.size(); ++i) {
    for (int k = 0; k < 6; ++k) {
      const auto held = scene.properties.held[i];
      const bool is_held = k < 3 ? holds_along(held, k) : holds_about(held, k - 3);
      if (!is_held) entries.push_back(first_entry(i) + k);
    }
  }
  return entries;
}

/// Moves all nodes but the first, which is clamped, to where the bonds balance the loads (N and
/// N m), as far as they are not held: Newton's method from the state of the scene, in equal load
/// steps.
/// @throws std::runtime_error if it does not converge
inline void balance(Scene& scene, const Eigen::VectorXd& loads, int load_steps) {
  BeamBonds bonds(scene.bonds, scene.state.size());
  const std::vector<Eigen::Index> free = free_entries(scene);
  const double length = scene.bonds.front().length;
  for (int k = 1; k <= load_steps; ++k) {
    const Eigen::VectorXd load = loads * k / load_steps;
    for (int iteration = 0;; ++iteration) {
      if (iteration > 50) throw std::runtime_error("the beams do not come to rest");
      const Eigen::VectorXd residual = load + bond_forces(bonds, scene.state);
      const Eigen::MatrixXd stiffness = stiffness_matrix(bonds, scene.state, 1e-6 * length);
      Eigen::VectorXd change = Eigen::VectorXd::Zero(loads.size());
      const Eigen::VectorXd of_free =
          stiffness(free, free).eval().partialPivLu().solve(residual(free).eval());
      for (std::size_t i = 0; i < free.size(); ++i)
        change[free[i]] = of_free[static_cast<Eigen::Index>(i)];
      scene.state = displaced(scene.state, change);
      if (change.lpNorm<Eigen::Infinity>() < 1e-11 * length) break;
    }
  }
}

/// Rotation vector (rad) of a unit quaternion, at most half a turn.
inline Vec3 rotation_vector(const Quat& q) {
  const double sine = q.vec().norm();
  if (sine == 0.0) return Vec3::Zero();
  return (2.0 * std::atan2(q.w() < 0.0 ? -sine : sine, std::abs(q.w())) / sine) * q.vec();
}

}  // namespace plekton::test
