// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/time_step.hpp"

#include <cstddef>
#include <vector>

namespace plekton::dynamics {

/// The springs of contacts as they couple their nodes; NodalStiffness, with functions of the same
/// names, only has their sums around each node.
class ContactSprings {
 public:
  /// A contact between two balls.
  void add_pair(NodeId a, NodeId b, const ContactStiffness& contact);
  /// A contact between a ball and a surface, whose nodes share in it by the weights of the core
  /// point.
  /// @param turning  is left out: who has the forces themselves has it too
  void add_on_surface(NodeId ball, const geometry::CorePoint& core, const ContactStiffness& contact,
                      const SurfaceTurning& turning = {});
  /// A contact between a ball and a wall, which does not yield. arm_b has no meaning here.
  void add_to_wall(NodeId ball, const ContactStiffness& contact);
  /// Springs that hold a single node.
  void add(NodeId node, const IsotropicStiffness& springs);

  /// Number of contacts between balls, surfaces and walls.
  std::size_t size() const noexcept { return contacts_.size(); }
  bool empty() const noexcept { return contacts_.empty() && single_.empty(); }

  /// Takes from the forces (N, N m) what the springs do against small motions.
  /// @param shift  m, by NodeId
  /// @param turn   rad, by NodeId
  void resist(const std::vector<Vec3>& shift, const std::vector<Vec3>& turn,
              NodeForces& forces) const;

 private:
  /// How a node takes part: the contact point on b moves by weight (shift + turn x arm n), that on
  /// a by as much with a weight below 0.
  struct End {
    NodeId node;
    double weight;
    double arm;  ///< m, along the normal
  };
  struct Spring {
    ContactStiffness contact;
    std::size_t first_end;
    std::size_t end_count;
  };
  struct Single {
    NodeId node;
    IsotropicStiffness springs;
  };

  void begin(const ContactStiffness& contact) { contacts_.push_back({contact, ends_.size(), 0}); }
  void add_end(const End& end);

  std::vector<Spring> contacts_;
  std::vector<End> ends_;
  std::vector<Single> single_;
};

}  // namespace plekton::dynamics
