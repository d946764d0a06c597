// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/sphere_surface/patch.hpp"
#include "contact/tracking/contact_memory.hpp"
#include "contact/tracking/interpolation.hpp"

#include <span>
#include <vector>

namespace plekton::contact {

/// A patch as one contact of a sphere (a) with a surface (b).
struct PatchState {
  Feature root;
  Vec3 normal = Vec3::Zero();   ///< unit, direction of the elastic force on b
  double gap = 0.0;             ///< m, of the deepest minimum
  double elastic_force = 0.0;   ///< N, the terms' elastic forces added as vectors
  double elastic_energy = 0.0;  ///< J, of these and the attraction
  Vec3 foot = Vec3::Zero();     ///< m, from the sphere's centre to the representative point:
                                ///< mean of the feet by shares
  Vec3 lever_a = Vec3::Zero();  ///< m, from the sphere's centre to the contact points, by shares
  Vec3 relative_velocity = Vec3::Zero();  ///< m/s, of b relative to a at the contact point
  Vec3 relative_spin = Vec3::Zero();      ///< rad/s, of b relative to a
  double twist_rate = 0.0;  ///< rad/s, mean angular velocity of both bodies about the normal

  /// In a step (s) that ends the contact.
  LastDisplacement displacement_in(double dt) const {
    return {dt * relative_velocity, dt * relative_spin};
  }
};

/// What a term carries of its patch.
struct PatchTermForce {
  double elastic;     ///< N, along the term's normal; negative for a saddle
  double attraction;  ///< N, against the term's normal; negative for a saddle
  double share;       ///< of every other force of the patch; the shares of a patch add up to 1

  /// N, a force on b and the attraction.
  Vec3 pulled(const Vec3& force, const Vec3& normal) const {
    return attraction != 0.0 ? Vec3(force - attraction * normal) : force;
  }
};

/// Adds up the elastic forces of a patch. Each term pushes at its own foot, through the sphere's
/// centre. What changes of shares do to the attraction (PatchTerm::slope) is among them.
/// @param normal       of one feature, as NormalPart has it
/// @param hold         (term, elastic force) -> how much a term counts in the normal, in any unit:
///                     its elastic force, if only what pushes is in contact
/// @param term_forces  of the same length as terms
template <class Normal, class Hold>
PatchState patch_state(const Patch& patch, std::span<const PatchTerm> terms, double range,
                       const Normal& normal, Hold hold, std::span<PatchTermForce> term_forces) {
  PatchState state;
  state.root = patch.root;
  state.gap = terms[0].distance - range;
  double total_elastic = 0.0, shares = 0.0;
  Vec3 force = Vec3::Zero(), holding = Vec3::Zero();
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const PatchTerm& term = terms[i];
    const double gap = term.distance - range;
    const double elastic = term.weight * normal.elastic_force(gap) + term.slope;
    term_forces[i] = {elastic, term.weight * normal.attraction(gap), term.share};
    shares += term.share;
    total_elastic += elastic;
    force += elastic * term.normal;
    if (!term.is_inner) holding += hold(term, elastic) * term.normal;
    state.foot += term.share * term.distance * term.normal;
    state.elastic_energy += term.weight * normal.energy(gap) + term.energy;
  }
  const double length = holding.norm();
  state.normal = length > 0.0 && terms.size() > 1 ? Vec3(holding / length) : terms[0].normal;
  state.elastic_force = terms.size() > 1 ? force.norm() : total_elastic;
  if (!(shares > 0.0)) {
    // A piece that has lost its minima to rounding: its first term stands for all.
    term_forces[0].share = shares = 1.0;
    state.foot = terms[0].distance * terms[0].normal;
  }
  state.foot /= shares;
  for (PatchTermForce& term_force : term_forces) term_force.share /= shares;
  return state;
}

/// Lets a patch that is apart, but still glued, be held where it is nearest alone. The law pulls by
/// the gap, and that is the slope of the gap: along the mean of several minima, at all of them, a
/// bond would make energy.
inline void hold_where_nearest(PatchState& state, std::span<const PatchTerm> terms,
                               std::span<PatchTermForce> term_forces) {
  if (state.gap < 0.0 || state.elastic_force != 0.0 || terms.size() < 2) return;
  for (PatchTermForce& term_force : term_forces) term_force.share = 0.0;
  term_forces[0].share = 1.0;
  state.normal = terms[0].normal;
  state.foot = terms[0].distance * terms[0].normal;
}

/// From the sphere's centre to the contact point of a term (m): half the gap away from either
/// surface, on the line to the foot. Any point would balance the momenta, as long as both sides use
/// the same; but a node takes no more turning than a force near it makes, so that each term of a
/// patch has its own, however far around the sphere the patch reaches.
inline Vec3 contact_lever(const PatchTerm& term, double radius, double range) {
  const double gap = term.distance - range;
  const double distance = range + gap;
  if (!(distance > 0.0)) return Vec3::Zero();
  const Vec3 foot = term.distance * term.normal;
  return (radius + 0.5 * gap) / distance * foot;
}

/// Finds the relative motion at the contact points, in the mean by the shares of the terms: so the
/// forces that are shared out do the work that the law reckons with.
inline void set_kinematics(PatchState& state, NodeId sphere, double radius, double range,
                           std::span<const PatchTerm> terms,
                           std::span<const PatchTermForce> term_forces, const Motion& motion) {
  Vec3 velocity = Vec3::Zero();
  Vec3 spin = Vec3::Zero();
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const double share = term_forces[i].share;
    const Vec3 lever_a = contact_lever(terms[i], radius, range);
    const Vec3 lever_b = lever_a - terms[i].distance * terms[i].normal;
    state.lever_a += share * lever_a;
    velocity += share * velocity_at(terms[i].core, lever_b, motion);
    spin += share * angular_velocity_at(terms[i].core, motion);
  }
  const Vec3& spin_a = motion.angular_velocity[index_of(sphere)];
  state.relative_velocity =
      velocity - motion.velocity[index_of(sphere)] - spin_a.cross(state.lever_a);
  state.relative_spin = spin - spin_a;
  state.twist_rate = 0.5 * (spin_a + spin).dot(state.normal);
}

}  // namespace plekton::contact
