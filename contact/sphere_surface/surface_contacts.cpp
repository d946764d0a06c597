// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/surface_contacts.hpp"

#include "contact/sphere_surface/single_feature_contact.hpp"
#include "contact/sphere_surface/surface_contact_row.hpp"
#include "contact/sphere_surface/surface_contacts_state.hpp"
#include "contact/tracking/contact_state.hpp"
#include "geometry/critical/descent.hpp"
#include "geometry/primitives/cell_clearance.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

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
    return Pair{
        {near[i],
         old ? old->contacts : PatchContacts::Range{},
         old ? old->single_face : kNoFace,
         {}},
        {sphere.radius, range, range + AnyLaw::interaction_range(parameters),
         AnyLaw::attraction(parameters), sphere.node, AnyLaw::without_attraction(parameters)}};
  };
  rekey_(pairs_, keys, make, [&](const Pair& old) { lost += drop(old); });
  watch_.rebuild(cells);
  return lost;
}

double SurfaceContacts::drop(const Pair& pair) const {
  if (pair.contacts.count == 0) return 0.0;
  double lost = 0.0;
  for (const PatchContact& contact : current_.contacts_of(pair.contacts)) {
    lost += AnyLaw::history_energy(pair.parameters, contact.memory.history);
  }
  return lost;
}

EnergyLoss SurfaceContacts::advance(const Motion& motion, double dt, geometry::ThreadPool& pool) {
  const auto worker_count = static_cast<std::size_t>(pool.thread_count());
  while (workers_.size() < worker_count) workers_.emplace_back(*surface_);
  std::swap(current_, previous_);
  current_.resize(worker_count);
  previous_.resize(worker_count);
  current_.clear();
  for (Worker& worker : workers_) {
    worker.histories.begin_step();
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
  for (const Worker& worker : workers_) count += worker.histories.pass_throughs();
  return count;
}

double SurfaceContacts::elastic_energy() const {
  double energy = 0.0;
  for (const Pair& pair : pairs_) {
    if (pair.contacts.count == 0) continue;
    for (const PatchContact& contact : current_.contacts_of(pair.contacts)) {
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
      pair.single_face = single_face_of(pair);
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
    ask_ahead(i, end);
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
geometry::FaceId SurfaceContacts::single_face_of(const Pair& pair) const noexcept {
  if (pair.contacts.count != 1 || !pair.parameters.law->advance_single_feature) return kNoFace;
  const ContactsOfPair now = current_.of(pair.contacts);
  const auto minima = now.minima_of(now.contacts[0]);
  if (minima.size() != 1) return kNoFace;
  const Feature minimum = minima[0];
  return minimum.kind == geometry::FeatureKind::face ? geometry::FaceId{minimum.id} : kNoFace;
}

void SurfaceContacts::add_lane(const Pair& pair, const SideFlags& sides, Worker& worker) const {
  const auto& corners = surface_->nodes_of(pair.single_face);
  worker.single_faces[worker.lone.count()] = pair.single_face;
  worker.lone.add({{pair.node, corners[0], corners[1], corners[2]},
                   pair.radius,
                   pair.range,
                   &pair.parameters,
                   &previous_.contacts_of(pair.contacts)[0].memory,
                   sides});
}

/// Keeps the contact and its forces. @returns the energy (J) dissipated
double SurfaceContacts::keep_single_feature(Pair& pair, std::size_t lane, int worker_index) {
  const Worker& worker = workers_[static_cast<std::size_t>(worker_index)];
  const geometry::FaceId face = worker.single_faces[lane];
  const SingleFeatureAnswer& answer = worker.lone.answer(lane);
  const double gap = answer.gap();
  const std::int64_t id = previous_.contacts_of(pair.contacts)[0].id;
  PatchContacts::List& list = current_.of_worker(worker_index);
  pair.contacts = {worker_index, static_cast<std::uint32_t>(list.contacts.size()), 1};
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

  PatchContact& contact = list.contacts.add();
  answer.get_history(*pair.parameters.law, contact.memory.history);
  contact.memory.normal = answer.normal();
  contact.foot = answer.foot();
  contact.gap = gap;
  contact.elastic_force = record.elastic;
  contact.elastic_energy = normal.energy(gap);
  contact.id = id;
  contact.first_minimum = static_cast<std::uint32_t>(list.minima.size());
  contact.minimum_count = 1;
  list.minima.push_back(Feature(face));
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
    contact::add_elastic_forces(pair, finder, cells.subspan(pair.near.first, pair.near.count), x,
                                forces);
  }
}

// One step of the contacts of one sphere with one surface.

EnergyLoss SurfaceContacts::advance_pair(Pair& pair, std::span<const geometry::CellId> cells,
                                         const Motion& motion, double dt, int worker_index) {
  Worker& worker = workers_[static_cast<std::size_t>(worker_index)];
  const Vec3& centre = motion.position[index_of(pair.node)];
  const NormalPart one = pair.normal();
  const auto patches =
      worker.patches.find(centre, pair.reach, cells, motion.position, NormalLaw(one, pair.range));

  const auto& contacts = current_.of_worker(worker_index).contacts;
  const std::size_t first = contacts.size();
  const bool is_alone = patches.size() == 1 && pair.contacts.count <= 1 &&
                        is_single_feature(worker.patches.terms(patches.front()));
  const PatchesOfPair now{pair, patches, worker.patches};
  const EnergyLoss loss = is_alone ? advance_alone(pair, now, motion, dt, worker_index)
                                   : advance_patches(pair, now, motion, dt, worker_index);
  const std::size_t count = contacts.size() - first;
  pair.contacts = count == 0 ? PatchContacts::Range{}
                             : PatchContacts::Range{worker_index, static_cast<std::uint32_t>(first),
                                                    static_cast<std::uint32_t>(count)};
  return loss;
}

EnergyLoss SurfaceContacts::advance_patches(const Pair& pair, const PatchesOfPair& now,
                                            const Motion& motion, double dt, int worker_index) {
  Worker& worker = workers_[static_cast<std::size_t>(worker_index)];
  const ContactsOfPair last = previous_.of(pair.contacts);
  worker.histories.keep_sides(now, last, motion.position);
  find_states(now, motion, worker);
  EnergyLoss loss = worker.histories.to_patches(now, last, worker.states, motion, dt);
  for (std::size_t j = 0; j < now.patches.size(); ++j) {
    const auto terms = now.finder.terms(now.patches[j]);
    loss.dissipated +=
        add_contact(pair, terms, worker.states[j],
                    {worker.term_forces.data() + now.patches[j].first_term, terms.size()},
                    worker.histories.of_patch(j), dt, worker_index);
  }
  return loss;
}

/// One patch of one term that follows at most one contact: the same as the general way.
EnergyLoss SurfaceContacts::advance_alone(const Pair& pair, const PatchesOfPair& now,
                                          const Motion& motion, double dt, int worker_index) {
  Worker& worker = workers_[static_cast<std::size_t>(worker_index)];
  const PatchTerm& term = now.finder.terms(now.patches[0])[0];
  const NormalPart normal = pair.normal();
  const PatchState state =
      single_feature_state(term, normal, pair.node, pair.radius, pair.range, motion);
  Transferred transferred;
  EnergyLoss loss = worker.histories.to_single_feature(now, previous_.of(pair.contacts), state,
                                                       motion, dt, transferred);
  const PatchTermForce term_force{state.elastic_force, normal.attraction(state.gap), 1.0};
  loss.dissipated +=
      add_contact(pair, {&term, 1}, state, {&term_force, 1}, transferred, dt, worker_index);
  return loss;
}

/// Asks the law, and keeps the contact and its forces. @returns the energy (J) dissipated
double SurfaceContacts::add_contact(const Pair& pair, std::span<const PatchTerm> terms,
                                    const PatchState& state,
                                    std::span<const PatchTermForce> term_forces,
                                    const Transferred& transferred, double dt, int worker_index) {
  if (!(state.gap < 0.0) && !AnyLaw::holds(transferred.history))
    return loss_at_end<AnyLaw>(pair.parameters, {transferred.history, state.normal},
                               state.displacement_in(dt));
  PatchContacts::List& list = current_.of_worker(worker_index);
  const RelativeMotion relative = relative_motion(state.normal, state.gap, state.elastic_force,
                                                  state.relative_velocity, state.relative_spin);
  const auto first_minimum = static_cast<std::uint32_t>(list.minima.size());
  for (const PatchTerm& term : terms) {
    if (term.is_minimum) list.minima.push_back(term.core.feature);
  }
  AnyLaw::History next = transferred.history;
  const ContactForce result = AnyLaw::force(pair.parameters, relative, next, dt);
  list.contacts.add() = {{next, state.normal},
                         state.foot,
                         state.gap,
                         state.elastic_force,
                         state.elastic_energy,
                         transferred.id,
                         first_minimum,
                         static_cast<std::uint32_t>(list.minima.size()) - first_minimum};
  write_forces(pair, terms, state, result, term_forces, worker_index);
  return result.dissipated;
}

void SurfaceContacts::find_states(const PatchesOfPair& now, const Motion& motion, Worker& worker) {
  const SphereSurfacePair& pair = now.pair;
  worker.states.clear();
  worker.term_forces.clear();
  for (const Patch& patch : now.patches) {
    const auto terms = now.finder.terms(patch);
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
  const auto contact = static_cast<std::uint32_t>(current_.of_worker(worker).contacts.size() - 1);
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

// What becomes of the contacts where the surface loses some of its elements.

double SurfaceContacts::follow(const geometry::SurfaceChange& change,
                               std::span<const geometry::CellId> cells, Positions at) {
  double lost = released_by(change, cells, at);
  for (Pair& pair : pairs_) {
    pair.single_face = kNoFace;
    if (pair.contacts.count > 0) lost += current_.follow(pair.contacts, pair.parameters, change);
  }
  // What the last step did where elements are gone is not told any more.
  records_.keep_if([&](SurfaceForce& record) {
    const auto now = change.now(record.core.feature);
    if (now) record.core.feature = *now;
    return now.has_value();
  });
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

// As contacts are reported.

void SurfaceContacts::for_each_record(Positions x, VisitRecord visit) const {
  for (std::size_t w = 0; w < records_.lists().size(); ++w) {
    const auto& list = records_.lists()[w];
    const std::span<const SurfaceForce> records{list.records.data(), list.records.size()};
    for (std::size_t begin = 0; begin < records.size();) {
      const std::uint32_t contact = records[begin].contact;
      std::size_t end = begin + 1;
      while (end < records.size() && records[end].contact == contact) ++end;
      const std::uint32_t pair = records[begin].pair;
      visit(row_of(pairs_[pair], rekey_.key(pair),
                   current_.of_worker(static_cast<int>(w)).contacts[contact],
                   records.subspan(begin, end - begin), x));
      begin = end;
    }
  }
}

// The state.

void SurfaceContacts::exchange(const geometry::StateArchive& archive,
                               geometry::FunctionRef<void()> list, geometry::ThreadPool& pool) {
  SurfaceContactsState all;
  if (archive.is_reading())
    begin_anew(list, pool);
  else
    all = state();
  std::size_t place = 0;
  all.exchange(archive, *surface_, [&](const geometry::IndexPair& key) {
    if (!is_listed(key, place)) throw_unlisted_contact();
    return pairs_[place].parameters.law;
  });
  if (archive.is_reading()) take(all);
}

void SurfaceContacts::take_over(const SurfaceContacts& before, std::span<const std::int32_t> places,
                                geometry::FunctionRef<void()> list, geometry::ThreadPool& pool) {
  begin_anew(list, pool);
  SurfaceContactsState all = before.state();
  for (SurfaceContactsState::Contact& kept : all.contacts)
    kept.pair.a = places[static_cast<std::size_t>(kept.pair.a)];
  take(all);
}

/// Of pairs without contacts.
void SurfaceContacts::begin_anew(geometry::FunctionRef<void()> list, geometry::ThreadPool& pool) {
  rekey_(
      pairs_, {}, [](std::size_t, const Pair*) { return Pair{}; }, [](const Pair&) {});
  list();
  current_ = {};
  current_.resize(1);
  records_.reset(pool.thread_count());
}

/// @param place  from where on to look for a pair, one after the other in ascending order; where it
///               is
bool SurfaceContacts::is_listed(const geometry::IndexPair& key, std::size_t& place) const noexcept {
  place = next_place(place, pairs_.size(), [&](std::size_t i) { return rekey_.key(i) < key; });
  return place < pairs_.size() && rekey_.key(place) == key;
}

/// What pairs have: where elements have gone since the last step there may be more in the lists.
SurfaceContactsState SurfaceContacts::state() const {
  constexpr std::uint32_t kGone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::optional<SurfaceContactsState::Contact>> all(touching());
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const PatchContacts::Range& range = pairs_[i].contacts;
    if (range.count == 0) continue;
    const ContactsOfPair of_pair = current_.of(range);
    std::size_t place = current_.count_before(static_cast<std::size_t>(range.worker)) + range.first;
    for (const PatchContact& contact : of_pair.contacts) {
      const auto minima = of_pair.minima_of(contact);
      all[place++] = {rekey_.key(i), contact, {minima.begin(), minima.end()}};
    }
  }
  SurfaceContactsState state{largest_overlap_ratio(), {}, {}};
  std::vector<std::uint32_t> places;
  for (std::optional<SurfaceContactsState::Contact>& contact : all) {
    places.push_back(contact ? static_cast<std::uint32_t>(state.contacts.size()) : kGone);
    if (contact) state.contacts.push_back(*std::move(contact));
  }
  for (std::size_t w = 0; w < records_.lists().size(); ++w) {
    const auto& list = records_.lists()[w];
    for (const SurfaceForce& record : list.records) {
      const std::uint32_t place = places[current_.count_before(w) + record.contact];
      if (place != kGone) state.forces.push_back({place, record});
    }
  }
  return state;
}

/// Goes on with the contacts whose pairs are listed. @param state  in the order of the list
void SurfaceContacts::take(const SurfaceContactsState& state) {
  struct Now {
    std::size_t pair;
    std::uint32_t contact;
  };
  std::vector<std::optional<Now>> now;  // by contact of the state
  std::size_t place = 0;
  for (const SurfaceContactsState::Contact& kept : state.contacts) {
    now.emplace_back();
    if (!is_listed(kept.pair, place)) continue;
    Pair& pair = pairs_[place];
    require_same_law(kept.contact.memory.history, pair.parameters.law);
    now.back() = {place, static_cast<std::uint32_t>(current_.size())};
    current_.append(pair.contacts, kept.contact, kept.minima);
  }
  for (const SurfaceContactsState::Force& kept : state.forces) {
    const std::optional<Now>& of = now[kept.contact];
    if (!of) continue;
    SurfaceForce record = kept.record;
    record.pair = static_cast<std::uint32_t>(of->pair);
    record.contact = of->contact;
    record.a = pairs_[of->pair].node;
    records_.of_worker(0).add(record, state.largest_overlap_ratio);
  }
  for (Pair& pair : pairs_)
    if (pair.contacts.count > 0) pair.single_face = single_face_of(pair);
}

}  // namespace plekton::contact
