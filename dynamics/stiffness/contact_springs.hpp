// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/stiffness/nodal_stiffness.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::dynamics {

/// The springs of contacts as they couple their nodes; NodalStiffness, with functions of the same
/// names, only has their sums around each node.
class ContactSprings {
 public:
  /// Between nodes of which none follows a rigid body.
  ContactSprings() = default;
  /// @param rigid  rigid bodies among the nodes; must outlive this
  explicit ContactSprings(const RigidNodes* rigid) : rigid_(rigid) {}

  /// Forgets all of them; keeps the space.
  void clear() noexcept;

  /// A contact between two balls.
  void add_pair(NodeId a, NodeId b, const ContactStiffness& contact);
  /// A contact between a ball and a surface, whose nodes share in it by the weights of the core
  /// point.
  /// @param turning  as a spring of its own; it is for bounds, and no part of resist()
  void add_on_surface(NodeId ball, const geometry::CorePoint& core, const ContactStiffness& contact,
                      const SurfaceTurning& turning = {});
  /// A contact between a ball and a wall, which does not yield. arm_b has no meaning here.
  void add_to_wall(NodeId ball, const ContactStiffness& contact);
  /// Springs that hold a single node.
  void add(NodeId node, const IsotropicStiffness& springs);

  /// Number of contacts between balls, surfaces and walls.
  std::size_t size() const noexcept { return contacts_; }

  /// Leaves out the springs against turning of the balls for which a function says so: what they
  /// resist is known in another way.
  template <class Chosen>
  void leave_out_turning(const Chosen& is_chosen) {
    for (Spring& spring : springs_) {
      if (spring.kind == Kind::turning && is_chosen(ends_[spring.first_end].node))
        spring.contact.normal_stiffness = spring.contact.tangential_stiffness = 0.0;
    }
  }
  /// Calls visit(contact, its ends) for those on surfaces.
  template <class Visit>
  void for_each_on_surface(Visit&& visit) const {
    for (const Spring& spring : springs_) {
      if (spring.kind == Kind::on_surface)
        visit(spring.contact, ends().subspan(spring.first_end, spring.end_count));
    }
  }
  /// Calls visit(contact, its end) for those on walls.
  template <class Visit>
  void for_each_on_wall(Visit&& visit) const {
    for (const Spring& spring : springs_) {
      if (spring.kind == Kind::on_wall) visit(spring.contact, ends_[spring.first_end]);
    }
  }

  /// Ends of all springs but the single ones, spring by spring.
  std::span<const SpringEnd> ends() const noexcept { return ends_; }
  /// Calls visit(contact, its ends, place of the first of these in ends()).
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const Spring& spring : springs_)
      visit(spring.contact, ends().subspan(spring.first_end, spring.end_count), spring.first_end);
  }
  /// Calls visit(node, springs).
  template <class Visit>
  void for_each_single(Visit&& visit) const {
    for (const Single& single : single_) visit(single.node, single.springs);
  }

  /// Step (s) that follows the collisions of balls with surfaces; infinite if there is nothing in
  /// them.
  ///
  /// As it begins and ends within a step a contact loses and gains between 0 and (omega dt)² / 4 of
  /// the energy of what collides, omega² = k sum w² / m, a sixth of the squared product on average
  /// (with a first overlap of u v dt it is k (v dt)² u (1 - u) / 2). With the energy of each,
  /// E = 1/2 k overlap² + 1/2 v² / sum (w² / m), v the speed along the normal, this is the step at
  /// which the mean of (omega dt)² by energy is 1/4: at most 1/16 of the energy of all collisions
  /// with surfaces.
  double collision_step(const NodeState& state, const NodeProperties& properties) const;

  /// Step (s) that follows balls whose centre is about to go through another one's or through the
  /// core of a surface; infinite if none is.
  ///
  /// There the elastic force F turns over within a step. From d1 before the core to d2 behind it the
  /// leapfrog works with the mean of both ends, and is off by F |d1 - d2|, at most by F v dt. With
  /// E as above this is the step at which that is 1/16 of the energy of all of them.
  double crossing_step(const NodeState& state, const NodeProperties& properties) const;

  /// Step (s) that follows springs which are about to begin or to end, again and again, as wires that
  /// become taut and slack; infinite if none is.
  ///
  /// Where more is stored than the motion has, nothing begins or ends (as in WallCollisions). With
  /// e_i what it has more, what all lose and gain at once is at most 1/16 of the energy E in all
  /// springs, those that go on included, where dt² sum(omega_i² e_i) = E / 4. One time after the
  /// other, k (v dt)² u (1 - u) / 2 with u at random in [0, 1], whose deviation is 1 / sqrt(180) of
  /// (omega dt)² e, adds up like the steps of a random walk: in 180 times to a deviation of E / 64, of
  /// which four are 1/16, where dt² sqrt(sum(omega_i⁴ e_i²)) = E / 64. The shorter of both steps:
  /// omega dt = 1/8 for one spring, and 1/2 for 256 alike or more.
  double ending_step(const NodeState& state, const NodeProperties& properties) const;

  /// Takes from the forces (N, N m) what the springs do against small motions.
  /// @param shift  m, by NodeId
  /// @param turn   rad, by NodeId
  void resist(const std::vector<Vec3>& shift, const std::vector<Vec3>& turn,
              NodeForces& forces) const;

 private:
  /// How what a spring is between moves along its normal.
  struct Approach {
    double mobility = 0.0;  ///< 1/kg, sum of w² / m; 0: all of it is held
    double speed = 0.0;     ///< m/s, at which it parts
    double stored = 0.0;    ///< J; 0 where all is held
    double moving = 0.0;    ///< J, of that motion; likewise

    double energy() const noexcept { return stored + moving; }
  };
  enum class Kind : std::uint8_t { of_balls, on_surface, on_wall, turning };
  struct Spring {
    ContactStiffness contact;
    std::size_t first_end;
    std::size_t end_count;
    Kind kind;
  };
  struct Single {
    NodeId node;
    IsotropicStiffness springs;
  };

  void add_spring(const ContactStiffness& contact, std::span<const SpringEnd> ends, Kind kind);
  Approach approach_of(const Spring& spring, const NodeState& state,
                       const NodeProperties& properties) const;

  void resist_single(const Single& single, const std::vector<Vec3>& shift,
                     const std::vector<Vec3>& turn, NodeForces& forces) const;

  const RigidNodes* rigid_ = nullptr;
  std::size_t contacts_ = 0;
  std::vector<Spring> springs_;
  std::vector<SpringEnd> ends_;
  std::vector<Single> single_;
};

}  // namespace plekton::dynamics
