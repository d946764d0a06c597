// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/scene_contacts.hpp"
#include "contact/law/linear_frictional.hpp"

#include <array>
#include <span>
#include <vector>

namespace plekton::test {

using contact::LinearFrictional;
using contact::Material;
using contact::MaterialId;
using contact::NodeForces;
using geometry::id_at;
using geometry::index_of;
using geometry::NodeId;
using geometry::Vec3;

/// A surface to be touched: nodes, and the cells between them.
struct ProbedSurface {
  std::vector<Vec3> nodes;  ///< m
  std::vector<std::array<int, 3>> facets;
  std::vector<std::array<int, 2>> cylinders;
  double radius = 0.0;  ///< m, of every cell
};

/// What the ball and the surface feel in one step.
struct Felt {
  Vec3 force;              ///< N, on the ball
  Vec3 torque;             ///< N m, on the ball
  std::size_t contacts;    ///< of the ball with the surface
  double force_residual;   ///< N, of all forces on ball and nodes
  double moment_residual;  ///< N m, of all forces and torques, about the origin
};

/// One ball that is moved by hand over a surface that is moved by hand; both of one material. It
/// asks the same facade as the simulation does: neighbours, patches, histories, law, forces.
///
/// A step lasts 1 s, so that a velocity is a displacement in a step. The velocities are those that
/// led to the positions, as the leapfrog has it. The contact kinematics are exact: the slip is the
/// relative velocity of the two material points at the contact point, without the factor
/// a = (R + r) / (R + r - overlap) by which "anti-ratcheting" codes raise the translational part.
class ContactProbe {
 public:
  ContactProbe(const ProbedSurface& surface, double ball_radius, const Material& material)
      : spheres_{{{id_at<NodeId>(surface.nodes.size())}, ball_radius}},
        surface_(elements(surface).cylinders, elements(surface).facets, surface.nodes.size() + 1),
        position_(surface.nodes),
        velocity_(surface.nodes.size() + 1, Vec3::Zero()),
        spin_(surface.nodes.size() + 1, Vec3::Zero()),
        parameters_(LinearFrictional::combine({material, ball_radius}, {material, surface.radius})),
        contacts_(spheres_, surface_,
                  {contact::MaterialPairs({material}),
                   {MaterialId{0}},
                   std::vector<MaterialId>(surface_.structure_count(), MaterialId{0})},
                  0.2 * ball_radius),
        forces_(surface.nodes.size() + 1) {
    position_.push_back(Vec3::Constant(1e3));  // far from everything
  }
  ContactProbe(const ContactProbe&) = delete;
  ContactProbe& operator=(const ContactProbe&) = delete;

  const LinearFrictional::Parameters& parameters() const { return parameters_; }
  const NodeForces& forces() const { return forces_; }
  const contact::SceneContacts& contacts() const { return contacts_; }
  const std::vector<Vec3>& positions() const { return position_; }

  /// Puts the nodes elsewhere; the ball is the last.
  void set_positions(const std::vector<Vec3>& positions) { position_ = positions; }

  /// Velocities (m/s) and angular velocities (rad/s), by node; the ball is the last.
  std::vector<Vec3>& velocity() { return velocity_; }
  std::vector<Vec3>& spin() { return spin_; }

  /// Takes the ball to a place; nothing has a velocity.
  Felt put(const Vec3& centre) {
    for (Vec3& velocity : velocity_) velocity = Vec3::Zero();
    for (Vec3& spin : spin_) spin = Vec3::Zero();
    position_.back() = centre;
    return feel();
  }

  /// Drags the ball in one step, without turning it; the surface stays.
  Felt drag(const Vec3& centre) {
    velocity_.back() = centre - position_.back();
    position_.back() = centre;
    return feel();
  }

  /// One step with the positions and velocities as they are.
  Felt feel() {
    contacts_.advance({position_, velocity_, spin_}, {}, 1.0, pool_, forces_);
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    for (std::size_t i = 0; i < position_.size(); ++i) {
      force += forces_.force[i];
      moment += position_[i].cross(forces_.force[i]) + forces_.torque[i];
    }
    return {forces_.force.back(), forces_.torque.back(), contacts_.counts().sphere_surface,
            force.norm(), moment.norm()};
  }

 private:
  static geometry::Elements elements(const ProbedSurface& surface) {
    geometry::Elements made;
    for (const auto& [a, b, c] : surface.facets) {
      made.facets.push_back({{NodeId{a}, NodeId{b}, NodeId{c}}, surface.radius});
    }
    for (const auto& [a, b] : surface.cylinders) {
      made.cylinders.push_back({{NodeId{a}, NodeId{b}}, surface.radius});
    }
    return made;
  }

  std::vector<geometry::Sphere> spheres_;
  geometry::Surface surface_;
  std::vector<Vec3> position_;
  std::vector<Vec3> velocity_;
  std::vector<Vec3> spin_;
  LinearFrictional::Parameters parameters_;
  contact::SceneContacts contacts_;
  NodeForces forces_;
  geometry::ThreadPool pool_;
};

/// Puts the ball on the first point of a path and drags it over the others.
inline std::vector<Felt> sweep(ContactProbe& probe, std::span<const Vec3> path) {
  std::vector<Felt> felt{probe.put(path.front())};
  for (const Vec3& centre : path.subspan(1)) felt.push_back(probe.drag(centre));
  return felt;
}

/// Largest change of the force (N) in a step.
inline double largest_jump(std::span<const Felt> felt) {
  double largest = 0.0;
  for (std::size_t k = 1; k < felt.size(); ++k) {
    largest = std::max(largest, (felt[k].force - felt[k - 1].force).norm());
  }
  return largest;
}

/// Gives every node the velocities of a rigid rotation (rad/s) about the origin.
inline void turn_rigidly(ContactProbe& probe, const Vec3& spin) {
  for (std::size_t i = 0; i < probe.positions().size(); ++i) {
    probe.velocity()[i] = spin.cross(probe.positions()[i]);
    probe.spin()[i] = spin;
  }
}

/// Slip velocity (m/s) at the contact: the tangential force is k_s times it after a step of 1 s.
inline double slip_velocity(ContactProbe& probe, const Vec3& normal) {
  const Vec3 force = probe.feel().force;
  return (force - force.dot(normal) * normal).norm() / probe.parameters().tangential_stiffness;
}

}  // namespace plekton::test
