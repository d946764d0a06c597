// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/contact_law.hpp"
#include "contact/sphere_surface/patch_force.hpp"
#include "contact/tracking/contact_memory.hpp"

/// Nearly all patches are one minimum alone, and follow one contact alone: what the general way
/// makes of these, to the last bit, without its sums and lists.
namespace plekton::contact {

/// Whether a patch is one minimum alone, with a normal that is certain.
inline bool is_single_feature(std::span<const PatchTerm> terms) noexcept {
  return terms.size() == 1 && terms[0].weight == 1.0 && terms[0].slope == 0.0 &&
         terms[0].distance > 0.0;
}

/// set_kinematics() of one core point, at the normal, gap and foot that the state has.
inline void set_kinematics(PatchState& state, const geometry::CorePoint& core, NodeId sphere,
                           double radius, double range, const Motion& motion) {
  const double distance = range + state.gap;
  state.lever_a = distance > 0.0 ? Vec3((radius + 0.5 * state.gap) / distance * state.foot)
                                 : Vec3(Vec3::Zero());
  const Vec3 lever_b = state.lever_a - state.foot;
  const Vec3& spin_a = motion.angular_velocity[index_of(sphere)];
  state.relative_velocity = velocity_at(core, lever_b, motion) - motion.velocity[index_of(sphere)] -
                            spin_a.cross(state.lever_a);
  const Vec3 spin_b = angular_velocity_at(core, motion);
  state.relative_spin = spin_b - spin_a;
  state.twist_rate = 0.5 * (spin_a + spin_b).dot(state.normal);
}

/// patch_state() and set_kinematics() of a patch that is_single_feature().
/// @param normal          of one feature, as NormalPart has it
/// @param sphere, radius  of side a, m
/// @param range           m, radius of sphere + radius of surface
template <class Normal>
PatchState single_feature_state(const PatchTerm& term, const Normal& normal, NodeId sphere,
                                double radius, double range, const Motion& motion) {
  PatchState state;
  state.root = term.core.feature;
  state.normal = term.normal;
  state.gap = term.distance - range;
  state.elastic_force = normal.elastic_force(state.gap);
  state.elastic_energy = normal.energy(state.gap);
  state.foot = term.distance * term.normal;
  set_kinematics(state, term.core, sphere, radius, range, motion);
  return state;
}

}  // namespace plekton::contact
