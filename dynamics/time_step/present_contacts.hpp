// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contacts.hpp"
#include "dynamics/stiffness/contact_springs.hpp"
#include "dynamics/stiffness/nodal_stiffness.hpp"
#include "geometry/primitives/elements.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace plekton::dynamics {

/// Contacts as springs on nodes: those that act, and those that bodies may come to have once they
/// are nearer.
///
/// Springs may be ContactSprings, NodalStiffness, StiffestPart: what has add_pair(),
/// add_on_surface(), add_to_wall() and add() of a node.
struct PresentContacts {
  const contact::Contacts& contacts;
  std::span<const contact::Plane> planes;
  std::span<const double> radii;  ///< m, of the ball around each node
  double dashpot_rate = 0.0;      ///< 1/s, see dynamics::dashpot_rate()

  /// Every touching pair, as it is now.
  /// @param further  m, by how much contacts may get deeper
  /// @param x        m, where the nodes were when the forces were found
  template <class Springs>
  void add_to(Springs& springs, double further, geometry::Positions x) const {
    contacts.for_each_sphere_pair(
        [&](NodeId a, NodeId b, const contact::PairSprings& pair, double gap) {
          add_spheres(springs, {a, b, gap}, pair, further, x);
        });
    add_on_surfaces_to(springs, further, x);
    contacts.for_each_plane_pair(
        [&](NodeId ball, std::size_t plane, const contact::PairSprings& pair, double gap) {
          add_to_plane(springs, {ball, plane, gap}, pair, further, x);
        });
  }

  /// What touches, and what may touch once bodies are nearer by a margin (m); of structures, only
  /// what touches.
  template <class Springs>
  void add_near_to(Springs& springs, double margin, geometry::Positions x) const {
    contacts.for_each_near_sphere_pair(
        margin, x, [&](NodeId a, NodeId b, const contact::PairSprings& pair, double gap) {
          add_spheres(springs, {a, b, gap}, pair, margin, x);
        });
    add_on_surfaces_to(springs, margin, x);
    contacts.for_each_coming_surface_term(
        margin, x,
        [&](NodeId ball, const geometry::CorePoint& core, const contact::PairSprings& pair,
            double range, const contact::TermPart&) {
          add_on_surface(springs, {ball, core, range, {}}, pair, margin, x);
        });
    contacts.for_each_near_plane_pair(
        margin, planes, x,
        [&](NodeId ball, std::size_t plane, const contact::PairSprings& pair, double gap) {
          add_to_plane(springs, {ball, plane, gap}, pair, margin, x);
        });
  }

 private:
  /// A contact of two balls.
  struct OfSpheres {
    NodeId a;
    NodeId b;
    double gap;  ///< m
  };

  /// A contact of a ball with a plane.
  struct OnPlane {
    NodeId ball;
    std::size_t plane;
    double gap;  ///< m
  };

  /// A part of a contact of a ball with a surface.
  struct OnSurface {
    NodeId ball;
    const geometry::CorePoint& core;
    double range;          ///< m, radius of the ball and of the surface
    contact::TermPart of;  ///< of rings its force may be more than one contact has
  };

  ContactStiffness stiffness_of(const Vec3& normal, const contact::PairSprings& pair, double gap,
                                NodeId a, NodeId b) const {
    const contact::PairStiffness stiffness = pair.stiffness(gap);
    const double dashpot = dashpot_rate * stiffness.normal_damping;
    return {.normal = normal,
            .normal_stiffness = stiffness.normal + dashpot,
            .tangential_stiffness = stiffness.tangential,
            .arm_a = radii[index_of(a)],
            .arm_b = radii[index_of(b)],
            .dashpot = dashpot};
  }

  /// N, of cores that meet if they come nearer by so much (m); 0 of others.
  static double core_force(const contact::PairSprings& pair, double gap, double distance,
                           double further) {
    return distance < further ? pair.normal_force(gap - distance) : 0.0;
  }

  template <class Springs>
  void add_spheres(Springs& springs, const OfSpheres& of, const contact::PairSprings& pair,
                   double further, geometry::Positions x) const {
    const Vec3 apart = x[index_of(of.b)] - x[index_of(of.a)];
    ContactStiffness contact = stiffness_of(apart.normalized(), pair, of.gap - further, of.a, of.b);
    contact.overlap = std::max(0.0, -of.gap);
    contact.core_force = core_force(pair, of.gap, apart.norm(), further);
    springs.add_pair(of.a, of.b, contact);
  }

  template <class Springs>
  void add_to_plane(Springs& springs, const OnPlane& of, const contact::PairSprings& pair,
                    double further, geometry::Positions x) const {
    const contact::Plane& plane = planes[of.plane];
    const Vec3& place = x[index_of(of.ball)];
    const Vec3 normal = plane.normal_at(place);
    ContactStiffness contact = stiffness_of(normal, pair, of.gap - further, of.ball, of.ball);
    contact.overlap = std::max(0.0, -of.gap);
    contact.wall_speed = normal.dot(plane.velocity_at(place));
    springs.add_to_wall(of.ball, contact);
    const double turning = plane.turning_stiffness(place, pair.normal_force(of.gap - further));
    if (turning > 0.0) springs.add(of.ball, {turning, 0.0});
  }

  /// Those with surfaces and between structures.
  template <class Springs>
  void add_on_surfaces_to(Springs& springs, double further, geometry::Positions x) const {
    contacts.for_each_surface_term([&](NodeId ball, const geometry::CorePoint& core,
                                       const contact::PairSprings& pair, double range,
                                       const contact::TermPart& term) {
      add_on_surface(springs, {ball, core, range, term}, pair, further, x);
    });
    // A contact that splits before the next look has a dashpot in each part.
    const double dashpots = further > 0.0 ? 2.0 * dashpot_rate : dashpot_rate;
    contacts.for_each_structure_stiffness(
        [&](NodeId node, const contact::PairStiffness& stiffness, double radius) {
          const double normal = stiffness.normal + dashpots * stiffness.normal_damping;
          springs.add(node, from_all_sides(2.0 * normal, 2.0 * stiffness.tangential, radius));
        });
  }

  /// @param x  m, where the nodes were when the force was found: a contact that is about to end has
  ///           little of it left a drift later, and would look like many
  template <class Springs>
  void add_on_surface(Springs& springs, const OnSurface& part, const contact::PairSprings& pair,
                      double further, geometry::Positions x) const {
    const Vec3 to_core = geometry::position(part.core, x) - x[index_of(part.ball)];
    const double distance = to_core.norm();
    const Vec3 normal = distance > 0.0 ? Vec3(to_core / distance) : Vec3(Vec3::UnitZ());
    const double gap = distance - part.range;
    ContactStiffness contact =
        stiffness_of(normal, pair, gap - further, part.ball, part.core.nodes[0]);
    const double of_one = pair.normal_force(gap);
    const double weight = of_one > 0.0 ? part.of.elastic / of_one : 1.0;
    contact.weight = weight;
    const double elastic = contact.elastic_stiffness();
    contact.dashpot *= part.of.dashpot;
    contact.normal_stiffness = std::max(1.0, std::abs(weight)) * elastic + contact.dashpot;
    contact.overlap = std::max(0.0, -gap);
    contact.core_force = std::max(0.0, weight) * core_force(pair, gap, distance, further);
    const double deeper = weight * pair.normal_force(gap - further);
    springs.add_on_surface(part.ball, part.core, contact,
                           surface_turning(part.core, deeper, distance, x));
  }
};

}  // namespace plekton::dynamics
