// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/any_law.hpp"
#include "contact/surface_surface/pair_term.hpp"
#include "contact/surface_surface/sides.hpp"
#include "contact/surface_surface/structure_patch.hpp"
#include "contact/tracking/contact_memory.hpp"
#include "contact/tracking/interpolation.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>

namespace plekton::contact::structure {

/// What two cells that lie on each other have of everything but the elastic normal force: friction
/// is a field, with a spring and a limit of its own for every pair of facets that lie flat on each
/// other, and for every pair with a bar in it, at the point on which its part of the pressure acts.
/// So a sheet that is turned on another one resists, a strip that is pulled slips from the pulled
/// end on, and the pull in a belt grows around its drum.
///
/// A pair comes into being and ends with an overlap or a share that goes to 0, and so do the force
/// it is pressed with, the limit of its friction and what its spring can hold. A spring that comes
/// to count for more contacts keeps its force, one that counts for less keeps its stretch: neither
/// gains energy. Of bars, what a spring counts for less is handed to those beside it that come to
/// count for more (spread_contacts.hpp).
struct SpreadContact {
  /// One facet: its corners, and their shares of the elastic force.
  struct Side {
    std::array<NodeId, 3> nodes{};
    std::array<double, 3> shares{};
    Vec3 point = Vec3::Zero();  ///< m, on which the force acts

    void find_shares(const std::array<Vec3, 3>& forces, const Vec3& per_force, Positions x) {
      double sum = 0.0;
      // Of an overlap that is a sliver the corners may be pushed either way; its place is on the
      // facet.
      for (std::size_t i = 0; i < 3; ++i)
        sum += shares[i] = std::max(0.0, per_force.dot(forces[i]));
      const Vec3& origin = x[index_of(nodes[0])];
      point = origin;
      for (std::size_t i = 0; i < 3; ++i) {
        shares[i] /= sum;
        point += shares[i] * (x[index_of(nodes[i])] - origin);
      }
    }
    Vec3 velocity_at(const Vec3& lever, const Motion& motion) const {
      Vec3 velocity = Vec3::Zero();
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t node = index_of(nodes[i]);
        velocity +=
            shares[i] * (motion.velocity[node] + motion.angular_velocity[node].cross(lever));
      }
      return velocity;
    }
    Vec3 angular_velocity(const Motion& motion) const {
      Vec3 spin = Vec3::Zero();
      for (std::size_t i = 0; i < 3; ++i)
        spin += shares[i] * motion.angular_velocity[index_of(nodes[i])];
      return spin;
    }
    void exchange(geometry::RowFields& row, const std::string& name,
                  const geometry::Surface& surface) {
      row(name + "_nodes", nodes);
      row.require(has_nodes(surface, nodes), name + "_nodes");
      row(name + "_shares", shares);
      row(name + "_point", point);
    }
    /// Transpose of both.
    void add_force_at(const Vec3& lever, const Vec3& force, const Vec3& free_moment,
                      NodeForces& forces) const {
      const Vec3 torque = lever.cross(force) + free_moment;
      for (std::size_t i = 0; i < 3; ++i) {
        forces.force[index_of(nodes[i])] += shares[i] * force;
        forces.torque[index_of(nodes[i])] += shares[i] * torque;
      }
    }
  };

  std::uint32_t pair = 0;    ///< of cells
  std::uint32_t patch = 0;   ///< of which it is a part
  Sides sides;               ///< how a and b go with those of the patch
  bool is_of_bar = false;    ///< one of its cells at least is a cylinder
  bool is_wrapped = false;   ///< in a patch that wraps around something
  bool is_followed = false;  ///< has left what it was to others
  std::uint32_t structure_pair = 0;
  Side a;
  Side b;
  Vec3 elastic_force = Vec3::Zero();  ///< N, on b
  double normal_force = 0.0;          ///< N, its magnitude
  double gap = 0.0;                   ///< m, mean over the forces
  double count = 0.0;                 ///< of contacts
  ContactMemory<AnyLaw> memory;
  double energy = 0.0;              ///< J, of the history
  double dissipated = 0.0;          ///< J, in the last step
  Vec3 other_force = Vec3::Zero();  ///< N, on b: all but the elastic force
  Vec3 moment = Vec3::Zero();       ///< N m, on b

  /// Sets where and how hard a term of two facets presses by its extent, as far as its nearest
  /// points do not count.
  /// @returns whether it does
  bool locate(const PairTerm& term, const PairForces& extent, const StructurePair& bodies,
              Positions x) {
    elastic_force = extent.on_b[0] + extent.on_b[1] + extent.on_b[2];
    normal_force = elastic_force.norm();
    // Of facets that cross in the middle the forces on both sides cancel but for rounding.
    constexpr double kRounding = 1e-14;
    const double size = extent.on_b[0].norm() + extent.on_b[1].norm() + extent.on_b[2].norm();
    if (!(normal_force > kRounding * size) || !(extent.energy > 0.0)) return false;
    const double pushing =
        pushing_part(bodies.parameters, extent.energy, normal_force, term.overlap);
    const double range = bodies.radius_first + bodies.radius_second;
    gap = -std::min(range, mean_overlap(bodies.parameters, extent.energy, pushing * normal_force));
    const double part = (1.0 - term.point_share) * pushing;
    if (!(part > 0.0)) return false;
    elastic_force *= part;
    normal_force *= part;
    const double one = AnyLaw::elastic_normal_force(bodies.parameters, gap);
    if (!(one > 0.0)) return false;
    count = normal_force / one;
    a.nodes = term.a.ids;
    b.nodes = term.b.ids;
    const Vec3 per_force = elastic_force / (normal_force * normal_force);
    a.find_shares(extent.on_a, -per_force, x);
    b.find_shares(extent.on_b, per_force, x);
    return true;
  }

  /// How a pair of cells with a bar in it presses.
  struct Pressed {
    double force;         ///< N
    double mean_overlap;  ///< m
    Vec3 towards;         ///< from a to b: direction of the patch, as far as it is the pair's too
    double own;           ///< as far as its own direction is, from 0 to 1
    double whole;         ///< how much it has a whole spring, from 0 to 1
  };
  /// Sets where a term with a bar in it presses.
  /// @returns whether it does
  bool locate_bar(const PairTerm& term, const Pressed& pressed, const StructurePair& bodies,
                  Positions x) {
    const Vec3 force = term.forces.on_b[0] + term.forces.on_b[1] + term.forces.on_b[2];
    const double size = force.norm();
    const double one = AnyLaw::elastic_normal_force(bodies.parameters, -pressed.mean_overlap);
    if (!(size > 0.0) || !(one > 0.0)) return false;
    const Vec3 direction = pressed.towards + pressed.own / size * force;
    if (!(direction.norm() > 0.0)) return false;
    is_of_bar = true;
    gap = -pressed.mean_overlap;
    normal_force = pressed.force;
    elastic_force = normal_force * direction.normalized();
    // All add up to the contacts that their patch counts. But bars of a wrap have a whole spring
    // each, whatever the share of their push: of long ones and short ones the belt around a drum
    // would chatter.
    count = (1.0 - pressed.whole) * normal_force / one + pressed.whole;
    a.nodes = term.a.ids;
    b.nodes = term.b.ids;
    const Vec3 per_force = force / (size * size);
    a.find_shares(term.forces.on_a, -per_force, x);
    b.find_shares(term.forces.on_b, per_force, x);
    return true;
  }

  /// Whether its cells hang together with those of another.
  bool is_beside(const SpreadContact& other) const {
    const auto meet = [](const Side& p, const Side& q) {
      return std::any_of(p.nodes.begin(), p.nodes.end(), [&](NodeId node) {
        return std::find(q.nodes.begin(), q.nodes.end(), node) != q.nodes.end();
      });
    };
    return (meet(a, other.a) && meet(b, other.b)) || (meet(a, other.b) && meet(b, other.a));
  }

  Vec3 normal() const { return elastic_force / normal_force; }
  /// @param free_part  of the tangential force, that no bonds carry
  AnyLaw::Parameters parameters(const StructurePair& bodies, double free_part) const {
    return AnyLaw::unbonded_part(AnyLaw::scaled(bodies.parameters, count), free_part);
  }

  /// Adds the history of a spread contact of the last step.
  /// @param contacts  that it counts for, of both
  void take_over(const SpreadContact& old, double contacts, const Motion& motion, double dt) {
    if (!(contacts > 0.0)) return;
    // Pairs within one structure may have their cells the other way round.
    const double sign = old.memory.normal.dot(normal()) < 0.0 && old.pair != pair ? -1.0 : 1.0;
    const Vec3 onto = sign * normal();
    const Vec3 spin = 0.5 * (a.angular_velocity(motion) + b.angular_velocity(motion));
    auto carried = carried_history<AnyLaw>(old.memory, onto, dt * spin.dot(onto));
    AnyLaw::scale_history(carried, count / old.count);
    AnyLaw::accumulate_history(memory.history, carried, sign * contacts / count);
  }

  /// One step of the law.
  /// @param contacts  between its structures, in all patches
  void apply_law(const StructurePair& bodies, double contacts, double free_part,
                 const Motion& motion, double dt) {
    const auto of_all =
        AnyLaw::unbonded_part(AnyLaw::scaled(bodies.of_part(count / contacts), count), free_part);
    memory.normal = normal();
    const RelativeMotion relative =
        relative_motion(memory.normal, gap, normal_force, velocity(bodies, motion), spin(motion));
    const ContactForce result = AnyLaw::force(of_all, relative, memory.history, dt);
    other_force = result.force - elastic_force;
    moment = result.moment;
    dissipated = result.dissipated;
    find_energy(bodies, free_part);
  }
  /// J, lost with a contact that nothing follows: see contact::loss_at_end().
  double loss_at_end(const StructurePair& bodies, const Motion& motion, double dt) const {
    return energy -
           0.5 * dt * (other_force.dot(velocity(bodies, motion)) + moment.dot(spin(motion)));
  }
  void find_energy(const StructurePair& bodies, double free_part) {
    energy = AnyLaw::history_energy(parameters(bodies, free_part), memory.history);
  }

  /// All but its pair of cells. @throws geometry::StateMismatch
  void exchange(geometry::RowFields& row, const StructurePairs& pairs,
                const geometry::Surface& surface) {
    const AnyLaw::Functions* const law = pairs.exchange(row, structure_pair);
    row("patch", patch);
    sides.exchange(row, "are_crossed");
    row("is_of_bar", is_of_bar);
    row("is_wrapped", is_wrapped);
    a.exchange(row, "a", surface);
    b.exchange(row, "b", surface);
    row("elastic_force", elastic_force);
    row("normal_force", normal_force);
    row("gap", gap);
    row("contacts", count);
    contact::exchange(row, memory, law);
    row("energy", energy);
    row("other_force", other_force);
    row("moment", moment);
  }

  void add_forces(const StructurePair& bodies, NodeForces& forces) const {
    a.add_force_at(lever_a(bodies), -other_force, -moment, forces);
    b.add_force_at(lever_b(bodies), other_force, moment, forces);
  }

  /// m. The contact point lies between the two points on which the elastic force acts.
  Vec3 lever_a(const StructurePair& bodies) const {
    return bodies.radius_first / (bodies.radius_first + bodies.radius_second) * (b.point - a.point);
  }
  Vec3 lever_b(const StructurePair& bodies) const {
    return bodies.radius_second / (bodies.radius_first + bodies.radius_second) *
           (a.point - b.point);
  }

 private:
  /// m/s and rad/s, of b relative to a at the contact point.
  Vec3 velocity(const StructurePair& bodies, const Motion& motion) const {
    return b.velocity_at(lever_b(bodies), motion) - a.velocity_at(lever_a(bodies), motion);
  }
  Vec3 spin(const Motion& motion) const {
    return b.angular_velocity(motion) - a.angular_velocity(motion);
  }
};

}  // namespace plekton::contact::structure
