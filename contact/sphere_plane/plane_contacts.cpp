// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_plane/plane_contacts.hpp"

#include "contact/tracking/contact_state.hpp"
#include "geometry/base/orderless_sum.hpp"
#include "geometry/base/ranks.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace plekton::contact {
namespace {

BodyPart part_of(const SphereBody& sphere) noexcept {
  return {sphere.material, sphere.radius, sphere.mass};
}
BodyPart part_of(const Plane& plane, const SphereBody& sphere) noexcept {
  return {.material = plane.material, .radius = sphere.radius, .shape = Shape::flat};
}

}  // namespace

double PlaneContacts::rebuild(std::span<const geometry::IndexPair> keys,
                              std::span<const SphereBody> spheres, std::span<const Plane> planes,
                              const MaterialPairs& materials) {
  know_states();
  pieces_.clear();
  double lost = 0.0;
  const auto make = [&](std::size_t i, const Slot* old) {
    const SphereBody& sphere = spheres[static_cast<std::size_t>(keys[i].a)];
    const auto plane = static_cast<std::size_t>(keys[i].b);
    const auto parameters = materials.combine(part_of(sphere), part_of(planes[plane], sphere));
    if (old) {
      Slot kept = *old;
      kept.parameters = parameters;
      return kept;
    }
    return Slot{sphere.node, sphere.structure, false, plane, sphere.radius, parameters, {}};
  };
  rekey_(slots_, keys, make,
         [&](Slot& old) { lost += forget<AnyLaw>(old.parameters, old.state.memory, {}); });
  actions_.resize(planes.size());
  materials_ = &materials;
  find_bodies(keys, spheres, planes);
  share_masses_as_kept();
  return lost;
}

void PlaneContacts::share_out(std::span<const SphereBody> spheres, const SphereHolders& holders) {
  know_states();
  pieces_.assign(rekey_.keys(), spheres, holders);
  outcomes_.assign(pieces_.pieces().size(), {});
  actions_of_pieces_.assign(pieces_.planes().size(), {});
}

void PlaneContacts::find_bodies(std::span<const geometry::IndexPair> keys,
                                std::span<const SphereBody> spheres,
                                std::span<const Plane> planes) {
  on_bodies_.clear();
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> places;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const SphereBody& sphere = spheres[static_cast<std::size_t>(keys[i].a)];
    if (sphere.rigid_body < 0) continue;
    const auto place = places.try_emplace({sphere.rigid_body, keys[i].b}, places.size()).first;
    const Plane& plane = planes[static_cast<std::size_t>(keys[i].b)];
    on_bodies_.push_back({i, place->second, part_of(sphere), part_of(plane, sphere)});
  }
  touching_on_bodies_.resize(places.size());
}

/// @param touches  (slot) -> whether it does; what does not has the mass of its body for itself
template <class Touches>
void PlaneContacts::share_masses(const Touches& touches) {
  std::fill(touching_on_bodies_.begin(), touching_on_bodies_.end(), std::size_t{0});
  for (const OnBody& on : on_bodies_)
    if (touches(slots_[on.slot])) ++touching_on_bodies_[on.place];
  for (OnBody& on : on_bodies_) {
    Slot& slot = slots_[on.slot];
    const std::size_t sharing = touches(slot) ? touching_on_bodies_[on.place] : 1;
    if (sharing == on.sharing) continue;
    on.sharing = sharing;
    BodyPart part = on.sphere;
    part.mass /= static_cast<double>(sharing);
    slot.parameters = materials_->combine(part, on.plane);
  }
}

/// As what touched in the last step.
void PlaneContacts::share_masses_as_kept() {
  share_masses([](const Slot& slot) { return slot.touches; });
}

bool PlaneContacts::touches(const Slot& slot, double height) {
  return height < slot.radius ||
         goes_on<AnyLaw>(slot.parameters, slot.state.memory.history, height - slot.radius);
}

double PlaneContacts::advance(const Motion& motion, std::span<const Plane> planes, double dt,
                              geometry::ThreadPool& pool, NodeForces& forces) {
  totals_ = {};
  are_actions_known_ = false;
  share_masses([&](const Slot& slot) {
    return touches(slot, planes[slot.plane].height(motion.position[index_of(slot.node)]));
  });
  const std::span<const PlanePieces::Piece> pieces = pieces_.pieces();
  pool.for_each_range(pieces.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t k = begin; k < end; ++k) {
      outcomes_[k] = {};
      outcomes_[k].dissipated = advance_piece(pieces[k], motion, planes, dt);
      hand_over(pieces[k], forces, outcomes_[k]);
      add_up_actions(pieces[k], motion.position, planes);
    }
  });
  BlockTotals of_own;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (!pieces[k].counts) continue;
    of_own.dissipated.add(outcomes_[k].dissipated);
    of_own.largest_ratio = std::max(of_own.largest_ratio, outcomes_[k].largest_ratio);
    of_own.touching += outcomes_[k].touching;
  }
  if (SharedMotion* const motion_of_ranks = pieces_.motion()) {
    motion_of_ranks->add_up(of_own, totals_);
    known_ = Known::nothing;
  } else {
    totals_ = of_own;
  }
  return totals_.dissipated.value();
}

double PlaneContacts::advance_piece(const PlanePieces::Piece& piece, const Motion& motion,
                                    std::span<const Plane> planes, double dt) {
  double dissipated = 0.0;
  Touching touching;
  const auto flush = [&] {
    if (touching.count > 0) dissipated += advance_touching(touching, motion, planes, dt);
    touching.count = 0;
    touching.all_have_images = true;
  };
  for (const std::uint32_t i : slots_of(piece)) {
    Slot& slot = slots_[i];
    const double height = planes[slot.plane].height(motion.position[index_of(slot.node)]);
    const bool has_touched = slot.touches;
    slot.touches = touches(slot, height);
    if (slot.touches) {
      if (slot.parameters.law != touching.law || touching.count == kBatchLanes) flush();
      touching.law = slot.parameters.law;
      touching.slot[touching.count] = i;
      touching.height[touching.count++] = height;
      touching.all_have_images &= height + slot.radius > 0.0;
    } else if (has_touched) {
      dissipated += end_contact(slot, height, planes[slot.plane], motion, dt);
    }
  }
  flush();
  return dissipated;
}

void PlaneContacts::hand_over(const PlanePieces::Piece& piece, NodeForces& forces,
                              PieceOutcome& outcome) const {
  for (const std::uint32_t i : slots_of(piece)) {
    const Slot& slot = slots_[i];
    if (!slot.touches) continue;
    forces.force[index_of(slot.node)] -= slot.state.force;
    forces.torque[index_of(slot.node)] += slot.state.torque_a;
    outcome.largest_ratio = std::max(outcome.largest_ratio, -slot.state.gap / slot.radius);
    ++outcome.touching;
  }
}

/// Both act at one point: about the sphere's centre what acts on the plane has the opposite of the
/// torque on the sphere.
void PlaneContacts::add_up_actions(const PlanePieces::Piece& piece, Positions x,
                                   std::span<const Plane> planes) {
  std::fill(actions_of_pieces_.begin() + piece.first, actions_of_pieces_.begin() + piece.last,
            PlaneAction{});
  for (std::uint32_t place = piece.begin; place < piece.end; ++place) {
    const Slot& slot = slots_[pieces_.order()[place]];
    if (!slot.touches) continue;
    PlaneAction& action = actions_of_pieces_[pieces_.sum_of()[place]];
    const Vec3 lever = x[index_of(slot.node)] - planes[slot.plane].point;
    action.force += slot.state.force;
    action.moment += lever.cross(slot.state.force) - slot.state.torque_a;
    action.push += slot.state.force.dot(slot.state.memory.normal);
  }
}

void PlaneContacts::add_up_actions(Positions x, std::span<const Plane> planes) {
  for (const PlanePieces::Piece& piece : pieces_.pieces()) add_up_actions(piece, x, planes);
  are_actions_known_ = false;
}

/// To the kernel a plane is the mirror image of the sphere, moving and turning with the plane.
/// @param separation  m, from the sphere's centre to its image
[[gnu::always_inline]] inline SphereMotionOf<double> PlaneContacts::motion_of(
    const Slot& slot, const Vec3& separation, const Plane& plane, const Motion& motion) {
  const std::size_t node = index_of(slot.node);
  return {separation,
          plane.velocity_at(motion.position[node] + separation) - motion.velocity[node],
          motion.angular_velocity[node],
          plane.turning(),
          slot.radius,
          slot.radius};
}

/// @returns the energy (J) that is lost
double PlaneContacts::end_contact(Slot& slot, double height, const Plane& plane,
                                  const Motion& motion, double dt) {
  const double distance = height + slot.radius;
  ContactMemory<AnyLaw>& memory = slot.state.memory;
  const auto pair =
      motion_of(slot, distance * memory.normal, plane, motion).at(memory.normal, distance);
  const double lost = forget<AnyLaw>(slot.parameters, memory, last_displacement(pair, dt));
  slot.state = {};
  return lost;
}

double PlaneContacts::advance_touching(const Touching& touching, const Motion& motion,
                                       std::span<const Plane> planes, double dt) {
  if (touching.law->advance_batch && touching.all_have_images) {
    SphereBatch batch;
    gather(touching, motion, planes, batch);
    if (touching.law->advance_batch(batch, touching.count, dt)) return scatter(touching, batch);
  }
  double dissipated = 0.0;
  for (std::size_t k = 0; k < touching.count; ++k)
    dissipated += advance_one(slots_[touching.slot[k]], touching.height[k], motion, planes, dt);
  return dissipated;
}

void PlaneContacts::gather(const Touching& touching, const Motion& motion,
                           std::span<const Plane> planes, SphereBatch& batch) const {
  for (std::size_t k = 0; k < touching.count; ++k) {
    const Slot& slot = slots_[touching.slot[k]];
    const Plane& plane = planes[slot.plane];
    const Vec3& x = motion.position[index_of(slot.node)];
    const double to_image = -(touching.height[k] + slot.radius);
    // The same twice: a normal of either kind would be stored in parts, and loaded across them.
    const Vec3 separation = plane.form == Plane::Form::flat ? Vec3(to_image * plane.normal)
                                                            : Vec3(to_image * plane.normal_at(x));
    const SphereMotionOf<double> spheres = motion_of(slot, separation, plane, motion);
    batch.separation.set(k, spheres.separation);
    batch.velocity.set(k, spheres.velocity);
    batch.spin_a.set(k, spheres.spin_a);
    batch.spin_b.set(k, spheres.spin_b);
    batch.radius_a.set(k, spheres.radius_a);
    batch.radius_b.set(k, spheres.radius_b);
    batch.parameters().set_numbers(k, slot.parameters.numbers.data(),
                                   touching.law->parameter_numbers);
    batch.history().set_numbers(k, slot.state.memory.history.numbers.data(),
                                touching.law->history_numbers);
    batch.normal.set(k, slot.state.memory.normal);
  }
}

double PlaneContacts::scatter(const Touching& touching, SphereBatch& batch) {
  double dissipated = 0.0;
  for (std::size_t k = 0; k < touching.count; ++k) {
    PairState& state = slots_[touching.slot[k]].state;
    state.memory.history.law = touching.law;
    batch.history().get_numbers(k, state.memory.history.numbers.data(),
                                touching.law->history_numbers);
    batch.normal.get(k, state.memory.normal);
    batch.gap.get(k, state.gap);
    batch.force.get(k, state.force);
    batch.torque_a.get(k, state.torque_a);
    dissipated += batch.dissipated.number(k);
  }
  return dissipated;
}

/// The arithmetic of gather() and its kernel; beyond the mirror, where that has no image, the plane
/// goes on pushing.
double PlaneContacts::advance_one(Slot& slot, double height, const Motion& motion,
                                  std::span<const Plane> planes, double dt) {
  const Plane& plane = planes[slot.plane];
  const Vec3 normal = plane.normal_at(motion.position[index_of(slot.node)]);
  const Vec3 separation = -(height + slot.radius) * normal;
  const bool is_before = height + slot.radius > 0.0;
  const double distance = is_before ? separation.norm() : height + slot.radius;
  const auto pair =
      motion_of(slot, separation, plane, motion)
          .at(is_before ? Vec3((1.0 / distance) * separation) : Vec3(-normal), distance);
  PairState& state = slot.state;
  state.memory = {carried_history<AnyLaw>(state.memory, pair.normal, dt * pair.twist_rate()),
                  pair.normal};
  const SphereStepOf<double> step =
      sphere_step<AnyLaw>(pair, slot.parameters, state.memory.history, dt);
  state.gap = step.gap;
  state.force = step.force;
  state.torque_a = step.arm_a * step.force_cross_normal - step.moment;
  return step.dissipated;
}

void PlaneContacts::add_forces(NodeForces& forces) const {
  know_states();
  for (const Slot& slot : slots_) {
    if (!slot.touches) continue;
    forces.force[index_of(slot.node)] -= slot.state.force;
    forces.torque[index_of(slot.node)] += slot.state.torque_a;
  }
}

double PlaneContacts::elastic_energy() const {
  geometry::OrderlessSum of_own, sum;
  for (const PlanePieces::Piece& piece : pieces_.pieces()) {
    if (!piece.counts) continue;
    double of_piece = 0.0;
    for (const std::uint32_t i : slots_of(piece)) {
      const Slot& slot = slots_[i];
      if (!slot.touches) continue;
      of_piece += AnyLaw::elastic_normal_energy(slot.parameters, slot.state.gap) +
                  AnyLaw::history_energy(slot.parameters, slot.state.memory.history);
    }
    of_own.add(of_piece);
  }
  if (pieces_.motion() == nullptr) return of_own.value();
  pieces_.motion()->add_up(of_own, sum);
  return sum.value();
}

const PlaneAction& PlaneContacts::action_on(std::size_t plane) const {
  static const PlaneAction kNone;
  find_actions();
  return plane < actions_.size() ? actions_[plane] : kNone;
}

void PlaneContacts::find_actions() const {
  if (are_actions_known_) return;
  are_actions_known_ = true;
  sums_.assign(actions_.size(), {});
  for (const PlanePieces::Piece& piece : pieces_.pieces()) {
    if (!piece.counts) continue;
    for (std::uint32_t i = piece.first; i < piece.last; ++i)
      sums_[static_cast<std::size_t>(pieces_.planes()[i])].add(actions_of_pieces_[i]);
  }
  if (SharedMotion* const motion = pieces_.motion()) {
    own_sums_.swap(sums_);
    sums_.assign(actions_.size(), {});
    motion->add_up(std::span(std::as_const(own_sums_)), std::span(sums_));
  }
  for (std::size_t plane = 0; plane < sums_.size(); ++plane) actions_[plane] = sums_[plane].total();
}

/// Which contacts of others touch, and how far.
void PlaneContacts::know_gaps() const {
  if (known_ != Known::nothing) return;
  known_ = Known::gaps;
  struct Told {
    double gap;
    std::uint64_t touches;
  };
  std::vector<Told> told;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (pieces_.teller(i) == SharedMotion::kCommon) continue;
    told.push_back({slots_[i].state.gap, slots_[i].touches ? 1U : 0U});
    places.push_back(i);
  }
  geometry::Ranks& ranks = pieces_.motion()->ranks();
  geometry::share(ranks, room_, [&](const auto& visit_piece) {
    for (std::size_t n = 0; n < told.size(); ++n)
      visit_piece(pieces_.teller(places[n]), std::as_writable_bytes(std::span(&told[n], 1)));
  });
  for (std::size_t n = 0; n < told.size(); ++n) {
    if (pieces_.teller(places[n]) == ranks.rank()) continue;
    Slot& slot = slots_[places[n]];
    slot.touches = told[n].touches != 0;
    if (slot.touches)
      slot.state.gap = told[n].gap;
    else
      slot.state = {};
  }
}

/// All that there is of them, some at a time, so that a message is not as large as the scene.
void PlaneContacts::know_states() const {
  if (known_ == Known::all) return;
  know_gaps();
  known_ = Known::all;
  constexpr std::size_t kAtATime = geometry::Ranks::kUsualRoom / sizeof(PairState);
  const auto is_told = [this](std::size_t i) {
    return slots_[i].touches && pieces_.teller(i) != SharedMotion::kCommon;
  };
  for (std::size_t begin = 0, end = 0; begin < slots_.size(); begin = end) {
    for (std::size_t count = 0; end < slots_.size() && count < kAtATime; ++end)
      if (is_told(end)) ++count;
    geometry::share(pieces_.motion()->ranks(), room_, [&](const auto& visit_piece) {
      for (std::size_t i = begin; i < end; ++i)
        if (is_told(i))
          visit_piece(pieces_.teller(i), std::as_writable_bytes(std::span(&slots_[i].state, 1)));
    });
  }
  // Where a law is in memory, each process knows for itself.
  for (Slot& slot : slots_)
    if (slot.touches) slot.state.memory.history.law = slot.parameters.law;
}

void PlaneContacts::assign_ids(std::int64_t& last) {
  know_states();
  for (Slot& slot : slots_)
    if (slot.touches && slot.state.id == 0) slot.state.id = ++last;
}

void PlaneContacts::for_each_record(Positions x, VisitRecord visit) const {
  know_states();
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Slot& slot = slots_[i];
    if (!slot.touches) continue;
    const PairState& state = slot.state;
    const geometry::Feature node(slot.node);
    ContactRecord row;
    row.id = state.id;
    // Spheres come first among the spheres.
    row.a = slot.structure == geometry::StructureId{-1}
                ? ContactBody{BodyKind::sphere, rekey_.key(i).a, node}
                : ContactBody{BodyKind::structure, static_cast<std::int32_t>(slot.structure), node};
    row.b = {BodyKind::plane, static_cast<std::int32_t>(slot.plane), {}};
    row.normal = state.memory.normal;
    row.gap = state.gap;
    const Vec3 lever = (slot.radius + 0.5 * state.gap) * row.normal;
    row.point_a = x[index_of(slot.node)];
    row.point_b = row.point_a + (slot.radius + state.gap) * row.normal;
    row.point = row.point_a + lever;
    set_force(row, state.force);
    row.moment = AnyLaw::moment(state.memory.history, row.normal);
    set_state<AnyLaw>(row, slot.parameters, state.memory.history,
                      AnyLaw::elastic_normal_force(slot.parameters, state.gap));
    visit(row);
  }
}

// The state.

void PlaneContacts::exchange(const geometry::StateArchive& archive, std::size_t plane_count,
                             geometry::FunctionRef<void()> list) {
  double overlap_ratio = largest_overlap_ratio();
  archive("largest_overlap_ratio", overlap_ratio);
  std::vector<KeptPair> pairs;
  if (archive.is_reading()) {
    begin_anew(list);
  } else {
    pairs = kept_pairs();
    find_actions();
  }
  actions_.resize(plane_count);
  std::size_t place = 0;
  archive.rows("touching", pairs, [&](geometry::RowFields& row, KeptPair& kept) {
    place = exchange_pair(row, kept, place);
    if (row.is_reading()) keep(kept, place);
    ++place;  // each pair touches once
  });
  archive.rows("actions", actions_, [](geometry::RowFields& row, PlaneAction& action) {
    row("force", action.force);
    row("moment", action.moment);
    row("push", action.push);
  });
  if (!archive.is_reading()) return;
  archive.require(actions_.size() == plane_count, "actions");
  totals_.largest_ratio = overlap_ratio;
  totals_.touching = pairs.size();
  share_masses_as_kept();
}

/// Of pairs that do not touch.
void PlaneContacts::begin_anew(geometry::FunctionRef<void()> list) {
  known_ = Known::all;
  are_actions_known_ = true;
  std::fill(actions_.begin(), actions_.end(), PlaneAction{});
  totals_ = {};
  rekey_(
      slots_, {}, [](std::size_t, const Slot*) { return Slot{}; }, [](Slot&) {});
  list();
}

void PlaneContacts::take_over(const PlaneContacts& before, std::span<const std::int32_t> spheres,
                              std::span<const std::int32_t> planes,
                              geometry::FunctionRef<void()> list) {
  begin_anew(list);
  totals_.largest_ratio = before.largest_overlap_ratio();
  std::size_t place = 0;
  for (KeptPair& kept : before.kept_pairs()) {
    const geometry::IndexPair key{spheres[static_cast<std::size_t>(kept.pair[0])],
                                  planes[static_cast<std::size_t>(kept.pair[1])]};
    if (key.a < 0 || key.b < 0) continue;
    place = next_place(place, slots_.size(), [&](std::size_t i) { return rekey_.key(i) < key; });
    if (place == slots_.size() || rekey_.key(place) != key) continue;
    require_same_law(kept.state.memory.history, slots_[place].parameters.law);
    keep(kept, place);
    ++totals_.touching;
  }
  share_masses_as_kept();
}

std::vector<PlaneContacts::KeptPair> PlaneContacts::kept_pairs() const {
  know_states();
  std::vector<KeptPair> pairs;
  for (std::size_t i = 0; i < slots_.size(); ++i)
    if (slots_[i].touches) pairs.push_back({{rekey_.key(i).a, rekey_.key(i).b}, slots_[i].state});
  return pairs;
}

/// @param from  place in the list of the pair before
/// @returns the place of this one
std::size_t PlaneContacts::exchange_pair(geometry::RowFields& row, KeptPair& kept,
                                         std::size_t from) const {
  row("pair", kept.pair);
  const geometry::IndexPair key{kept.pair[0], kept.pair[1]};
  const std::size_t place =
      next_place(from, slots_.size(), [&](std::size_t i) { return rekey_.key(i) < key; });
  if (place == slots_.size() || rekey_.key(place) != key) throw_unlisted_contact();
  row("gap", kept.state.gap);
  contact::exchange(row, kept.state.memory, slots_[place].parameters.law);
  row("id", kept.state.id);
  row("force", kept.state.force);
  row("torque_a", kept.state.torque_a);
  return place;
}

void PlaneContacts::keep(const KeptPair& kept, std::size_t place) {
  slots_[place].state = kept.state;
  slots_[place].touches = true;
}

}  // namespace plekton::contact
