// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/surface_contacts.hpp"

#include "contact/tracking/contact_state.hpp"
#include "contact/tracking/slip_state.hpp"
#include "geometry/critical/descent.hpp"
#include "geometry/primitives/cell_clearance.hpp"
#include "geometry/primitives/surface_change.hpp"

#include <optional>

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
                parameters,
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

// What becomes of the contacts of spheres with a surface that loses some of its elements.

double SurfaceContacts::follow(const geometry::SurfaceChange& change,
                               std::span<const geometry::CellId> cells, Positions at) {
  double lost = released_by(change, cells, at);
  for (Pair& pair : pairs_) {
    pair.single_face = kNoFace;
    if (pair.contacts.count > 0) lost += keep_minima(pair, change);
  }
  surface_ = &change.after();
  watch_ = DeferredPairs(*surface_);
  workers_.clear();
  return lost;
}

/// Elastic energy (J) of normal forces before, minus what it is afterwards, where the nodes are at
/// a moment. Only pairs with a cell that is gone have changed: a feature in range has all its cells
/// in the list.
double SurfaceContacts::released_by(const geometry::SurfaceChange& change,
                                    std::span<const geometry::CellId> cells, Positions at) const {
  PatchFinder before(change.before());
  PatchFinder after(change.after());
  double released = 0.0;
  std::vector<geometry::CellId> left;
  for (const Pair& pair : pairs_) {
    const auto near = cells.subspan(pair.near.first, pair.near.count);
    if (std::all_of(near.begin(), near.end(),
                    [&](geometry::CellId cell) { return change.now(cell).has_value(); }))
      continue;
    left.clear();
    for (const geometry::CellId cell : near) {
      const auto of_cell = change.left_of(cell);
      left.insert(left.end(), of_cell.begin(), of_cell.end());
    }
    std::sort(left.begin(), left.end());
    left.erase(std::unique(left.begin(), left.end()), left.end());
    released += normal_energy(pair, before, near, at) - normal_energy(pair, after, left, at);
  }
  return released;
}

double SurfaceContacts::normal_energy(const Pair& pair, PatchFinder& finder,
                                      std::span<const geometry::CellId> cells, Positions x) {
  if (cells.empty()) return 0.0;
  const NormalPart one{&pair};
  const Vec3& centre = x[index_of(pair.node)];
  double energy = 0.0;
  for (const Patch& patch : finder.find(centre, pair.reach, cells, x, NormalLaw(one))) {
    for (const PatchTerm& term : finder.terms(patch))
      energy += term.weight * one.energy(term.distance) + term.energy;
  }
  return energy;
}

/// A contact goes on from the minima that are left; without any nothing follows it. @returns the
/// energy (J) of the histories that are lost
double SurfaceContacts::keep_minima(const Pair& pair, const geometry::SurfaceChange& change) {
  double lost = 0.0;
  Lists& lists = current_[static_cast<std::size_t>(pair.contacts.worker)];
  for (std::uint32_t i = 0; i < pair.contacts.count; ++i) {
    Contact& contact = lists.contacts[pair.contacts.first + i];
    Feature* const minima = lists.minima.data() + contact.first_minimum;
    std::uint32_t left = 0;
    for (std::uint32_t m = 0; m < contact.minimum_count; ++m) {
      if (const auto minimum = change.now(minima[m])) minima[left++] = *minimum;
    }
    contact.minimum_count = left;
    if (left == 0) lost += forget<AnyLaw>(pair.parameters, contact.memory, 0.0);
  }
  return lost;
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
  record.force = answer.force_b();
  record.torque_a = answer.torque_a();
  record.torque_b = answer.torque_b();
  record.elastic = AnyLaw::elastic_normal_force(pair.parameters, gap);
  record.pair = static_cast<std::uint32_t>(&pair - pairs_.data());
  record.contact = pair.contacts.first;

  Contact& contact = lists.contacts.emplace_back();
  answer.get_history(*pair.parameters.law, contact.memory.history);
  contact.memory.normal = answer.normal();
  contact.foot = answer.foot();
  contact.gap = gap;
  contact.elastic_force = record.elastic;
  contact.elastic_energy = AnyLaw::elastic_normal_energy(pair.parameters, gap);
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
    const NormalPart one{&pair};
    for (const Patch& patch :
         finder.find(x[index_of(pair.node)], pair.reach,
                     cells.subspan(pair.near.first, pair.near.count), x, NormalLaw(one))) {
      for (const PatchTerm& term : finder.terms(patch)) {
        const double force = term.weight * one.force(term.distance) + term.slope;
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
  const NormalPart one{&pair};
  const auto patches =
      worker.patches.find(centre, pair.reach, cells, motion.position, NormalLaw(one));

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

double SurfaceContacts::loss_at_end(const Pair& pair, const AnyLaw::History& history,
                                    double parting) {
  return AnyLaw::history_energy(pair.parameters, history) + AnyLaw::loss_after(history, parting);
}

double SurfaceContacts::loss_at_end(const Pair& pair, const Contact& old, const Motion& motion,
                                    double dt) const {
  if (old.minimum_count == 0) return loss_at_end(pair, old.memory.history, 0.0);
  const Feature minimum =
      previous_[static_cast<std::size_t>(pair.contacts.worker)].minima[old.first_minimum];
  const std::size_t ball = index_of(pair.node);
  const Positions x = motion.position;
  const geometry::SurfaceFoot foot = geometry::foot_on(
      *surface_, geometry::closest_feature(*surface_, minimum, x[ball], x), x[ball], x);
  const Vec3 velocity = velocity_at(foot.core, Vec3::Zero(), motion) - motion.velocity[ball];
  return loss_at_end(pair, old.memory.history, dt * velocity.dot(old.memory.normal));
}

/// Asks the law, and keeps the contact and its forces. @returns the energy (J) dissipated
double SurfaceContacts::add_contact(const Pair& pair, std::span<const PatchTerm> terms,
                                    const PatchState& state,
                                    std::span<const PatchTermForce> term_forces,
                                    const Transferred& transferred, double dt, int worker_index) {
  if (!(state.gap < 0.0) && !AnyLaw::holds(transferred.history))
    return loss_at_end(pair, transferred.history, dt * state.relative_velocity.dot(state.normal));
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
  const PatchState state = single_feature_state<AnyLaw>(term, pair.parameters, pair.node,
                                                        pair.radius, pair.range, motion);
  Transferred transferred;
  EnergyLoss loss;
  for (const Contact& old : contacts_of(pair, previous_)) {
    const double stored = AnyLaw::history_energy(pair.parameters, old.memory.history);
    const Feature* minima =
        previous_[static_cast<std::size_t>(pair.contacts.worker)].minima.data() + old.first_minimum;
    const bool stays = old.minimum_count == 1 && *minima == term.core.feature;
    if (!stays && worker.successors
                      .find({minima, old.minimum_count}, motion.position[index_of(pair.node)],
                            motion.position, {&patch, 1}, worker.patches)
                      .empty()) {
      loss.dissipated = loss_at_end(pair, old, motion, dt);
      continue;
    }
    loss.tracking = stored;
    worker.pass_throughs += is_turned_over(old.memory.normal, state.normal);
    AnyLaw::accumulate_history(
        transferred.history,
        carried_history<AnyLaw>(old.memory, state.normal, dt * state.twist_rate), 1.0);
    transferred.id = old.id;
  }
  loss.tracking -= AnyLaw::history_energy(pair.parameters, transferred.history);
  const PatchTermForce term_force{state.elastic_force, 1.0};
  loss.dissipated +=
      add_contact(pair, {&term, 1}, state, {&term_force, 1}, transferred, dt, worker_index);
  return loss;
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
        patch, terms, pair.range,
        [&](double gap) { return AnyLaw::elastic_normal_force(pair.parameters, gap); },
        [&](double gap) { return AnyLaw::elastic_normal_energy(pair.parameters, gap); },
        [&](const PatchTerm& term, double elastic) {
          return pair.reach > pair.range ? term.weight * std::max(0.0, pair.reach - term.distance)
                                         : elastic;
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
      loss.dissipated += loss_at_end(pair, old, motion, dt);
    else
      loss.tracking += AnyLaw::history_energy(pair.parameters, old.memory.history);
    double total = 0.0;
    for (const std::uint32_t successor : successors)
      total += worker.states[successor].elastic_force;
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
      const double share =
          total > 0.0 ? state.elastic_force / total : 1.0 / static_cast<double>(successors.size());
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
         term_forces[i].elastic * terms[i].normal + other,
         -lever_a.cross(other) - term_forces[i].share * answer.moment,
         lever_b.cross(other) + term_forces[i].share * answer.moment, term_forces[i].elastic,
         static_cast<std::uint32_t>(&pair - pairs_.data()), contact},
        -state.gap / pair.radius);
  }
}

// Contacts of spheres with surfaces as they are reported.

void SurfaceContacts::assign_ids(std::int64_t& last) {
  for (Lists& lists : current_) {
    for (Contact& contact : lists.contacts) {
      if (contact.id == 0) contact.id = ++last;
    }
  }
}

void SurfaceContacts::for_each_record(Positions x, VisitRecord visit) const {
  for (std::size_t w = 0; w < records_.lists().size(); ++w) {
    const auto& list = records_.lists()[w];
    const std::span<const SurfaceForce> records{list.records.data(), list.count};
    for (std::size_t begin = 0; begin < records.size();) {
      const std::uint32_t contact = records[begin].contact;
      std::size_t end = begin + 1;
      while (end < records.size() && records[end].contact == contact) ++end;
      visit(row_of(records.subspan(begin, end - begin), current_[w].contacts[contact], x));
      begin = end;
    }
  }
}

/// The sum of what its terms do, so that all rows together do what has been done to the nodes.
/// @param records  of the contact; the first is that of the deepest minimum
ContactRecord SurfaceContacts::row_of(std::span<const SurfaceForce> records, const Contact& contact,
                                      Positions x) const {
  const SurfaceForce& deepest = records.front();
  const Pair& pair = pairs_[deepest.pair];
  const geometry::IndexPair& key = rekey_.key(deepest.pair);
  Vec3 force = Vec3::Zero();
  Vec3 torque = Vec3::Zero();  // on the sphere, about its centre
  for (const SurfaceForce& record : records) {
    force += record.force;
    torque += record.torque_a;
  }
  const double distance = pair.range + contact.gap;
  const Vec3 lever = distance > 0.0
                         ? Vec3((pair.radius + 0.5 * contact.gap) / distance * contact.foot)
                         : Vec3(Vec3::Zero());
  const Vec3& centre = x[index_of(pair.node)];
  ContactRecord row;
  row.id = contact.id;
  row.a = {BodyKind::sphere, key.a, Feature(pair.node)};
  row.b = {BodyKind::structure, key.b, deepest.core.feature};
  row.point_a = centre;
  row.point_b = centre + contact.foot;
  row.point = centre + lever;
  row.normal = contact.memory.normal;
  row.gap = contact.gap;
  set_force(row, force);
  row.moment = records.size() > 1 ? Vec3(-torque - lever.cross(force))
                                  : AnyLaw::moment(contact.memory.history, row.normal);
  set_state<AnyLaw>(row, pair.parameters, contact.memory.history, contact.elastic_force);
  return row;
}

// The state: contacts in the order of their pairs, whichever thread had them.

void SurfaceContacts::exchange(const geometry::StateArchive& archive,
                               geometry::FunctionRef<void()> list, geometry::ThreadPool& pool) {
  double overlap_ratio = largest_overlap_ratio();
  archive("largest_overlap_ratio", overlap_ratio);
  std::vector<KeptContact> contacts;
  std::vector<KeptForce> forces;
  if (archive.is_reading()) {
    begin_anew(list, pool);
  } else {
    contacts = kept_contacts();
    forces = kept_forces();
  }
  std::size_t place = 0;
  std::vector<std::uint32_t> pairs;  // by contact
  archive.rows("contacts", contacts, [&](geometry::RowFields& row, KeptContact& kept) {
    place = exchange_contact(row, kept, place);
    if (row.is_reading()) keep(kept, place);
    pairs.push_back(static_cast<std::uint32_t>(place));
  });
  archive.rows("forces", forces, [&](geometry::RowFields& row, KeptForce& kept) {
    row("contact", kept.contact);
    row.require(kept.contact < pairs.size(), "contact");
    SurfaceForce& record = kept.record;
    contact::exchange(row, "core", record.core, *surface_);
    row("force", record.force);
    row("torque_a", record.torque_a);
    row("torque_b", record.torque_b);
    row("elastic", record.elastic);
    double share = record.share;
    row("share", share);
    record.share = static_cast<float>(share);
    if (!row.is_reading()) return;
    record.pair = pairs[kept.contact];
    record.contact = kept.contact;
    record.a = pairs_[record.pair].node;
    records_.of_worker(0).add(record, overlap_ratio);
  });
  if (archive.is_reading()) find_single_faces();
}

/// Of pairs without contacts.
void SurfaceContacts::begin_anew(geometry::FunctionRef<void()> list, geometry::ThreadPool& pool) {
  rekey_(
      pairs_, {}, [](std::size_t, const Pair*) { return Pair{}; }, [](const Pair&) {});
  list();
  current_.assign(1, {});
  records_.reset(pool.thread_count());
}

void SurfaceContacts::find_single_faces() {
  for (Pair& pair : pairs_)
    if (pair.contacts.count > 0) pair.single_face = single_face_of(pair, current_);
}

void SurfaceContacts::take_over(const SurfaceContacts& before, std::span<const std::int32_t> places,
                                geometry::FunctionRef<void()> list, geometry::ThreadPool& pool) {
  begin_anew(list, pool);
  struct Now {
    std::size_t pair;
    std::uint32_t contact;
  };
  std::vector<std::optional<Now>> now;  // by contact of before
  std::size_t place = 0;
  for (KeptContact& kept : before.kept_contacts()) {
    now.emplace_back();
    const geometry::IndexPair key{places[static_cast<std::size_t>(kept.pair[0])], kept.pair[1]};
    if (key.a < 0) continue;
    place = next_place(place, pairs_.size(), [&](std::size_t i) { return rekey_.key(i) < key; });
    if (place == pairs_.size() || rekey_.key(place) != key) continue;
    require_same_law(kept.contact.memory.history, pairs_[place].parameters.law);
    now.back() = {place, static_cast<std::uint32_t>(current_[0].contacts.size())};
    keep(kept, place);
  }
  for (KeptForce& kept : before.kept_forces()) {
    const std::optional<Now>& of = now[kept.contact];
    if (!of) continue;
    kept.record.pair = static_cast<std::uint32_t>(of->pair);
    kept.record.contact = of->contact;
    kept.record.a = pairs_[of->pair].node;
    records_.of_worker(0).add(kept.record, before.largest_overlap_ratio());
  }
  find_single_faces();
}

/// Among all, that of a worker.
std::uint32_t SurfaceContacts::first_contact(std::size_t worker) const noexcept {
  std::size_t count = 0;
  for (std::size_t w = 0; w < worker; ++w) count += current_[w].contacts.size();
  return static_cast<std::uint32_t>(count);
}

std::vector<SurfaceContacts::KeptContact> SurfaceContacts::kept_contacts() const {
  std::vector<KeptContact> kept(touching());
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Pair& pair = pairs_[i];
    if (pair.contacts.count == 0) continue;
    const auto worker = static_cast<std::size_t>(pair.contacts.worker);
    const std::uint32_t first = first_contact(worker) + pair.contacts.first;
    for (std::uint32_t k = 0; k < pair.contacts.count; ++k) {
      const Contact& contact = current_[worker].contacts[pair.contacts.first + k];
      const Feature* const minima = current_[worker].minima.data() + contact.first_minimum;
      kept[first + k] = {
          {rekey_.key(i).a, rekey_.key(i).b}, contact, {minima, minima + contact.minimum_count}};
    }
  }
  return kept;
}

std::vector<SurfaceContacts::KeptForce> SurfaceContacts::kept_forces() const {
  std::vector<KeptForce> kept;
  for (std::size_t w = 0; w < records_.lists().size(); ++w) {
    const auto& list = records_.lists()[w];
    for (std::size_t i = 0; i < list.count; ++i)
      kept.push_back({first_contact(w) + list.records[i].contact, list.records[i]});
  }
  return kept;
}

/// @param from  place in the list of the pair of the contact before
/// @returns that of this one
std::size_t SurfaceContacts::exchange_contact(geometry::RowFields& row, KeptContact& kept,
                                              std::size_t from) const {
  row("pair", kept.pair);
  const geometry::IndexPair key{kept.pair[0], kept.pair[1]};
  const std::size_t place =
      next_place(from, pairs_.size(), [&](std::size_t i) { return rekey_.key(i) < key; });
  if (place == pairs_.size() || rekey_.key(place) != key) throw_unlisted_contact();
  Contact& contact = kept.contact;
  contact::exchange(row, contact.memory, pairs_[place].parameters.law);
  row("foot", contact.foot);
  row("gap", contact.gap);
  row("elastic_force", contact.elastic_force);
  row("elastic_energy", contact.elastic_energy);
  row("id", contact.id);
  row("minima", kept.minima);
  row.require(std::all_of(kept.minima.begin(), kept.minima.end(),
                          [&](const Feature& minimum) { return has(*surface_, minimum); }),
              "minima");
  return place;
}

/// As the next contact of its pair.
void SurfaceContacts::keep(const KeptContact& kept, std::size_t place) {
  Lists& lists = current_[0];
  Range& range = pairs_[place].contacts;
  if (range.count == 0) range = {0, static_cast<std::uint32_t>(lists.contacts.size()), 0};
  ++range.count;
  lists.contacts.push_back(kept.contact);
  lists.contacts.back().first_minimum = static_cast<std::uint32_t>(lists.minima.size());
  lists.contacts.back().minimum_count = static_cast<std::uint32_t>(kept.minima.size());
  lists.minima.insert(lists.minima.end(), kept.minima.begin(), kept.minima.end());
}

}  // namespace plekton::contact
