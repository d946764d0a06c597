// SPDX-License-Identifier: GPL-3.0-or-later
// The state of contacts of spheres with surfaces: in the order of their pairs, whichever thread had them.
#include "contact/sphere_surface/surface_contacts.hpp"
#include "contact/tracking/contact_state.hpp"

#include <limits>
#include <optional>
#include <utility>

namespace plekton::contact {

void SurfaceContacts::exchange(const geometry::StateArchive& archive,
                               geometry::FunctionRef<void()> list, geometry::ThreadPool& pool) {
  double overlap_ratio = largest_overlap_ratio();
  archive("largest_overlap_ratio", overlap_ratio);
  Kept all;
  if (archive.is_reading())
    begin_anew(list, pool);
  else
    all = kept();
  std::size_t place = 0;
  std::vector<std::uint32_t> pairs;  // by contact
  archive.rows("contacts", all.contacts, [&](geometry::RowFields& row, KeptContact& kept) {
    place = exchange_contact(row, kept, place);
    if (row.is_reading()) keep(kept, place);
    pairs.push_back(static_cast<std::uint32_t>(place));
  });
  archive.rows("forces", all.forces, [&](geometry::RowFields& row, KeptForce& kept) {
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
  Kept all = before.kept();
  for (const KeptContact& kept : all.contacts) {
    now.emplace_back();
    const geometry::IndexPair key{places[static_cast<std::size_t>(kept.pair[0])], kept.pair[1]};
    if (key.a < 0) continue;
    place = next_place(place, pairs_.size(), [&](std::size_t i) { return rekey_.key(i) < key; });
    if (place == pairs_.size() || rekey_.key(place) != key) continue;
    require_same_law(kept.contact.memory.history, pairs_[place].parameters.law);
    now.back() = {place, static_cast<std::uint32_t>(current_[0].contacts.size())};
    keep(kept, place);
  }
  for (KeptForce& kept : all.forces) {
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

/// What pairs have: where elements have gone since the last step there may be more in the lists.
SurfaceContacts::Kept SurfaceContacts::kept() const {
  constexpr std::uint32_t kGone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::optional<KeptContact>> all(touching());
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Pair& pair = pairs_[i];
    if (pair.contacts.count == 0) continue;
    const auto worker = static_cast<std::size_t>(pair.contacts.worker);
    const std::uint32_t first = first_contact(worker) + pair.contacts.first;
    for (std::uint32_t k = 0; k < pair.contacts.count; ++k) {
      const Contact& contact = current_[worker].contacts[pair.contacts.first + k];
      const Feature* const minima = current_[worker].minima.data() + contact.first_minimum;
      all[first + k] = {
          {rekey_.key(i).a, rekey_.key(i).b}, contact, {minima, minima + contact.minimum_count}};
    }
  }
  Kept kept;
  std::vector<std::uint32_t> places;
  for (std::optional<KeptContact>& contact : all) {
    places.push_back(contact ? static_cast<std::uint32_t>(kept.contacts.size()) : kGone);
    if (contact) kept.contacts.push_back(*std::move(contact));
  }
  for (std::size_t w = 0; w < records_.lists().size(); ++w) {
    const auto& list = records_.lists()[w];
    for (std::size_t i = 0; i < list.count; ++i) {
      const std::uint32_t place = places[first_contact(w) + list.records[i].contact];
      if (place != kGone) kept.forces.push_back({place, list.records[i]});
    }
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
