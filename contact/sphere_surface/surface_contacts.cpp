// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/surface_contacts.hpp"

#include "geometry/critical/descent.hpp"
#include "geometry/primitives/cell_clearance.hpp"

namespace plekton::contact {

double SurfaceContacts::rebuild(std::span<const geometry::IndexPair> keys,
                                std::span<const NearCells> near,
                                std::span<const geometry::CellId> cells,
                                std::span<const SphereBody> spheres,
                                std::span<const MaterialId> materials_of_structures,
                                const MaterialPairs& materials) {
  double lost = 0.0;
  const auto make = [&](std::size_t i, const Pair* old) {
    const SphereBody& sphere = spheres[static_cast<std::size_t>(keys[i].a)];
    const geometry::StructureId structure{keys[i].b};
    const double radius_b = surface_->radius(structure);
    const MaterialId material_b = materials_of_structures[index_of(structure)];
    const auto parameters = materials.combine(
        {sphere.material, sphere.radius, sphere.mass},
        {.material = material_b, .radius = radius_b, .shape = shape_of(*surface_, structure)});
    const double range = sphere.radius + radius_b;
    return Pair{sphere.radius,
                range,
                AnyLaw::without_attraction(parameters),
                AnyLaw::attraction(parameters),
                sphere.node,
                range + AnyLaw::interaction_range(parameters),
                near[i],
                old ? old->contacts : Range{},
                old ? old->single_face : kNoFace,
                {}};
  };
  rekey_(pairs_, keys, make, [&](const Pair& old) { lost += drop(old); });
  watch_.rebuild(cells);
  return lost;
}

double SurfaceContacts::drop(const Pair& pair) const {
  if (pair.contacts.count == 0) return 0.0;
  double lost = 0.0;
  for (const Contact& contact : contacts_of(pair, current_)) {
    lost += AnyLaw::history_energy(pair.parameters, contact.memory.history);
  }
  return lost;
}

EnergyLoss SurfaceContacts::advance(const Motion& motion, double dt, geometry::ThreadPool& pool) {
  const auto worker_count = static_cast<std::size_t>(pool.thread_count());
  while (workers_.size() < worker_count) workers_.emplace_back(*surface_);
  current_.swap(previous_);
  current_.resize(worker_count);
  previous_.resize(worker_count);
  for (Lists& lists : current_) {
    lists.contacts.clear();
    lists.minima.clear();
  }
  for (Worker& worker : workers_) {
    worker.pass_throughs = 0;
    make_room(worker.cells, watch_.cell_count());
  }
  records_.reset(pool.thread_count());
  watch_.begin_step(motion);
  return sum_(pairs_.size(), pool, [&](std::size_t begin, std::size_t end, int worker) {
    return advance_pairs(begin, end, motion, dt, worker);
  });
}

std::int64_t SurfaceContacts::pass_throughs() const noexcept {
  std::int64_t count = 0;
  for (const Worker& worker : workers_) count += worker.pass_throughs;
  return count;
}

std::size_t SurfaceContacts::touching() const noexcept {
  std::size_t count = 0;
  for (const Lists& lists : current_) count += lists.contacts.size();
  return count;
}

double SurfaceContacts::elastic_energy() const {
  double energy = 0.0;
  for (const Pair& pair : pairs_) {
    if (pair.contacts.count == 0) continue;
    for (const Contact& contact : contacts_of(pair, current_)) {
      energy +=
          contact.elastic_energy + AnyLaw::history_energy(pair.parameters, contact.memory.history);
    }
  }
  return energy;
}

// Most spheres in contact lie where they lay in the step before: on the inside of one facet, far
// from its sides. These go side by side; all others, and those that turn out to have moved on, one
// after the other, in the order of the list.

EnergyLoss SurfaceContacts::advance_pairs(std::size_t begin, std::size_t end, const Motion& motion,
                                          double dt, int worker_index) {
  Worker& worker = workers_[static_cast<std::size_t>(worker_index)];
  EnergyLoss loss;
  while (begin < end) {
    begin = find_jobs(begin, end, motion, worker);
    worker.lone.advance(motion, dt);
    for (const Job& job : worker.jobs) {
      Pair& pair = pairs_[job.pair];
      if (job.lane != kNoLane && worker.lone.answer(job.lane).is_right()) {
        loss.dissipated += keep_single_feature(pair, job.lane, worker_index);
        continue;
      }
      loss += advance_pair(pair, {worker.cells.data() + job.first_cell, job.cell_count}, motion, dt,
                           worker_index);
      pair.single_face = single_face_of(pair, current_);
    }
  }
  return loss;
}

/// Finds the pairs that are due, as long as there are lanes for those that may go side by side.
/// @returns the first pair that was not looked at
std::size_t SurfaceContacts::find_jobs(std::size_t begin, std::size_t end, const Motion& motion,
                                       Worker& worker) {
  worker.jobs.clear();
  worker.cells.clear();
  make_room(worker.jobs, end - begin);
  worker.lone.clear();
  std::size_t i = begin;
  for (; i < end; ++i) {
    Pair& pair = pairs_[i];
    if (watch_.is_deferred(pair.next_check)) continue;
    Job job{i, worker.cells.size(), 0, kNoLane};
    SideFlags sides = kNoSides;
    if (may_be_single_feature(pair, motion, job, sides, worker)) {
      job.lane = worker.lone.count();
      add_lane(pair, sides, worker);
    }
    if (job.cell_count > 0 || pair.contacts.count > 0) worker.jobs.push_back(job);
    if (worker.lone.count() == kSingleFeatureLanes) return i + 1;
  }
  return i;
}

/// Lists the cells that may be in range. @returns whether the pair is likely to touch the inside of
/// the same facet as in the last step, alone
/// @param sides  kNoSides; see are_beside()
bool SurfaceContacts::may_be_single_feature(Pair& pair, const Motion& motion, Job& job,
                                            SideFlags& sides, Worker& worker) {
  if (pair.single_face != kNoFace && watch_.is_known(pair.next_check) &&
      pair.next_check.count == 1) {
    worker.cells.push_back(geometry::id_at<geometry::CellId>(index_of(pair.single_face)));
    job.cell_count = 1;
    return true;
  }
  const Vec3& centre = motion.position[index_of(pair.node)];
  watch_.find(pair.near, centre, pair.reach, motion.position, pair.next_check, worker.cells);
  job.cell_count = worker.cells.size() - job.first_cell;
  return pair.single_face != kNoFace &&
         are_beside(*surface_, pair.single_face,
                    {worker.cells.data() + job.first_cell, job.cell_count}, centre, pair.reach,
                    motion.position, sides);
}

/// The facet whose inside is the only contact of a pair; none if there is no such facet, or the law
/// is not written for contacts side by side.
/// @param lists  with the contacts of the pair
geometry::FaceId SurfaceContacts::single_face_of(const Pair& pair,
                                                 const std::vector<Lists>& lists) const noexcept {
  if (pair.contacts.count != 1 || !pair.parameters.law->advance_single_feature) return kNoFace;
  const Contact& contact = contacts_of(pair, lists)[0];
  if (contact.minimum_count != 1) return kNoFace;
  const Feature minimum =
      lists[static_cast<std::size_t>(pair.contacts.worker)].minima[contact.first_minimum];
  return minimum.kind == geometry::FeatureKind::face ? geometry::FaceId{minimum.id} : kNoFace;
}

void SurfaceContacts::add_lane(const Pair& pair, const SideFlags& sides, Worker& worker) const {
  const auto& corners = surface_->nodes_of(pair.single_face);
  worker.single_faces[worker.lone.count()] = pair.single_face;
  worker.lone.add({{pair.node, corners[0], corners[1], corners[2]},
                   pair.radius,
                   pair.range,
                   &pair.parameters,
                   &contacts_of(pair, previous_)[0].memory,
                   sides});
}

/// Keeps the contact and its forces. @returns the energy (J) dissipated
double SurfaceContacts::keep_single_feature(Pair& pair, std::size_t lane, int worker_index) {
  const Worker& worker = workers_[static_cast<std::size_t>(worker_index)];
  const geometry::FaceId face = worker.single_faces[lane];
  const SingleFeatureAnswer& answer = worker.lone.answer(lane);
  const double gap = answer.gap();
  const std::int64_t id = contacts_of(pair, previous_)[0].id;
  Lists& lists = current_[static_cast<std::size_t>(worker_index)];
  pair.contacts = {worker_index, static_cast<std::uint32_t>(lists.contacts.size()), 1};
  // Member by member: what is copied as a whole right after it was written has to wait for that.
  SurfaceForce& record = records_.of_worker(worker_index).add(-gap / pair.radius);
  record.a = pair.node;
  record.share = 1.0F;
  record.core.nodes = surface_->nodes_of(face);
  record.core.weights = answer.weights();
  record.core.feature = Feature(face);
  const NormalPart normal = pair.normal();
  const PatchTermForce term_force{normal.elastic_force(gap), normal.attraction(gap), 1.0};
  record.force = term_force.pulled(answer.force_b(), answer.normal());
  record.torque_a = answer.torque_a();
  record.torque_b = answer.torque_b();
  record.elastic = term_force.elastic;
  record.pair = static_cast<std::uint32_t>(&pair - pairs_.data());
  record.contact = pair.contacts.first;

  Contact& contact = lists.contacts.emplace_back();
  answer.get_history(*pair.parameters.law, contact.memory.history);
  contact.memory.normal = answer.normal();
  contact.foot = answer.foot();
  contact.gap = gap;
  contact.elastic_force = record.elastic;
  contact.elastic_energy = normal.energy(gap);
  contact.id = id;
  contact.first_minimum = static_cast<std::uint32_t>(lists.minima.size());
  contact.minimum_count = 1;
  lists.minima.push_back(Feature(face));
  return answer.dissipated();
}

// What a step looks at before contacts of spheres with surfaces begin, and their forces as a
// function of the positions alone.

void SurfaceContacts::for_each_coming(double margin, std::span<const geometry::CellId> cells,
                                      Positions x, VisitComing visit) const {
  for (const Pair& pair : pairs_) {
    const Vec3& centre = x[index_of(pair.node)];
    const double range = pair.reach + margin;
    std::optional<geometry::SurfaceFoot> nearest;
    bool is_visited = false;  // the nearest one
    for (const geometry::CellId cell : cells.subspan(pair.near.first, pair.near.count)) {
      if (geometry::clearance(*surface_, cell, centre, range, x) > 0.0) continue;
      const geometry::Feature whole = surface_->feature_of(cell);
      const geometry::SurfaceFoot foot = geometry::foot_on(
          *surface_, geometry::closest_feature(*surface_, whole, centre, x), centre, x);
      const bool is_coming =
          foot.core.feature == whole && foot.distance >= pair.range && foot.distance < range;
      if (is_coming) visit(pair.node, foot.core, pair.parameters, pair.range);
      if (nearest && !(foot.distance < nearest->distance)) continue;
      nearest = foot;
      is_visited = is_coming;
    }
    if (pair.contacts.count == 0 && nearest && !is_visited && nearest->distance < range)
      visit(pair.node, nearest->core, pair.parameters, pair.range);
  }
}

void SurfaceContacts::add_elastic_forces(std::span<const geometry::CellId> cells, Positions x,
                                         NodeForces& forces, PatchFinder& finder,
                                         geometry::FunctionRef<bool(NodeId)> wants) const {
  for (const Pair& pair : pairs_) {
    if (pair.contacts.count == 0 || !wants(pair.node)) continue;
    const NormalPart elastic(pair.parameters, 0.0);
    const NormalLaw law(elastic, pair.range);
    for (const Patch& patch :
         finder.find(x[index_of(pair.node)], pair.reach,
                     cells.subspan(pair.near.first, pair.near.count), x, law)) {
      for (const PatchTerm& term : finder.terms(patch)) {
        const double force = term.weight * law.force(term.distance) + term.slope;
        const SurfaceForce record{
            pair.node, 0.0F, term.core, force * term.normal, Vec3::Zero(), Vec3::Zero(),
            force,     0,    0};
        record.add_to(forces, [](NodeId) { return true; });
      }
    }
  }
}

// One step of the contacts of one sphere with one surface.

EnergyLoss SurfaceContacts::advance_pair(Pair& pair, std::span<const geometry::CellId> cells,
                                         const Motion& motion, double dt, int worker_index) {
  Worker& worker = workers_[static_cast<std::size_t>(worker_index)];
  Lists& lists = current_[static_cast<std::size_t>(worker_index)];
  const Vec3& centre = motion.position[index_of(pair.node)];
  const NormalPart one = pair.normal();
  const auto patches =
      worker.patches.find(centre, pair.reach, cells, motion.position, NormalLaw(one, pair.range));

  const std::size_t first = lists.contacts.size();
  EnergyLoss loss;
  if (patches.size() == 1 && pair.contacts.count <= 1 &&
      is_single_feature(worker.patches.terms(patches.front()))) {
    loss = advance_alone(pair, patches[0], motion, dt, worker_index);
  } else {
    keep_sides(pair, patches, motion.position, worker);
    find_states(pair, patches, motion, worker);
    loss = transfer(pair, patches, motion, dt, worker);
    for (std::size_t j = 0; j < patches.size(); ++j) {
      const auto terms = worker.patches.terms(patches[j]);
      loss.dissipated +=
          add_contact(pair, terms, worker.states[j],
                      {worker.term_forces.data() + patches[j].first_term, terms.size()},
                      worker.transferred[j], dt, worker_index);
    }
  }
  const std::size_t count = lists.contacts.size() - first;
  pair.contacts = count == 0 ? Range{}
                             : Range{worker_index, static_cast<std::uint32_t>(first),
                                     static_cast<std::uint32_t>(count)};
  return loss;
}

/// Asks the law, and keeps the contact and its forces. @returns the energy (J) dissipated
double SurfaceContacts::add_contact(const Pair& pair, std::span<const PatchTerm> terms,
                                    const PatchState& state,
                                    std::span<const PatchTermForce> term_forces,
                                    const Transferred& transferred, double dt, int worker_index) {
  if (!(state.gap < 0.0) && !AnyLaw::holds(transferred.history))
    return loss_at_end<AnyLaw>(pair.parameters, {transferred.history, state.normal},
                               state.way_in(dt));
  Lists& lists = current_[static_cast<std::size_t>(worker_index)];
  const RelativeMotion relative = relative_motion(state.normal, state.gap, state.elastic_force,
                                                  state.relative_velocity, state.relative_spin);
  const auto first_minimum = static_cast<std::uint32_t>(lists.minima.size());
  for (const PatchTerm& term : terms) {
    if (term.is_minimum) lists.minima.push_back(term.core.feature);
  }
  AnyLaw::History next = transferred.history;
  const ContactForce result = AnyLaw::force(pair.parameters, relative, next, dt);
  lists.contacts.push_back({{next, state.normal},
                            state.foot,
                            state.gap,
                            state.elastic_force,
                            state.elastic_energy,
                            transferred.id,
                            first_minimum,
                            static_cast<std::uint32_t>(lists.minima.size()) - first_minimum});
  write_forces(pair, terms, state, result, term_forces, worker_index);
  return result.dissipated;
}

/// One patch of one term that follows at most one contact: the same as the general way.
EnergyLoss SurfaceContacts::advance_alone(const Pair& pair, const Patch& patch,
                                          const Motion& motion, double dt, int worker_index) {
  Worker& worker = workers_[static_cast<std::size_t>(worker_index)];
  const PatchTerm& term = worker.patches.terms(patch)[0];
  const NormalPart normal = pair.normal();
  const PatchState state =
      single_feature_state(term, normal, pair.node, pair.radius, pair.range, motion);
  Transferred transferred;
  EnergyLoss loss;
  for (const Contact& old : contacts_of(pair, previous_)) {
    const Feature* minima =
        previous_[static_cast<std::size_t>(pair.contacts.worker)].minima.data() + old.first_minimum;
    const bool stays = old.minimum_count == 1 && *minima == term.core.feature;
    if (!stays && worker.successors
                      .find({minima, old.minimum_count}, motion.position[index_of(pair.node)],
                            motion.position, {&patch, 1}, worker.patches)
                      .empty()) {
      loss.dissipated = loss_of(pair, old, motion, dt);
      continue;
    }
    worker.pass_throughs += is_turned_over(old.memory.normal, state.normal);
    AnyLaw::accumulate_history(
        transferred.history,
        carried_history<AnyLaw>(old.memory, state.normal, dt * state.twist_rate), 1.0);
    transferred.id = old.id;
    // Where it stays it is turned with its normal: what differs is rounding, and not counted side by
    // side either.
    if (!stays)
      loss.tracking = AnyLaw::history_energy(pair.parameters, old.memory.history) -
                      AnyLaw::history_energy(pair.parameters, transferred.history);
  }
  const PatchTermForce term_force{state.elastic_force, normal.attraction(state.gap), 1.0};
  loss.dissipated +=
      add_contact(pair, {&term, 1}, state, {&term_force, 1}, transferred, dt, worker_index);
  return loss;
}

void SurfaceContacts::find_states(const Pair& pair, std::span<const Patch> patches,
                                  const Motion& motion, Worker& worker) {
  worker.states.clear();
  worker.term_forces.clear();
  for (const Patch& patch : patches) {
    const auto terms = worker.patches.terms(patch);
    worker.term_forces.resize(patch.first_term + terms.size());
    const std::span<PatchTermForce> term_forces{worker.term_forces.data() + patch.first_term,
                                                terms.size()};
    worker.states.push_back(patch_state(
        patch, terms, pair.range, pair.normal(),
        [&](const PatchTerm& term, double elastic) {
          return pair.reach > pair.range ? term.weight * std::max(0.0, pair.reach - term.distance)
                                         : elastic;
        },
        term_forces));
    hold_where_nearest(worker.states.back(), terms, term_forces);
    set_kinematics(worker.states.back(), pair.node, pair.radius, pair.range, terms, term_forces,
                   motion);
  }
}

void SurfaceContacts::write_forces(const Pair& pair, std::span<const PatchTerm> terms,
                                   const PatchState& state, const ContactForce& answer,
                                   std::span<const PatchTermForce> term_forces, int worker) {
  auto& records = records_.of_worker(worker);
  const auto contact =
      static_cast<std::uint32_t>(current_[static_cast<std::size_t>(worker)].contacts.size() - 1);
  const Vec3 other_force = answer.force - state.elastic_force * state.normal;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Vec3 other = term_forces[i].share * other_force;
    const Vec3 lever_a = contact_lever(terms[i], pair.radius, pair.range);
    const Vec3 lever_b = lever_a - terms[i].distance * terms[i].normal;
    records.add(
        {pair.node, static_cast<float>(term_forces[i].share), terms[i].core,
         term_forces[i].pulled(term_forces[i].elastic * terms[i].normal + other, terms[i].normal),
         -lever_a.cross(other) - term_forces[i].share * answer.moment,
         lever_b.cross(other) + term_forces[i].share * answer.moment, term_forces[i].elastic,
         static_cast<std::uint32_t>(&pair - pairs_.data()), contact},
        -state.gap / pair.radius);
  }
}

}  // namespace plekton::contact
