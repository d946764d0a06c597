// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_contacts.hpp"

/// Most balls in contact lie where they lay in the step before: on the inside of one facet, far
/// from its sides. These go side by side; all others, and those that turn out to have moved on, one
/// after the other (surface_contacts_step.hpp), in the order of the list.
namespace plekton::contact {

template <ContactLaw Law>
double SurfaceContacts<Law>::advance_pairs(std::size_t begin, std::size_t end, const Motion& motion,
                                           double dt, int worker_index) {
  [[maybe_unused]] LonePairs<Law>& lone = workers_[static_cast<std::size_t>(worker_index)].lone;
  double dissipated = 0.0;
  while (begin < end) {
    std::size_t next = end;
    if constexpr (LaneLaw<Law>) {
      next = gather_lone(begin, end, motion, lone);
      advance_side_by_side(lone.block, lone.count, dt);
    }
    std::size_t lane = 0;
    for (std::size_t i = begin; i < next; ++i) {
      if (watch_.is_asleep(pairs_[i].awake)) continue;
      if constexpr (LaneLaw<Law>) {
        if (lane < lone.count && lone.pair[lane] == i) {
          const std::size_t its_lane = lane++;
          if (lone.block.is_right.number(its_lane) > 0.0) {
            dissipated += keep_lone(pairs_[i], its_lane, worker_index);
            continue;
          }
        }
      }
      dissipated += advance_pair(pairs_[i], motion, dt, worker_index);
    }
    begin = next;
  }
  return dissipated;
}

/// Whether a minimum alone was the only contact of a pair in the last step.
template <ContactLaw Law>
bool SurfaceContacts<Law>::is_in_contact(const Pair& pair, Feature minimum) const noexcept {
  if (pair.range.count != 1) return false;
  const Contact& contact = contacts_of(pair, previous_)[0];
  const auto& minima = previous_[static_cast<std::size_t>(pair.range.worker)].minima;
  return contact.minimum_count == 1 && minima[contact.first_minimum] == minimum;
}

/// Gathers pairs as long as there are lanes. @returns the first pair that was not looked at
template <ContactLaw Law>
std::size_t SurfaceContacts<Law>::gather_lone(std::size_t begin, std::size_t end,
                                              const Motion& motion, LonePairs<Law>& lone) const {
  lone.count = 0;
  std::size_t i = begin;
  for (; i < end && lone.count < kLoneLanes; ++i) {
    const Pair& pair = pairs_[i];
    const geometry::CellId* const cell = watch_.only_cell(pair.near, pair.awake);
    if (cell == nullptr || index_of(*cell) >= surface_->face_count()) continue;
    const auto face = geometry::id_at<geometry::FaceId>(index_of(*cell));
    if (!is_in_contact(pair, Feature(face))) continue;
    lone.pair[lone.count] = i;
    lone.face[lone.count] = face;
    gather(pair, face, motion, lone);
    ++lone.count;
  }
  return i;
}

template <ContactLaw Law>
void SurfaceContacts<Law>::gather(const Pair& pair, geometry::FaceId face, const Motion& motion,
                                  LonePairs<Law>& lone) const {
  auto& block = lone.block;
  const std::size_t lane = lone.count;
  const auto& corners = surface_->nodes_of(face);
  const std::array<NodeId, 4> nodes{pair.node, corners[0], corners[1], corners[2]};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t node = index_of(nodes[k]);
    block.position[k].set(lane, motion.position[node]);
    block.velocity[k].set(lane, motion.velocity[node]);
    block.spin[k].set(lane, motion.angular_velocity[node]);
  }
  const ContactMemory<Law>& memory = contacts_of(pair, previous_)[0].memory;
  block.radius.set(lane, pair.radius);
  block.range.set(lane, pair.reach);
  block.parameters.set(lane, pair.parameters);
  block.history.set(lane, memory.history);
  block.normal.set(lane, memory.normal);
}

/// Keeps the contact and its forces. @returns the energy (J) dissipated
template <ContactLaw Law>
double SurfaceContacts<Law>::keep_lone(Pair& pair, std::size_t lane, int worker_index) {
  const LonePairs<Law>& lone = workers_[static_cast<std::size_t>(worker_index)].lone;
  const auto& block = lone.block;
  const double gap = block.gap.number(lane);
  SurfaceForce& record = records_.of_worker(worker_index).add(-gap / pair.radius);
  record.a = pair.node;
  record.core.nodes = surface_->nodes_of(lone.face[lane]);
  record.core.feature = Feature(lone.face[lane]);
  block.weights.get(lane, record.core.weights);
  block.force_b.get(lane, record.force);
  block.torque_a.get(lane, record.torque_a);
  block.torque_b.get(lane, record.torque_b);
  record.contact = static_cast<std::size_t>(&pair - pairs_.data());

  const auto& last = contacts_of(pair, previous_)[0].memory.history;
  const auto carried = block.carried.template at<typename Law::History>(lane);
  const double lost =
      Law::history_energy(pair.parameters, last) - Law::history_energy(pair.parameters, carried);
  Lists& lists = current_[static_cast<std::size_t>(worker_index)];
  pair.range = {worker_index, static_cast<std::uint32_t>(lists.contacts.size()), 1};
  lists.contacts.push_back({{block.history.template at<typename Law::History>(lane),
                             block.normal.template at<Vec3>(lane)},
                            block.force.template at<Vec3>(lane),
                            block.foot.template at<Vec3>(lane),
                            gap,
                            Law::elastic_normal_energy(pair.parameters, gap),
                            static_cast<std::uint32_t>(lists.minima.size()),
                            1});
  lists.minima.push_back(record.core.feature);
  return lost + block.dissipated.number(lane);
}

}  // namespace plekton::contact
