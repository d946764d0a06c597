// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_contacts.hpp"

/// One step of the contacts of one ball with one surface.
namespace plekton::contact {

template <ContactLaw Law>
EnergyLoss SurfaceContacts<Law>::advance_pair(Pair& pair, std::span<const geometry::CellId> cells,
                                              const Motion& motion, double dt, int worker_index) {
  Worker& worker = workers_[static_cast<std::size_t>(worker_index)];
  Lists& lists = current_[static_cast<std::size_t>(worker_index)];
  const Vec3& centre = motion.position[index_of(pair.node)];
  const NormalPart one{&pair};
  const auto patches =
      worker.patches.find(centre, pair.reach, cells, motion.position, NormalLaw(one));

  const std::size_t first = lists.contacts.size();
  EnergyLoss loss;
  if (patches.size() == 1 && pair.contacts.count <= 1 &&
      is_lone(worker.patches.terms(patches.front()))) {
    loss = advance_alone(pair, patches[0], motion, dt, worker_index);
  } else {
    keep_sides(pair, patches, motion.position, worker);
    find_states(pair, patches, motion, worker);
    loss = inherit(pair, patches, motion, dt, worker);
    for (std::size_t j = 0; j < patches.size(); ++j) {
      const auto terms = worker.patches.terms(patches[j]);
      loss.dissipated +=
          add_contact(pair, terms, worker.states[j],
                      {worker.term_forces.data() + patches[j].first_term, terms.size()},
                      worker.inherited[j], dt, worker_index);
    }
  }
  const std::size_t count = lists.contacts.size() - first;
  pair.contacts = count == 0 ? Range{}
                             : Range{worker_index, static_cast<std::uint32_t>(first),
                                     static_cast<std::uint32_t>(count)};
  return loss;
}

/// Asks the law, and keeps the contact and its forces. @returns the energy (J) dissipated
template <ContactLaw Law>
double SurfaceContacts<Law>::add_contact(const Pair& pair, std::span<const PatchTerm> terms,
                                         const PatchState& state,
                                         std::span<const PatchTermForce> term_forces,
                                         const Inherited& inherited, double dt, int worker_index) {
  if (HasReach<Law> && !(state.gap < 0.0) && !holds<Law>(inherited.history))
    return Law::history_energy(pair.parameters, inherited.history);
  Lists& lists = current_[static_cast<std::size_t>(worker_index)];
  const RelativeMotion relative = relative_motion(state.normal, state.gap, state.elastic_force,
                                                  state.relative_velocity, state.relative_spin);
  const auto first_minimum = static_cast<std::uint32_t>(lists.minima.size());
  for (const PatchTerm& term : terms) {
    if (term.is_minimum) lists.minima.push_back(term.core.feature);
  }
  typename Law::History next = inherited.history;
  const ContactForce result = Law::force(pair.parameters, relative, next, dt);
  lists.contacts.push_back({{next, state.normal},
                            state.foot,
                            state.gap,
                            state.elastic_force,
                            state.elastic_energy,
                            inherited.id,
                            first_minimum,
                            static_cast<std::uint32_t>(lists.minima.size()) - first_minimum});
  write_forces(pair, terms, state, result, term_forces, worker_index);
  return result.dissipated;
}

/// One patch of one term that follows at most one contact: the same as the general way.
template <ContactLaw Law>
EnergyLoss SurfaceContacts<Law>::advance_alone(const Pair& pair, const Patch& patch,
                                               const Motion& motion, double dt, int worker_index) {
  Worker& worker = workers_[static_cast<std::size_t>(worker_index)];
  const PatchTerm& term = worker.patches.terms(patch)[0];
  const PatchState state =
      lone_state<Law>(term, pair.parameters, pair.node, pair.radius, pair.range, motion);
  Inherited inherited;
  EnergyLoss loss;
  for (const Contact& old : contacts_of(pair, previous_)) {
    const double stored = Law::history_energy(pair.parameters, old.memory.history);
    const Feature* minima =
        previous_[static_cast<std::size_t>(pair.contacts.worker)].minima.data() + old.first_minimum;
    const bool stays = old.minimum_count == 1 && *minima == term.core.feature;
    if (!stays && worker.heirs
                      .find({minima, old.minimum_count}, motion.position[index_of(pair.node)],
                            motion.position, {&patch, 1}, worker.patches)
                      .empty()) {
      loss.dissipated = stored;
      continue;
    }
    loss.tracking = stored;
    worker.pass_throughs += is_turned_over(old.memory.normal, state.normal);
    Law::add_share(inherited.history,
                   carried_history<Law>(old.memory, state.normal, dt * state.twist_rate), 1.0);
    inherited.id = old.id;
  }
  loss.tracking -= Law::history_energy(pair.parameters, inherited.history);
  const PatchTermForce term_force{state.elastic_force, 1.0};
  loss.dissipated +=
      add_contact(pair, {&term, 1}, state, {&term_force, 1}, inherited, dt, worker_index);
  return loss;
}

/// Where a ball's centre lies on the surface itself, the contact of the last step says on which
/// side it is.
template <ContactLaw Law>
void SurfaceContacts<Law>::keep_sides(const Pair& pair, std::span<const Patch> patches, Positions x,
                                      Worker& worker) {
  for (std::size_t j = 0; j < patches.size(); ++j) {
    const std::span<PatchTerm> terms = worker.patches.terms(patches[j]);
    if (terms[0].distance > 0.0 || pair.contacts.count == 0) continue;  // the first is the nearest
    const auto& minima = previous_[static_cast<std::size_t>(pair.contacts.worker)].minima;
    for (const Contact& old : contacts_of(pair, previous_)) {
      const auto heirs = worker.heirs.find({minima.data() + old.first_minimum, old.minimum_count},
                                           x[index_of(pair.node)], x, patches, worker.patches);
      if (std::find(heirs.begin(), heirs.end(), j) == heirs.end()) continue;
      for (PatchTerm& term : terms) {
        const bool is_on_the_surface = term.distance == 0.0 && !term.is_inner;
        if (is_on_the_surface) term.normal = normal_on_last_side(term, old.memory.normal, x);
      }
      break;
    }
  }
}

template <ContactLaw Law>
void SurfaceContacts<Law>::find_states(const Pair& pair, std::span<const Patch> patches,
                                       const Motion& motion, Worker& worker) {
  worker.states.clear();
  worker.term_forces.clear();
  for (const Patch& patch : patches) {
    const auto terms = worker.patches.terms(patch);
    worker.term_forces.resize(patch.first_term + terms.size());
    const std::span<PatchTermForce> term_forces{worker.term_forces.data() + patch.first_term,
                                                terms.size()};
    worker.states.push_back(patch_state(
        patch, terms, pair.range,
        [&](double gap) { return Law::elastic_normal_force(pair.parameters, gap); },
        [&](double gap) { return Law::elastic_normal_energy(pair.parameters, gap); },
        [&](const PatchTerm& term, double elastic) {
          return HasReach<Law> ? term.weight * std::max(0.0, pair.reach - term.distance) : elastic;
        },
        term_forces));
    set_kinematics(worker.states.back(), pair.node, pair.radius, pair.range, terms, term_forces,
                   motion);
  }
}

/// Hands the histories of the last step's contacts to this step's patches. A contact that splits
/// shares its history in proportion to the elastic forces, and its number goes to the patch with
/// the largest; of contacts that merge the one with the largest hands its number on. What a contact
/// stored that nothing follows is dissipated.
template <ContactLaw Law>
EnergyLoss SurfaceContacts<Law>::inherit(const Pair& pair, std::span<const Patch> patches,
                                         const Motion& motion, double dt, Worker& worker) {
  worker.inherited.assign(patches.size(), Inherited{});
  EnergyLoss loss;
  if (pair.contacts.count == 0) return loss;
  const auto& minima = previous_[static_cast<std::size_t>(pair.contacts.worker)].minima;
  for (const Contact& old : contacts_of(pair, previous_)) {
    const auto heirs = worker.heirs.find({minima.data() + old.first_minimum, old.minimum_count},
                                         motion.position[index_of(pair.node)], motion.position,
                                         patches, worker.patches);
    (heirs.empty() ? loss.dissipated : loss.tracking) +=
        Law::history_energy(pair.parameters, old.memory.history);
    double total = 0.0;
    for (const std::uint32_t heir : heirs) total += worker.states[heir].elastic_force;
    hand_on_number(old, heirs, worker);
    // A ball rolls around an edge little by little: a normal that turns over in one step has gone
    // through the surface.
    worker.pass_throughs +=
        !heirs.empty() && std::all_of(heirs.begin(), heirs.end(), [&](std::uint32_t heir) {
          return is_turned_over(old.memory.normal, worker.states[heir].normal);
        });
    for (const std::uint32_t heir : heirs) {
      const PatchState& state = worker.states[heir];
      const double share =
          total > 0.0 ? state.elastic_force / total : 1.0 / static_cast<double>(heirs.size());
      Law::add_share(worker.inherited[heir].history,
                     carried_history<Law>(old.memory, state.normal, dt * state.twist_rate), share);
    }
  }
  for (const Inherited& inherited : worker.inherited)
    loss.tracking -= Law::history_energy(pair.parameters, inherited.history);
  return loss;
}

template <ContactLaw Law>
void SurfaceContacts<Law>::hand_on_number(const Contact& old, std::span<const std::uint32_t> heirs,
                                          Worker& worker) {
  if (heirs.empty()) return;
  const std::uint32_t largest =
      *std::max_element(heirs.begin(), heirs.end(), [&](std::uint32_t p, std::uint32_t q) {
        return worker.states[p].elastic_force < worker.states[q].elastic_force;
      });
  Inherited& inherited = worker.inherited[largest];
  if (!(old.elastic_force > inherited.from)) return;
  inherited.id = old.id;
  inherited.from = old.elastic_force;
}

template <ContactLaw Law>
void SurfaceContacts<Law>::write_forces(const Pair& pair, std::span<const PatchTerm> terms,
                                        const PatchState& state, const ContactForce& answer,
                                        std::span<const PatchTermForce> term_forces, int worker) {
  auto& records = records_.of_worker(worker);
  const auto contact =
      static_cast<std::uint32_t>(current_[static_cast<std::size_t>(worker)].contacts.size() - 1);
  const Vec3 other_force = answer.force - state.elastic_force * state.normal;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Vec3 other = term_forces[i].share * other_force;
    const Vec3 lever_b = state.lever_a - terms[i].distance * terms[i].normal;
    records.add(
        {pair.node, terms[i].core, term_forces[i].elastic * terms[i].normal + other,
         -state.lever_a.cross(other) - term_forces[i].share * answer.moment,
         lever_b.cross(other) + term_forces[i].share * answer.moment, term_forces[i].elastic,
         static_cast<std::uint32_t>(&pair - pairs_.data()), contact},
        -state.gap / pair.radius);
  }
}

}  // namespace plekton::contact
