// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/relative_motion.hpp"
#include "contact/law/any_law.hpp"
#include "contact/surface_surface/mean_overlap.hpp"
#include "contact/surface_surface/patch_side.hpp"
#include "contact/surface_surface/structure_pairs.hpp"
#include "contact/tracking/contact_memory.hpp"
#include "contact/tracking/contact_state.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace plekton::contact::structure {

/// A part of the contact region of two structures that hangs together: one contact, as far as the
/// law is concerned, as stiff as the contacts it counts.
struct StructurePatch {
  std::uint32_t structure_pair = 0;
  double energy = 0.0;                ///< J, elastic
  double attraction_energy = 0.0;     ///< J, <= 0 but for what counts as negative
  Vec3 elastic_force = Vec3::Zero();  ///< N, on the second side
  double normal_force = 0.0;          ///< N, its magnitude
  double count = 0.0;                 ///< how many contacts it is
  double gap = 0.0;                   ///< m, mean over the forces
  PatchSide first;
  PatchSide second;
  double free_part = 1.0;   ///< of its tangential force, that no bonds carry
  double point_part = 1.0;  ///< of its elastic force, that facets lying on each other do not carry:
                            ///< they have friction of their own (spread_contact.hpp)
  double bar_part = 0.0;    ///< of its elastic force, that pairs with a bar carry: likewise
  bool is_torn = false;     ///< a bond has broken in it: it forms no others
  ContactMemory<AnyLaw> memory;
  std::int64_t id = 0;    ///< 0: none yet
  double id_from = -1.0;  ///< N, normal force of the patch of the last step that the id is from
  Vec3 other_force = Vec3::Zero();  ///< N, on the second side: all but that and attraction
  Vec3 moment = Vec3::Zero();       ///< N m, on the second side
  /// On either side, the features of the term that overlaps most, and how far (m).
  std::array<geometry::FeatureNodes, 2> deepest{};
  double deepest_overlap = -1.0;
  std::size_t crossings = 0;  ///< pairs of cells whose cores touch or cross

  /// No forces yet; the nodes stay.
  void reset() {
    first.reset_forces();
    second.reset_forces();
    energy = 0.0;
    attraction_energy = 0.0;
    free_part = 1.0;
    point_part = 1.0;
    bar_part = 0.0;
    is_torn = false;
    memory = {};
    id = 0;
    id_from = -1.0;
    other_force = Vec3::Zero();
    moment = Vec3::Zero();
    deepest_overlap = -1.0;
    crossings = 0;
  }

  bool pushes() const noexcept { return normal_force > 0.0; }
  /// Unit, from the first side to the second, of a patch that pushes.
  Vec3 normal() const { return elastic_force / normal_force; }

  /// What the forces on the nodes come to.
  void find_totals(const StructurePair& bodies, Positions x) {
    elastic_force = second.total_force();
    // Where forces cancel, as those of facets beside each other in one plane do, what is left is
    // rounding: it has no direction, nor shares.
    constexpr double kRounding = 1e-14;
    if (!(elastic_force.norm() > kRounding * second.size_of_forces())) elastic_force.setZero();
    find_mean(bodies);
    if (!pushes()) return;
    const Vec3 per_force = elastic_force / (normal_force * normal_force);
    first.find_shares(x, -per_force);
    second.find_shares(x, per_force);
  }

  /// Mean overlap, and how many contacts that are.
  void find_mean(const StructurePair& bodies) {
    normal_force = elastic_force.norm();
    gap = pushes() ? -mean_overlap(bodies.parameters, energy, normal_force) : 0.0;
    const double one = AnyLaw::elastic_normal_force(bodies.parameters, gap);
    count = one > 0.0 ? normal_force / one : 0.0;
  }

  /// Of the contact as a whole.
  AnyLaw::Parameters whole_parameters(const StructurePair& bodies) const {
    return AnyLaw::scaled(bodies.parameters, count);
  }
  /// How many contacts it has a history for.
  double point_count() const noexcept { return point_part * count; }
  /// Of those, what they have beside bonds.
  AnyLaw::Parameters parameters(const StructurePair& bodies) const {
    return AnyLaw::unbonded_part(AnyLaw::scaled(bodies.parameters, point_count()), free_part);
  }

  double history_energy(const StructurePair& bodies) const {
    return AnyLaw::history_energy(parameters(bodies), memory.history);
  }

  /// @param contacts  between its structures, in all patches
  /// @returns the energy (J) dissipated
  double apply_law(const StructurePair& bodies, double contacts, const Motion& motion, double dt) {
    if (!pushes()) return 0.0;
    memory.normal = normal();
    if (!(point_part > 0.0)) return 0.0;
    const RelativeMotion relative = relative_motion(memory.normal, gap, point_part * normal_force,
                                                    velocity(bodies, motion), spin(motion));
    const auto of_part = AnyLaw::unbonded_part(
        AnyLaw::scaled(bodies.of_part(point_count() / contacts), point_count()), free_part);
    const ContactForce result = AnyLaw::force(of_part, relative, memory.history, dt);
    other_force = result.force - point_part * elastic_force;
    moment = result.moment;
    return result.dissipated;
  }

  /// W, of half of the last force and moment, which go on for half of the step that ends the contact
  /// (loss_at_end()).
  double last_power(const StructurePair& bodies, const Motion& motion) const {
    if (!pushes()) return 0.0;
    return 0.5 * (other_force.dot(velocity(bodies, motion)) + moment.dot(spin(motion)));
  }

  void add_forces(const StructurePair& bodies, NodeForces& forces) const {
    first.add_normal_forces(forces);
    second.add_normal_forces(forces);
    if (!pushes()) return;
    first.add_force_at(lever_of_first(bodies), -other_force, forces);
    second.add_force_at(lever_of_second(bodies), other_force, forces);
    first.add_moment(-moment, forces);
    second.add_moment(moment, forces);
  }

  /// @param pairs  of structures. @throws geometry::StateMismatch
  void exchange(geometry::RowFields& row, const StructurePairs& pairs,
                const geometry::Surface& surface) {
    const AnyLaw::Functions* const law = pairs.exchange(row, structure_pair);
    row("energy", energy);
    row("attraction_energy", attraction_energy);
    row("elastic_force", elastic_force);
    row("normal_force", normal_force);
    row("contacts", count);
    row("gap", gap);
    first.exchange(row, "first", surface);
    second.exchange(row, "second", surface);
    row("free_part", free_part);
    row("point_part", point_part);
    row("bar_part", bar_part);
    row("is_torn", is_torn);
    contact::exchange(row, memory, law);
    row("id", id);
    row("other_force", other_force);
    row("moment", moment);
    row("deepest", deepest);
    row.require(has(surface, deepest[0]) && has(surface, deepest[1]), "deepest");
    row("deepest_overlap", deepest_overlap);
  }

  /// The contact point lies between the two points on which the elastic force acts.
  Vec3 lever_of_first(const StructurePair& bodies) const {
    return bodies.radius_first / range(bodies) * (second.point() - first.point());
  }
  Vec3 lever_of_second(const StructurePair& bodies) const {
    return bodies.radius_second / range(bodies) * (first.point() - second.point());
  }

 private:
  /// m/s and rad/s, of the second side relative to the first at the contact point.
  Vec3 velocity(const StructurePair& bodies, const Motion& motion) const {
    return second.velocity_at(lever_of_second(bodies), motion) -
           first.velocity_at(lever_of_first(bodies), motion);
  }
  Vec3 spin(const Motion& motion) const {
    return second.angular_velocity(motion) - first.angular_velocity(motion);
  }
  static double range(const StructurePair& bodies) {
    return bodies.radius_first + bodies.radius_second;
  }
};

}  // namespace plekton::contact::structure
