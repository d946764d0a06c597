// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/any_law.hpp"
#include "contact/surface_surface/pressed_points.hpp"
#include "contact/surface_surface/sides.hpp"
#include "contact/surface_surface/structure_patch.hpp"
#include "contact/tracking/contact_memory.hpp"
#include "contact/tracking/interpolation.hpp"
#include "geometry/primitives/surface_change.hpp"

#include <cstdint>
#include <optional>
#include <span>

namespace plekton::contact::structure {

/// A bond between two structures: a spring between two material points, one on a cell of each, that
/// counts for some of the contacts of the patch in which it was formed.
///
/// While the points are nearer than both radii the contact pushes, and the bond carries only the
/// tangential force and what has yielded. Further apart the bond pulls along the line through both
/// points. Its force acts at one point for both sides, so both momenta are kept to round-off; as
/// the points do not slide, it does not jump where the contact passes from cell to cell.
struct StructureBond {
  geometry::CellPair cells{};  ///< that it belongs to
  Sides sides;                 ///< how its points go with them
  std::uint32_t structure_pair = 0;
  geometry::CorePoint a{};  ///< on the lower structure
  geometry::CorePoint b{};
  double count = 0.0;  ///< of contacts
  ContactMemory<AnyLaw> memory;
  std::int32_t pair = -1;          ///< of the listed cells, -1: not listed
  std::int32_t patch = -1;         ///< which it is part of; -1: none touches
  std::int64_t id = 0;             ///< 0: none yet
  bool is_broken = false;          ///< in the last step
  Vec3 separation = Vec3::Zero();  ///< m, from point a to point b
  Vec3 normal = Vec3::Zero();
  double gap = 0.0;                 ///< m
  double pressing = 0.0;            ///< N, its part of the contact's elastic force
  double dissipated = 0.0;          ///< J, in the last step
  Vec3 other_force = Vec3::Zero();  ///< N, on b: all but that part
  Vec3 moment = Vec3::Zero();       ///< N m, on b

  AnyLaw::Parameters parameters(const StructurePair& bodies) const {
    return AnyLaw::of_bond(AnyLaw::scaled(bodies.parameters, count));
  }
  double history_energy(const StructurePair& bodies) const {
    return AnyLaw::history_energy(parameters(bodies), memory.history);
  }

  /// Finds the gap, and the part of the elastic force that is pressing here.
  void locate(const StructurePair& bodies, Positions x) {
    separation = position(b, x) - position(a, x);
    const double distance = separation.norm();
    normal = distance > 0.0 ? Vec3(separation / distance) : memory.normal;
    gap = distance - (bodies.radius_first + bodies.radius_second);
    pressing = AnyLaw::elastic_normal_force(parameters(bodies), gap);
  }

  /// One step of the law, after locate().
  void apply_law(const StructurePair& bodies, const Motion& motion, double dt) {
    const Vec3 spin_a = angular_velocity_at(a, motion);
    const Vec3 spin_b = angular_velocity_at(b, motion);
    const Vec3 velocity =
        velocity_at(b, lever_b(bodies), motion) - velocity_at(a, lever_a(bodies), motion);
    const auto of_bond = parameters(bodies);
    const double before = history_energy(bodies);
    memory.history =
        carried_history<AnyLaw>(memory, normal, 0.5 * dt * (spin_a + spin_b).dot(normal));
    memory.normal = normal;
    const double lost = before - history_energy(bodies);
    const ContactForce result =
        AnyLaw::force(of_bond, relative_motion(normal, gap, pressing, velocity, spin_b - spin_a),
                      memory.history, dt);
    other_force = result.force - pressing * normal;
    moment = result.moment;
    dissipated = lost + result.dissipated;
    is_broken = !AnyLaw::holds(memory.history);
  }

  void add_forces(const StructurePair& bodies, NodeForces& forces) const {
    add_force_at(a, lever_a(bodies), -other_force, forces);
    add_force_at(b, lever_b(bodies), other_force, forces);
    add_moment(a, -moment, forces);
    add_moment(b, moment, forces);
  }

  /// All but the place of its cells in a list. @throws geometry::StateMismatch
  void exchange(geometry::RowFields& row, const StructurePairs& pairs,
                const geometry::Surface& surface) {
    const AnyLaw::Functions* const law = pairs.exchange(row, structure_pair);
    row("cell_a", cells.a);
    row("cell_b", cells.b);
    row.require(has(surface, cells), "cell_a");
    sides.exchange(row, "are_crossed");
    contact::exchange(row, "a", a, surface);
    contact::exchange(row, "b", b, surface);
    row("contacts", count);
    contact::exchange(row, memory, law);
    row("patch", patch);
    row("id", id);
    row("is_broken", is_broken);
    row("separation", separation);
    row("bond_normal", normal);
    row("gap", gap);
    row("pressing", pressing);
    row("other_force", other_force);
    row("moment", moment);
  }

  /// More of the contact is glued, at points where it presses. The bond moves to the mean of both:
  /// the force is the same, and acts there. Does nothing where that would take energy: the bond has
  /// yielded, or is open.
  /// @returns the energy (J) that is lost
  double grow(const StructurePair& bodies, const PressedPoints& at, double more, Positions x) {
    StructureBond grown = *this;
    grown.count += more;
    grown.a.weights = (count * a.weights + more * at.a.weights) / grown.count;
    grown.b.weights = (count * b.weights + more * at.b.weights) / grown.count;
    grown.locate(bodies, x);
    const double lost = history_energy(bodies) - grown.history_energy(bodies);
    if (!(gap < 0.0) || !(grown.gap < 0.0) || !(lost >= 0.0)) return 0.0;
    *this = grown;
    return lost;
  }

  /// The point where the forces act lies between the material points.
  Vec3 lever_a(const StructurePair& bodies) const {
    return bodies.radius_first / (bodies.radius_first + bodies.radius_second) * separation;
  }
  Vec3 lever_b(const StructurePair& bodies) const {
    return -bodies.radius_second / (bodies.radius_first + bodies.radius_second) * separation;
  }

 private:
  static void add_moment(const geometry::CorePoint& core, const Vec3& moment, NodeForces& forces) {
    for (std::size_t i = 0; i < 3; ++i)
      forces.torque[index_of(core.nodes[i])] += core.weights[static_cast<int>(i)] * moment;
  }
};

/// A bond of a pair of cells that presses, without force yet; none if the points do not press.
inline std::optional<StructureBond> new_bond(const StructurePair& bodies, const PressedPoints& at,
                                             double count, Positions x) {
  StructureBond bond;
  bond.a = at.a;
  bond.b = at.b;
  bond.count = count;
  bond.locate(bodies, x);
  if (!(bond.gap < 0.0)) return {};
  bond.memory.normal = bond.normal;
  AnyLaw::cement(bond.parameters(bodies), bond.memory.history);
  return bond;
}

}  // namespace plekton::contact::structure
