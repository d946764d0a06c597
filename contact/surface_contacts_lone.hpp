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
  Worker& worker = workers_[static_cast<std::size_t>(worker_index)];
  double dissipated = 0.0;
  while (begin < end) {
    begin = find_jobs(begin, end, motion, worker);
    if constexpr (LaneLaw<Law>) advance_side_by_side(worker.lone.block, worker.lone.count, dt);
    for (const Job& job : worker.jobs) {
      Pair& pair = pairs_[job.pair];
      if constexpr (LaneLaw<Law>) {
        if (job.lane != kNoLane && worker.lone.block.is_right.number(job.lane) > 0.0) {
          dissipated += keep_lone(pair, job.lane, worker_index);
          continue;
        }
      }
      dissipated += advance_pair(pair, {worker.cells.data() + job.first_cell, job.cell_count},
                                 motion, dt, worker_index);
    }
  }
  return dissipated;
}

/// Finds the pairs that are awake, as long as there are lanes for those that may go side by side.
/// @returns the first pair that was not looked at
template <ContactLaw Law>
std::size_t SurfaceContacts<Law>::find_jobs(std::size_t begin, std::size_t end,
                                            const Motion& motion, Worker& worker) {
  worker.jobs.clear();
  worker.cells.clear();
  make_room(worker.jobs, end - begin);
  if constexpr (LaneLaw<Law>) worker.lone.count = 0;
  std::size_t i = begin;
  for (; i < end; ++i) {
    Pair& pair = pairs_[i];
    if (watch_.is_asleep(pair.awake)) continue;
    Job job{i, worker.cells.size(), 0, kNoLane};
    watch_.find(pair.near, motion.position[index_of(pair.node)], pair.reach, motion.position,
                pair.awake, worker.cells);
    job.cell_count = worker.cells.size() - job.first_cell;
    if constexpr (LaneLaw<Law>) {
      if (may_be_alone(pair, {worker.cells.data() + job.first_cell, job.cell_count})) {
        job.lane = worker.lone.count;
        const std::size_t face = index_of(worker.cells[job.first_cell]);
        gather(pair, geometry::id_at<geometry::FaceId>(face), motion, worker.lone);
      }
    }
    if (job.cell_count > 0 || pair.contacts.count > 0) worker.jobs.push_back(job);
    if constexpr (LaneLaw<Law>) {
      if (worker.lone.count == kLoneLanes) return i + 1;
    }
  }
  return i;
}

/// Whether one facet alone may be in range, and its inside was the only contact of the pair in the
/// last step.
template <ContactLaw Law>
bool SurfaceContacts<Law>::may_be_alone(const Pair& pair,
                                        std::span<const geometry::CellId> cells) const noexcept {
  if (cells.size() != 1 || pair.contacts.count != 1) return false;
  const Contact& contact = contacts_of(pair, previous_)[0];
  const auto& minima = previous_[static_cast<std::size_t>(pair.contacts.worker)].minima;
  return contact.minimum_count == 1 && index_of(cells[0]) < surface_->face_count() &&
         minima[contact.first_minimum] == surface_->feature_of(cells[0]);
}

template <ContactLaw Law>
void SurfaceContacts<Law>::gather(const Pair& pair, geometry::FaceId face, const Motion& motion,
                                  LonePairs<Law>& lone) const {
  auto& block = lone.block;
  const std::size_t lane = lone.count++;
  lone.face[lane] = face;
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
  block.range.set(lane, pair.range);
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
  record.pair = static_cast<std::uint32_t>(&pair - pairs_.data());

  const Contact& old = contacts_of(pair, previous_)[0];
  const auto carried = block.carried.template at<typename Law::History>(lane);
  const double lost = Law::history_energy(pair.parameters, old.memory.history) -
                      Law::history_energy(pair.parameters, carried);
  Lists& lists = current_[static_cast<std::size_t>(worker_index)];
  pair.contacts = {worker_index, static_cast<std::uint32_t>(lists.contacts.size()), 1};
  record.contact = pair.contacts.first;
  lists.contacts.push_back({{block.history.template at<typename Law::History>(lane),
                             block.normal.template at<Vec3>(lane)},
                            block.foot.template at<Vec3>(lane),
                            gap,
                            Law::elastic_normal_force(pair.parameters, gap),
                            Law::elastic_normal_energy(pair.parameters, gap),
                            old.id,
                            static_cast<std::uint32_t>(lists.minima.size()),
                            1});
  lists.minima.push_back(record.core.feature);
  return lost + block.dissipated.number(lane);
}

}  // namespace plekton::contact
