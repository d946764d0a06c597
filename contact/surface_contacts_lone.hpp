// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_contacts.hpp"

/// Most balls in contact lie where they lay in the step before: on the inside of one facet, far
/// from its sides. These go side by side; all others, and those that turn out to have moved on, one
/// after the other (surface_contacts_step.hpp), in the order of the list.
namespace plekton::contact {

template <ContactLaw Law>
EnergyLoss SurfaceContacts<Law>::advance_pairs(std::size_t begin, std::size_t end,
                                               const Motion& motion, double dt, int worker_index) {
  Worker& worker = workers_[static_cast<std::size_t>(worker_index)];
  EnergyLoss loss;
  while (begin < end) {
    begin = find_jobs(begin, end, motion, worker);
    if constexpr (LaneLaw<Law>) advance_side_by_side(worker.lone.block, motion, dt);
    for (const Job& job : worker.jobs) {
      Pair& pair = pairs_[job.pair];
      if constexpr (LaneLaw<Law>) {
        if (job.lane != kNoLane && worker.lone.block.is_right(job.lane)) {
          loss.dissipated += keep_lone(pair, job.lane, worker_index);
          continue;
        }
      }
      loss += advance_pair(pair, {worker.cells.data() + job.first_cell, job.cell_count}, motion, dt,
                           worker_index);
      if constexpr (LaneLaw<Law>) pair.lone_face = lone_face_of(pair, current_);
    }
  }
  return loss;
}

/// Finds the pairs that are awake, as long as there are lanes for those that may go side by side.
/// @returns the first pair that was not looked at
template <ContactLaw Law>
std::size_t SurfaceContacts<Law>::find_jobs(std::size_t begin, std::size_t end,
                                            const Motion& motion, Worker& worker) {
  worker.jobs.clear();
  worker.cells.clear();
  make_room(worker.jobs, end - begin);
  if constexpr (LaneLaw<Law>) worker.lone.block.clear();
  std::size_t i = begin;
  for (; i < end; ++i) {
    Pair& pair = pairs_[i];
    if (watch_.is_asleep(pair.awake)) continue;
    Job job{i, worker.cells.size(), 0, kNoLane};
    SideFlags sides = kNoSides;
    if (may_be_lone(pair, motion, job, sides, worker)) {
      if constexpr (LaneLaw<Law>) {
        job.lane = worker.lone.block.count();
        add_lane(pair, sides, worker);
      }
    }
    if (job.cell_count > 0 || pair.contacts.count > 0) worker.jobs.push_back(job);
    if constexpr (LaneLaw<Law>) {
      if (worker.lone.block.count() == kLoneLanes) return i + 1;
    }
  }
  return i;
}

/// Lists the cells that may be in range. @returns whether the pair is likely to touch the inside of
/// the same facet as in the last step, alone
/// @param sides  kNoSides; see are_beside()
template <ContactLaw Law>
bool SurfaceContacts<Law>::may_be_lone(Pair& pair, const Motion& motion, Job& job, SideFlags& sides,
                                       Worker& worker) {
  if (pair.lone_face != kNoFace && watch_.is_known(pair.awake) && pair.awake.count == 1) {
    worker.cells.push_back(geometry::id_at<geometry::CellId>(index_of(pair.lone_face)));
    job.cell_count = 1;
    return true;
  }
  const Vec3& centre = motion.position[index_of(pair.node)];
  watch_.find(pair.near, centre, pair.reach, motion.position, pair.awake, worker.cells);
  job.cell_count = worker.cells.size() - job.first_cell;
  return pair.lone_face != kNoFace &&
         are_beside(*surface_, pair.lone_face,
                    {worker.cells.data() + job.first_cell, job.cell_count}, centre, pair.reach,
                    motion.position, sides);
}

/// The facet whose inside is the only contact of a pair; none if there is no such facet.
/// @param lists  with the contacts of the pair
template <ContactLaw Law>
geometry::FaceId SurfaceContacts<Law>::lone_face_of(
    const Pair& pair, const std::vector<Lists>& lists) const noexcept {
  if (pair.contacts.count != 1) return kNoFace;
  const Contact& contact = contacts_of(pair, lists)[0];
  if (contact.minimum_count != 1) return kNoFace;
  const Feature minimum =
      lists[static_cast<std::size_t>(pair.contacts.worker)].minima[contact.first_minimum];
  return minimum.kind == geometry::FeatureKind::face ? geometry::FaceId{minimum.id} : kNoFace;
}

template <ContactLaw Law>
void SurfaceContacts<Law>::add_lane(const Pair& pair, const SideFlags& sides,
                                    Worker& worker) const requires LaneLaw<Law> {
  LonePairs<Law>& lone = worker.lone;
  const auto& corners = surface_->nodes_of(pair.lone_face);
  lone.face[lone.block.count()] = pair.lone_face;
  const Contact& last = contacts_of(pair, previous_)[0];
  static_assert(sizeof(Pair) >= LoneBlock<Law>::kReadOfPair * sizeof(double));
  static_assert(sizeof(Contact) >= LoneBlock<Law>::kReadOfMemory * sizeof(double));
  lone.block.add({pair.node, corners[0], corners[1], corners[2]},
                 reinterpret_cast<const double*>(&pair),
                 reinterpret_cast<const double*>(&last.memory), sides);
}

/// Keeps the contact and its forces. @returns the energy (J) dissipated
template <ContactLaw Law>
double SurfaceContacts<Law>::keep_lone(Pair& pair, std::size_t lane,
                                       int worker_index) requires LaneLaw<Law> {
  const LonePairs<Law>& lone = workers_[static_cast<std::size_t>(worker_index)].lone;
  const geometry::FaceId face = lone.face[lane];
  const auto& answer = lone.block.answer(lane);
  const double gap = answer.gap;
  SurfaceForce& record = records_.of_worker(worker_index).add(-gap / pair.radius);
  record.a = pair.node;
  record.core = {surface_->nodes_of(face), answer.weights, Feature(face)};
  record.force = answer.force_b;
  record.torque_a = answer.torque_a;
  record.torque_b = answer.torque_b;
  record.elastic = Law::elastic_normal_force(pair.parameters, gap);
  record.pair = static_cast<std::uint32_t>(&pair - pairs_.data());

  const std::int64_t id = contacts_of(pair, previous_)[0].id;
  Lists& lists = current_[static_cast<std::size_t>(worker_index)];
  pair.contacts = {worker_index, static_cast<std::uint32_t>(lists.contacts.size()), 1};
  record.contact = pair.contacts.first;
  lists.contacts.push_back({{answer.memory.history, answer.memory.normal},
                            answer.foot,
                            gap,
                            record.elastic,
                            Law::elastic_normal_energy(pair.parameters, gap),
                            id,
                            static_cast<std::uint32_t>(lists.minima.size()),
                            1});
  lists.minima.push_back(record.core.feature);
  return answer.dissipated;
}

}  // namespace plekton::contact
