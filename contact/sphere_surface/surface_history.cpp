// SPDX-License-Identifier: GPL-3.0-or-later
// How histories of contacts of spheres with surfaces go from the contacts of a step to those of the next.
#include "contact/sphere_surface/surface_contacts.hpp"
#include "geometry/critical/descent.hpp"

namespace plekton::contact {

double SurfaceContacts::loss_of(const Pair& pair, const Contact& old, const Motion& motion,
                                double dt) const {
  if (old.minimum_count == 0) return loss_at_end<AnyLaw>(pair.parameters, old.memory, {});
  const Feature minimum =
      previous_[static_cast<std::size_t>(pair.contacts.worker)].minima[old.first_minimum];
  const Positions x = motion.position;
  const Vec3& centre = x[index_of(pair.node)];
  const geometry::SurfaceFoot foot = geometry::foot_on(
      *surface_, geometry::closest_feature(*surface_, minimum, centre, x), centre, x);
  PatchState state;
  state.normal = old.memory.normal;
  state.gap = foot.distance - pair.range;
  state.foot = foot.distance * foot.direction;
  set_kinematics(state, foot.core, pair.node, pair.radius, pair.range, motion);
  return loss_at_end<AnyLaw>(pair.parameters, old.memory, state.way_in(dt));
}

/// Where a sphere's centre lies on the surface itself, the contact of the last step says on which
/// side it is.
void SurfaceContacts::keep_sides(const Pair& pair, std::span<const Patch> patches, Positions x,
                                 Worker& worker) {
  for (std::size_t j = 0; j < patches.size(); ++j) {
    const std::span<PatchTerm> terms = worker.patches.terms(patches[j]);
    if (terms[0].distance > 0.0 || pair.contacts.count == 0) continue;  // the first is the nearest
    const auto& minima = previous_[static_cast<std::size_t>(pair.contacts.worker)].minima;
    for (const Contact& old : contacts_of(pair, previous_)) {
      const auto successors =
          worker.successors.find({minima.data() + old.first_minimum, old.minimum_count},
                                 x[index_of(pair.node)], x, patches, worker.patches);
      if (std::find(successors.begin(), successors.end(), j) == successors.end()) continue;
      for (PatchTerm& term : terms) {
        const bool is_on_the_surface = term.distance == 0.0 && !term.is_inner;
        if (is_on_the_surface) term.normal = normal_on_last_side(term, old.memory.normal, x);
      }
      break;
    }
  }
}

/// Hands the histories of the last step's contacts to this step's patches. A contact that splits
/// shares its history in proportion to the elastic forces; under tension the nearest part has all
/// of it. Its number goes to the patch with the largest force; of contacts that merge the one with
/// the largest hands its number on. What a contact stored that nothing follows is dissipated.
EnergyLoss SurfaceContacts::transfer(const Pair& pair, std::span<const Patch> patches,
                                     const Motion& motion, double dt, Worker& worker) {
  worker.transferred.assign(patches.size(), Transferred{});
  EnergyLoss loss;
  if (pair.contacts.count == 0) return loss;
  const auto& minima = previous_[static_cast<std::size_t>(pair.contacts.worker)].minima;
  for (const Contact& old : contacts_of(pair, previous_)) {
    const auto successors = worker.successors.find(
        {minima.data() + old.first_minimum, old.minimum_count},
        motion.position[index_of(pair.node)], motion.position, patches, worker.patches);
    if (successors.empty())
      loss.dissipated += loss_of(pair, old, motion, dt);
    else
      loss.tracking += AnyLaw::history_energy(pair.parameters, old.memory.history);
    double total = 0.0;
    std::uint32_t nearest = successors.empty() ? 0 : successors.front();
    for (const std::uint32_t successor : successors) {
      total += worker.states[successor].elastic_force;
      if (worker.states[successor].gap < worker.states[nearest].gap) nearest = successor;
    }
    hand_on_number(old, successors, worker);
    // A sphere rolls around an edge little by little: a normal that turns over in one step has gone
    // through the surface.
    worker.pass_throughs +=
        !successors.empty() &&
        std::all_of(successors.begin(), successors.end(), [&](std::uint32_t successor) {
          return is_turned_over(old.memory.normal, worker.states[successor].normal);
        });
    for (const std::uint32_t successor : successors) {
      const PatchState& state = worker.states[successor];
      const double share = total > 0.0            ? state.elastic_force / total
                           : successor == nearest ? 1.0
                                                  : 0.0;
      if (!(share > 0.0)) continue;  // what is apart beside it has no part in it, nor its bond
      AnyLaw::accumulate_history(
          worker.transferred[successor].history,
          carried_history<AnyLaw>(old.memory, state.normal, dt * state.twist_rate), share);
    }
  }
  for (const Transferred& transferred : worker.transferred)
    loss.tracking -= AnyLaw::history_energy(pair.parameters, transferred.history);
  return loss;
}

void SurfaceContacts::hand_on_number(const Contact& old, std::span<const std::uint32_t> successors,
                                     Worker& worker) {
  if (successors.empty()) return;
  const std::uint32_t largest = *std::max_element(
      successors.begin(), successors.end(), [&](std::uint32_t p, std::uint32_t q) {
        return worker.states[p].elastic_force < worker.states[q].elastic_force;
      });
  Transferred& transferred = worker.transferred[largest];
  if (!(old.elastic_force > transferred.from)) return;
  transferred.id = old.id;
  transferred.from = old.elastic_force;
}

}  // namespace plekton::contact
