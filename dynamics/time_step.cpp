// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plekton::dynamics {
namespace {

/// Scale of rotations in a contact: s = 1 for a translation, kRolling / arm for a rotation. Alone,
/// the tangential spring asks for 5/2 (balls of inertia 2/5 m r²); with the normal one beside it,
/// which acts on translations only, less: 1.5 to 2 for stiffness ratios from 0.3 to 0.5.
constexpr double kRolling = 2.0;

/// c n n + t (I - n n).
Mat3 along_and_across(const Vec3& n, double along, double across) noexcept {
  return across * Mat3::Identity() + ((along - across) * n) * n.transpose();
}

double largest_eigenvalue(const Mat3& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(symmetric, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[2];
}

/// Shortens the step to 2 sqrt(mass / stiffness) if that is less.
void limit(CriticalStep& step, const Mat3& stiffness, double mass, std::size_t node,
           bool rotation) {
  const double largest = largest_eigenvalue(stiffness);
  if (!(largest > 0.0)) return;
  const double dt = 2.0 * std::sqrt(mass / largest);
  if (dt < step.dt) step = {dt, geometry::id_at<NodeId>(node), rotation};
}

}  // namespace

NodalStiffness::NodalStiffness(std::size_t node_count)
    : translation_(node_count, Mat3::Zero()), rotation_(node_count, Mat3::Zero()) {}

// Let u and t be the sum and difference of the nodes' rotations across the beam, and v the relative
// displacement across it. The energies of shear and bending are 1/2 of
//   12 EI/(L0 L²) (v - L/2 u)² + EI/L0 t²
//     <= 12 EI/(L0 L²) (1 + 1/gamma) v² + 3 EI/L0 (1 + gamma) u² + EI/L0 t²,
// with v² <= 2 (v_a² + v_b²), and u² + t² = 2 (u_a² + u_b²) since sum and difference are
// orthogonal: the larger of their factors holds for both.
void NodalStiffness::add_beam(const BeamBond& bond, const NodeState& state) {
  const BeamSection& section = bond.section;
  const Vec3 chord =
      state.position[index_of(bond.nodes[1])] - state.position[index_of(bond.nodes[0])];
  const double distance = chord.norm();
  const double length = distance > 0.0 ? distance : bond.length;
  const Vec3 n = distance > 0.0 ? Vec3(chord / distance) : Vec3(Vec3::UnitX());

  const double axial = section.young_modulus * section.area / bond.length;
  const double bending = section.young_modulus * section.second_moment / bond.length;
  const double twist = section.shear_modulus * section.torsion_constant / bond.length;
  const double gamma = 1.6 * section.area / (std::numbers::pi * length * length);
  const double shear = 12.0 * bending / (length * length) * (1.0 + 1.0 / gamma);
  const double tension = std::max(0.0, axial * (length - bond.length));

  const Mat3 translation = along_and_across(n, 2.0 * axial, 2.0 * (shear + tension / length));
  const Mat3 rotation = along_and_across(n, 2.0 * twist, 6.0 * bending * (1.0 + gamma));
  for (const NodeId node : bond.nodes) {
    translation_[index_of(node)] += translation;
    rotation_[index_of(node)] += rotation;
  }
}

/// @param factor  the node's part in the contact times the sum of the parts: sum_j |g_j| s_j =
/// factor
///                for the normal spring, and 1 + kRolling times that for the tangential one
void NodalStiffness::add_contact_end(NodeId node, const ContactStiffness& contact, double arm,
                                     double factor) {
  const double normal = factor * contact.normal_stiffness;
  const double tangential = factor * (1.0 + kRolling) * contact.tangential_stiffness;
  translation_[index_of(node)] += along_and_across(contact.normal, normal, tangential);
  rotation_[index_of(node)] +=
      along_and_across(contact.normal, 0.0, arm * arm / kRolling * tangential);
}

void NodalStiffness::add_pair(NodeId a, NodeId b, const ContactStiffness& contact) {
  add_contact_end(a, contact, contact.arm_a, 2.0);
  add_contact_end(b, contact, contact.arm_b, 2.0);
}

void NodalStiffness::add_on_surface(NodeId ball, const geometry::CorePoint& core,
                                    const ContactStiffness& contact) {
  add_contact_end(ball, contact, contact.arm_a, 2.0);
  for (std::size_t i = 0; i < core.nodes.size(); ++i) {
    const double weight = core.weights[static_cast<Eigen::Index>(i)];
    if (weight != 0.0) add_contact_end(core.nodes[i], contact, contact.arm_b, 2.0 * weight);
  }
}

void NodalStiffness::add_to_wall(NodeId ball, const ContactStiffness& contact) {
  add_contact_end(ball, contact, contact.arm_a, 1.0);
}

void NodalStiffness::add_dense_packing(NodeId sphere, double normal, double tangential,
                                       double radius) {
  for (const Vec3& direction : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())}) {
    const ContactStiffness contact{direction, normal, tangential, radius, radius};
    add_contact_end(sphere, contact, radius, 12.0 / 3.0 * 2.0);
  }
}

CriticalStep NodalStiffness::critical_step(const NodeProperties& properties) const {
  CriticalStep step;
  for (std::size_t i = 0; i < translation_.size(); ++i) {
    const Held held = properties.held[i];
    if (!holds_translation(held)) limit(step, translation_[i], properties.mass[i], i, false);
    if (!holds_rotation(held)) limit(step, rotation_[i], properties.inertia[i], i, true);
  }
  return step;
}

}  // namespace plekton::dynamics
