// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/any_law.hpp"
#include "contact/tracking/contact_memory.hpp"
#include "contact/tracking/reused_list.hpp"
#include "geometry/primitives/feature.hpp"
#include "geometry/primitives/surface_change.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact {

/// A contact on a patch as it is kept for the next step.
struct PatchContact {
  ContactMemory<AnyLaw> memory;
  Vec3 foot;                    ///< m, from the sphere's centre to the representative point
  double gap;                   ///< m, of the deepest minimum
  double elastic_force;         ///< N, magnitude of the sum of the normal forces
  double elastic_energy;        ///< J, of the normal forces
  std::int64_t id;              ///< 0: none yet
  std::uint32_t first_minimum;  ///< features of its minima, in PatchContacts::List::minima
  std::uint32_t minimum_count;
};

/// Contacts of a pair, with their minima.
struct ContactsOfPair {
  std::span<const PatchContact> contacts;
  const geometry::Feature* minima;  ///< of all contacts of the worker

  std::span<const geometry::Feature> minima_of(const PatchContact& contact) const noexcept {
    return {minima + contact.first_minimum, contact.minimum_count};
  }
};

/// The contacts of all pairs in a step, and the features of their minima: by the worker that found
/// them, in the order of its pairs.
class PatchContacts {
 public:
  struct List {
    ReusedList<PatchContact> contacts;
    std::vector<geometry::Feature> minima;
  };
  /// Where the contacts of a pair are.
  struct Range {
    int worker = 0;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };

  void resize(std::size_t worker_count) { lists_.resize(worker_count); }
  /// Keeps the room of the lists.
  void clear() noexcept {
    for (List& list : lists_) {
      list.contacts.clear();
      list.minima.clear();
    }
  }

  List& of_worker(int worker) noexcept { return lists_[static_cast<std::size_t>(worker)]; }
  const List& of_worker(int worker) const noexcept {
    return lists_[static_cast<std::size_t>(worker)];
  }
  std::span<const PatchContact> contacts_of(const Range& range) const noexcept {
    return {of_worker(range.worker).contacts.data() + range.first, range.count};
  }
  ContactsOfPair of(const Range& range) const noexcept {
    return {contacts_of(range), of_worker(range.worker).minima.data()};
  }

  std::size_t size() const noexcept { return count_before(lists_.size()); }
  /// Those of the workers before one.
  std::size_t count_before(std::size_t worker) const noexcept {
    std::size_t count = 0;
    for (std::size_t w = 0; w < worker; ++w) count += lists_[w].contacts.size();
    return count;
  }

  /// Gives a number after the last one to every contact that has none.
  void assign_ids(std::int64_t& last) noexcept {
    for (List& list : lists_) {
      for (PatchContact& contact : list.contacts) {
        if (contact.id == 0) contact.id = ++last;
      }
    }
  }

  /// As the next contact of a pair, with the first worker; those of one pair come together.
  void append(Range& range, const PatchContact& contact,
              std::span<const geometry::Feature> minima) {
    List& list = lists_[0];
    if (range.count == 0) range = {0, static_cast<std::uint32_t>(list.contacts.size()), 0};
    ++range.count;
    PatchContact& last = list.contacts.add() = contact;
    last.first_minimum = static_cast<std::uint32_t>(list.minima.size());
    last.minimum_count = static_cast<std::uint32_t>(minima.size());
    list.minima.insert(list.minima.end(), minima.begin(), minima.end());
  }

  /// A contact of a pair goes on from the minima that are left of its surface; without any nothing
  /// follows it. @returns the energy (J) of the histories that are lost
  double follow(const Range& range, const AnyLaw::Parameters& parameters,
                const geometry::SurfaceChange& change) {
    double lost = 0.0;
    List& list = of_worker(range.worker);
    for (std::uint32_t i = 0; i < range.count; ++i) {
      PatchContact& contact = list.contacts[range.first + i];
      geometry::Feature* const minima = list.minima.data() + contact.first_minimum;
      std::uint32_t left = 0;
      for (std::uint32_t m = 0; m < contact.minimum_count; ++m) {
        if (const auto minimum = change.now(minima[m])) minima[left++] = *minimum;
      }
      contact.minimum_count = left;
      if (left == 0) lost += forget<AnyLaw>(parameters, contact.memory, {});
    }
    return lost;
  }

 private:
  std::vector<List> lists_;  ///< by worker
};

}  // namespace plekton::contact
