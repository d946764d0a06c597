// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/history_transfer.hpp"

#include "contact/sphere_surface/last_side.hpp"
#include "contact/sphere_surface/single_feature_contact.hpp"
#include "geometry/critical/descent.hpp"

#include <algorithm>

namespace plekton::contact {

void HistoryTransfer::keep_sides(const PatchesOfPair& now, const ContactsOfPair& last,
                                 Positions x) {
  for (std::size_t j = 0; j < now.patches.size(); ++j) {
    const std::span<PatchTerm> terms = now.finder.terms(now.patches[j]);
    if (terms[0].distance > 0.0) continue;  // the first is the nearest
    for (const PatchContact& old : last.contacts) {
      const auto successors = successors_of(last.minima_of(old), now, x);
      if (std::find(successors.begin(), successors.end(), j) == successors.end()) continue;
      for (PatchTerm& term : terms) {
        const bool is_on_the_surface = term.distance == 0.0 && !term.is_inner;
        if (is_on_the_surface) term.normal = normal_on_last_side(term, old.memory.normal, x);
      }
      break;
    }
  }
}

EnergyLoss HistoryTransfer::to_patches(const PatchesOfPair& now, const ContactsOfPair& last,
                                       std::span<const PatchState> states, const Motion& motion,
                                       double dt) {
  transferred_.assign(now.patches.size(), Transferred{});
  EnergyLoss loss;
  if (last.contacts.empty()) return loss;
  const AnyLaw::Parameters& parameters = now.pair.parameters;
  for (const PatchContact& old : last.contacts) {
    const auto minima = last.minima_of(old);
    const auto successors = successors_of(minima, now, motion.position);
    if (successors.empty()) {
      loss.dissipated += loss_of(now.pair, old, minima, motion, dt);
      continue;
    }
    loss.tracking += AnyLaw::history_energy(parameters, old.memory.history);
    hand_on_number(old, successors, states);
    // A sphere rolls around an edge little by little: a normal that turns over in one step has gone
    // through the surface.
    pass_throughs_ +=
        std::all_of(successors.begin(), successors.end(), [&](std::uint32_t successor) {
          return has_passed(now.pair, old.memory.normal, states[successor], dt);
        });
    hand_on_history(old, successors, states, dt);
  }
  for (const Transferred& transferred : transferred_)
    loss.tracking -= AnyLaw::history_energy(parameters, transferred.history);
  return loss;
}

double HistoryTransfer::loss_of(const SphereSurfacePair& pair, const PatchContact& old,
                                std::span<const Feature> minima, const Motion& motion,
                                double dt) const {
  if (minima.empty()) return loss_at_end<AnyLaw>(pair.parameters, old.memory, {});
  const Positions x = motion.position;
  const Vec3& centre = x[index_of(pair.node)];
  const geometry::SurfaceFoot foot = geometry::foot_on(
      *surface_, geometry::closest_feature(*surface_, minima[0], centre, x), centre, x);
  PatchState state;
  state.normal = old.memory.normal;
  state.gap = foot.distance - pair.range;
  state.foot = foot.distance * foot.direction;
  set_kinematics(state, foot.core, pair.node, pair.radius, pair.range, motion);
  return loss_at_end<AnyLaw>(pair.parameters, old.memory, state.displacement_in(dt));
}

void HistoryTransfer::hand_on_number(const PatchContact& old,
                                     std::span<const std::uint32_t> successors,
                                     std::span<const PatchState> states) {
  const std::uint32_t largest = *std::max_element(
      successors.begin(), successors.end(), [&](std::uint32_t p, std::uint32_t q) {
        return states[p].elastic_force < states[q].elastic_force;
      });
  Transferred& transferred = transferred_[largest];
  if (!(old.elastic_force > transferred.from)) return;
  transferred.id = old.id;
  transferred.from = old.elastic_force;
}

void HistoryTransfer::hand_on_history(const PatchContact& old,
                                      std::span<const std::uint32_t> successors,
                                      std::span<const PatchState> states, double dt) {
  double total = 0.0;
  std::uint32_t nearest = successors.front();
  for (const std::uint32_t successor : successors) {
    total += states[successor].elastic_force;
    if (states[successor].gap < states[nearest].gap) nearest = successor;
  }
  for (const std::uint32_t successor : successors) {
    const PatchState& state = states[successor];
    const double share = total > 0.0            ? state.elastic_force / total
                         : successor == nearest ? 1.0
                                                : 0.0;
    if (!(share > 0.0)) continue;  // what is apart beside it has no part in it, nor its bond
    AnyLaw::accumulate_history(
        transferred_[successor].history,
        carried_history<AnyLaw>(old.memory, state.normal, dt * state.twist_rate), share);
  }
}

}  // namespace plekton::contact
