// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contacts.hpp"
#include "contact/surface_surface/structure_probe.hpp"
#include "dynamics/stiffness/contact_springs.hpp"
#include "dynamics/time_step/stiffest_motion.hpp"

#include <cstdint>
#include <vector>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::dynamics {

/// What contacts of structures with each other resist beside the springs of their patches.
///
/// A patch counts for as many springs as its forces add up to, shared out over its nodes. It does
/// not know what forces resist that cancel, as those of a sleeve on a tube do, nor tilts that move
/// the nearest points of what lies flat, nor wraps. So the forces themselves are asked, as a
/// function of the places: with lambda the largest magnitude of an eigenvalue of
/// M^(-1/2) H M^(-1/2), H their derivative, H is below lambda M. Structures that do not touch have
/// one each. A node gets what lambda times its mass is above its springs.
///
/// Differences go 1e-6 of the smallest radius: the stiffness of bars that lie along each other is
/// there on ways of that size, and that of fine sheets at an angle (with 1e-5 it was up to 1.8 times
/// too small). Where forces jump it looks large, and the step gets shorter.
class StructureStiffness {
 public:
  /// @param rigid  rigid bodies among the nodes; must outlive this
  explicit StructureStiffness(const RigidNodes& rigid) : rigid_(&rigid), motion_(rigid) {}

  /// @param places  those of the last step's contacts, or so much away from them
  /// @param moved   m, how far nodes are at most from where they were in the last step
  void find(const contact::Contacts& contacts, const NodeProperties& properties,
            const StiffestMotion::Places& places, double moved);
  /// What the last look found.
  void add_to(ContactSprings& springs) const;

  /// The motion of the last look.
  void exchange(const geometry::StateArchive& archive) { motion_.exchange(archive); }

 private:
  void find_parts(const NodeProperties& properties);
  std::uint32_t root_of(std::uint32_t node) noexcept;
  void find_springs(const contact::Contacts& contacts);

  const RigidNodes* rigid_;
  contact::StructureProbe probe_;
  StiffestMotion motion_;
  std::vector<std::uint32_t> linked_;  ///< by node: one of its part, the lowest of it itself
  std::vector<double> springs_;        ///< N/m, by node that moves: of its patches
  struct Rest {
    NodeId node;
    double stiffness;  ///< N/m
  };
  std::vector<Rest> rests_;  ///< beside those springs
};

}  // namespace plekton::dynamics
