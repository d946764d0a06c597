// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_plane/plane_contacts.hpp"

#include "contact/tracking/contact_state.hpp"

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
    return Slot{sphere.node, plane, sphere.radius, 0.0, parameters, {}, 0};
  };
  rekey_(slots_, keys, make,
         [&](Slot& old) { lost += forget<AnyLaw>(old.parameters, old.memory, {}); });
  sphere_count_ = slots_.empty() ? 0 : spheres.size();
  materials_ = &materials;
  find_bodies(keys, spheres, planes);
  share_masses_as_kept();
  return lost;
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
  share_masses([](const Slot& slot) { return !slot.memory.is_new(); });
}

bool PlaneContacts::touches(const Slot& slot, double height) const {
  return height < slot.radius ||
         goes_on<AnyLaw>(slot.parameters, slot.memory.history, height - slot.radius);
}

/// Threads share out the spheres, not the contacts: those of a sphere are all of one thread, which
/// adds their forces at once, and most spheres are of the thread that moves their nodes.
double PlaneContacts::advance(const Motion& motion, std::span<const Plane> planes, double dt,
                              geometry::ThreadPool& pool, NodeForces& forces) {
  records_.reset(pool.thread_count());
  if (slots_.empty()) return 0.0;
  share_masses([&](const Slot& slot) {
    return touches(slot, planes[slot.plane].height(motion.position[index_of(slot.node)]));
  });
  return sum_(sphere_count_, pool, [&](std::size_t begin, std::size_t end, int worker) {
    Records& records = records_.of_worker(worker);
    const std::size_t old = records.count;
    const double dissipated = advance_spheres(begin, end, motion, planes, dt, records);
    for (std::size_t i = old; i < records.count; ++i) records.records[i].add_to(forces);
    return dissipated;
  });
}

double PlaneContacts::advance_spheres(std::size_t begin, std::size_t end, const Motion& motion,
                                      std::span<const Plane> planes, double dt, Records& records) {
  double dissipated = 0.0;
  Touching touching;
  const auto flush = [&] {
    if (touching.count > 0) dissipated += advance_touching(touching, motion, planes, dt, records);
    touching.count = 0;
    touching.all_have_images = true;
  };
  const std::size_t last = rekey_.first_of(end);
  for (std::size_t i = rekey_.first_of(begin); i < last; ++i) {
    Slot& slot = slots_[i];
    const double height = planes[slot.plane].height(motion.position[index_of(slot.node)]);
    if (touches(slot, height)) {
      if (slot.parameters.law != touching.law || touching.count == kBatchLanes) flush();
      touching.law = slot.parameters.law;
      touching.slot[touching.count] = i;
      touching.height[touching.count++] = height;
      touching.all_have_images &= height + slot.radius > 0.0;
    } else if (!slot.memory.is_new()) {
      dissipated += end_contact(slot, height, planes[slot.plane], motion, dt);
    }
  }
  flush();
  return dissipated;
}

/// @returns the energy (J) that is lost
double PlaneContacts::end_contact(Slot& slot, double height, const Plane& plane,
                                  const Motion& motion, double dt) {
  const double distance = height + slot.radius;
  const auto pair = motion_of(slot, distance * slot.memory.normal, plane, motion)
                        .at(slot.memory.normal, distance);
  slot.id = 0;
  return forget<AnyLaw>(slot.parameters, slot.memory, last_way(pair, dt));
}

double PlaneContacts::advance_touching(const Touching& touching, const Motion& motion,
                                       std::span<const Plane> planes, double dt, Records& records) {
  if (touching.law->advance_batch && touching.all_have_images) {
    SphereBatch batch;
    gather(touching, motion, planes, batch);
    if (touching.law->advance_batch(batch, touching.count, dt))
      return scatter(touching, batch, records);
  }
  double dissipated = 0.0;
  for (std::size_t k = 0; k < touching.count; ++k)
    dissipated += advance_one(touching.slot[k], touching.height[k], motion, planes, dt, records);
  return dissipated;
}

/// To the kernel a plane is the mirror image of the sphere, moving and turning with the plane.
/// @param separation  m, from the sphere's centre to its image
SphereMotionOf<double> PlaneContacts::motion_of(const Slot& slot, const Vec3& separation,
                                                const Plane& plane, const Motion& motion) {
  const std::size_t node = index_of(slot.node);
  return {separation,
          plane.velocity_at(motion.position[node] + separation) - motion.velocity[node],
          motion.angular_velocity[node],
          plane.turning(),
          slot.radius,
          slot.radius};
}

void PlaneContacts::gather(const Touching& touching, const Motion& motion,
                           std::span<const Plane> planes, SphereBatch& batch) const {
  for (std::size_t k = 0; k < touching.count; ++k) {
    const Slot& slot = slots_[touching.slot[k]];
    const Plane& plane = planes[slot.plane];
    const Vec3& x = motion.position[index_of(slot.node)];
    const Vec3 separation = -(touching.height[k] + slot.radius) * plane.normal_at(x);
    const SphereMotionOf<double> spheres = motion_of(slot, separation, plane, motion);
    batch.separation.set(k, spheres.separation);
    batch.velocity.set(k, spheres.velocity);
    batch.spin_a.set(k, spheres.spin_a);
    batch.spin_b.set(k, spheres.spin_b);
    batch.radius_a.set(k, spheres.radius_a);
    batch.radius_b.set(k, spheres.radius_b);
    batch.parameters().set_numbers(k, slot.parameters.numbers.data(),
                                   touching.law->parameter_numbers);
    batch.history().set_numbers(k, slot.memory.history.numbers.data(),
                                touching.law->history_numbers);
    batch.normal.set(k, slot.memory.normal);
  }
}

double PlaneContacts::scatter(const Touching& touching, SphereBatch& batch, Records& records) {
  double dissipated = 0.0;
  for (std::size_t k = 0; k < touching.count; ++k) {
    const std::size_t i = touching.slot[k];
    Slot& slot = slots_[i];
    slot.memory.history.law = touching.law;
    batch.history().get_numbers(k, slot.memory.history.numbers.data(),
                                touching.law->history_numbers);
    batch.normal.get(k, slot.memory.normal);
    batch.gap.get(k, slot.gap);
    PlaneForce& record = records.add(batch.overlap_ratio.number(k));
    record.a = slot.node;
    record.plane = slot.plane;
    batch.force.get(k, record.force);
    batch.torque_a.get(k, record.torque_a);
    record.contact = i;
    dissipated += batch.dissipated.number(k);
  }
  return dissipated;
}

/// The arithmetic of gather() and its kernel; beyond the mirror, where that has no image, the plane
/// goes on pushing.
double PlaneContacts::advance_one(std::size_t i, double height, const Motion& motion,
                                  std::span<const Plane> planes, double dt, Records& records) {
  Slot& slot = slots_[i];
  const Plane& plane = planes[slot.plane];
  const Vec3 normal = plane.normal_at(motion.position[index_of(slot.node)]);
  const Vec3 separation = -(height + slot.radius) * normal;
  const bool is_before = height + slot.radius > 0.0;
  const double distance = is_before ? separation.norm() : height + slot.radius;
  const auto pair =
      motion_of(slot, separation, plane, motion)
          .at(is_before ? Vec3((1.0 / distance) * separation) : Vec3(-normal), distance);
  slot.memory = {carried_history<AnyLaw>(slot.memory, pair.normal, dt * pair.twist_rate()),
                 pair.normal};
  const SphereStepOf<double> step =
      sphere_step<AnyLaw>(pair, slot.parameters, slot.memory.history, dt);
  slot.gap = step.gap;
  records.add(
      {slot.node, slot.plane, step.force, step.arm_a * step.force_cross_normal - step.moment, i},
      -step.gap / slot.radius);
  return step.dissipated;
}

double PlaneContacts::elastic_energy() const {
  double energy = 0.0;
  records_.for_each([&](const PlaneForce& record) {
    const Slot& slot = slots_[record.contact];
    energy += AnyLaw::elastic_normal_energy(slot.parameters, slot.gap) +
              AnyLaw::history_energy(slot.parameters, slot.memory.history);
  });
  return energy;
}

Vec3 PlaneContacts::force_on(std::size_t plane) const {
  Vec3 force = Vec3::Zero();
  records_.for_each([&](const PlaneForce& record) {
    if (record.plane == plane) force += record.force;
  });
  return force;
}

void PlaneContacts::for_each_record(Positions x, std::span<const geometry::StructureId> structures,
                                    VisitRecord visit) const {
  records_.for_each([&](const PlaneForce& record) {
    const Slot& slot = slots_[record.contact];
    const geometry::Feature node(slot.node);
    const std::int32_t sphere = rekey_.key(record.contact).a;
    const geometry::StructureId structure = structures[static_cast<std::size_t>(sphere)];
    ContactRecord row;
    row.id = slot.id;
    // Spheres come first among the spheres.
    row.a = structure == geometry::StructureId{-1}
                ? ContactBody{BodyKind::sphere, sphere, node}
                : ContactBody{BodyKind::structure, static_cast<std::int32_t>(structure), node};
    row.b = {BodyKind::plane, static_cast<std::int32_t>(slot.plane), {}};
    row.normal = slot.memory.normal;
    row.gap = slot.gap;
    const Vec3 lever = (slot.radius + 0.5 * slot.gap) * row.normal;
    row.point_a = x[index_of(slot.node)];
    row.point_b = row.point_a + (slot.radius + slot.gap) * row.normal;
    row.point = row.point_a + lever;
    set_force(row, record.force);
    row.moment = AnyLaw::moment(slot.memory.history, row.normal);
    set_state<AnyLaw>(row, slot.parameters, slot.memory.history,
                      AnyLaw::elastic_normal_force(slot.parameters, slot.gap));
    visit(row);
  });
}

// The state.

void PlaneContacts::exchange(const geometry::StateArchive& archive,
                             geometry::FunctionRef<void()> list, geometry::ThreadPool& pool) {
  double overlap_ratio = largest_overlap_ratio();
  archive("largest_overlap_ratio", overlap_ratio);
  std::vector<KeptPair> pairs;
  if (archive.is_reading()) {
    begin_anew(list, pool);
  } else {
    pairs = kept_pairs();
  }
  std::size_t place = 0;
  archive.rows("touching", pairs, [&](geometry::RowFields& row, KeptPair& kept) {
    place = exchange_pair(row, kept, place);
    if (row.is_reading()) keep(kept, place, overlap_ratio);
    ++place;  // each pair touches once
  });
  if (archive.is_reading()) share_masses_as_kept();
}

/// Of pairs that do not touch.
void PlaneContacts::begin_anew(geometry::FunctionRef<void()> list, geometry::ThreadPool& pool) {
  rekey_(
      slots_, {}, [](std::size_t, const Slot*) { return Slot{}; }, [](Slot&) {});
  list();
  records_.reset(pool.thread_count());
}

void PlaneContacts::take_over(const PlaneContacts& before, std::span<const std::int32_t> spheres,
                              std::span<const std::int32_t> planes,
                              geometry::FunctionRef<void()> list, geometry::ThreadPool& pool) {
  begin_anew(list, pool);
  std::size_t place = 0;
  for (KeptPair& kept : before.kept_pairs()) {
    const geometry::IndexPair key{spheres[static_cast<std::size_t>(kept.pair[0])],
                                  planes[static_cast<std::size_t>(kept.pair[1])]};
    if (key.a < 0 || key.b < 0) continue;
    place = next_place(place, slots_.size(), [&](std::size_t i) { return rekey_.key(i) < key; });
    if (place == slots_.size() || rekey_.key(place) != key) continue;
    require_same_law(kept.memory.history, slots_[place].parameters.law);
    keep(kept, place, before.largest_overlap_ratio());
  }
  share_masses_as_kept();
}

std::vector<PlaneContacts::KeptPair> PlaneContacts::kept_pairs() const {
  std::vector<KeptPair> pairs;
  records_.for_each([&](const PlaneForce& record) {
    const Slot& slot = slots_[record.contact];
    const geometry::IndexPair& key = rekey_.key(record.contact);
    pairs.push_back(
        {{key.a, key.b}, slot.gap, slot.memory, slot.id, record.force, record.torque_a});
  });
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
  row("gap", kept.gap);
  contact::exchange(row, kept.memory, slots_[place].parameters.law);
  row("id", kept.id);
  row("force", kept.force);
  row("torque_a", kept.torque_a);
  return place;
}

void PlaneContacts::keep(const KeptPair& kept, std::size_t place, double overlap_ratio) {
  Slot& slot = slots_[place];
  slot.gap = kept.gap;
  slot.memory = kept.memory;
  slot.id = kept.id;
  records_.of_worker(0).add({slot.node, slot.plane, kept.force, kept.torque_a, place},
                            overlap_ratio);
}

}  // namespace plekton::contact
