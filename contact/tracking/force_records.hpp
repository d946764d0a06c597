// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/tracking/interpolation.hpp"
#include "contact/tracking/reused_list.hpp"
#include "geometry/base/thread_pool.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

/// Forces of contacts, written down by whoever computes them and summed afterwards, node by node in
/// the order of the contacts: the sums have the same bits for any number of threads.
namespace plekton::contact {

/// Force of one term of a patch: on a sphere (a) and at a core point of a surface (b).
struct SurfaceForce {
  NodeId a;
  float share;  ///< of what the contact holds beside its elastic force
  geometry::CorePoint core;
  Vec3 force;             ///< N, on b
  Vec3 torque_a;          ///< N m, on a
  Vec3 torque_b;          ///< N m, on b, shared by its nodes by weight
  double elastic;         ///< N, part of the force along the line of a and the core point, on b;
                          ///< negative for a saddle
  std::uint32_t pair;     ///< of sphere and structure
  std::uint32_t contact;  ///< among those of the worker

  template <class Owns>
  void add_to(NodeForces& forces, Owns owns) const {
    if (owns(a)) {
      forces.force[index_of(a)] -= force;
      forces.torque[index_of(a)] += torque_a;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const NodeId node = core.nodes[i];
      const double weight = core.weights[static_cast<int>(i)];
      if (!owns(node)) continue;
      forces.force[index_of(node)] += weight * force;
      forces.torque[index_of(node)] += weight * torque_b;
    }
  }
};

/// The records of all contacts of a kind, in the order of the contacts: those of the first worker
/// first.
template <class Record>
class ForceRecords {
 public:
  /// What one worker wrote down.
  struct alignas(64) List {
    ReusedList<Record> records;
    double deepest = 0.0;  ///< largest overlap over the radius of the smaller sphere

    /// @returns a record to be filled in; before that it holds anything
    Record& add(double overlap_ratio) {
      deepest = std::max(deepest, overlap_ratio);
      return records.add();
    }
    void add(const Record& record, double overlap_ratio) { add(overlap_ratio) = record; }
  };

  /// Empty lists, one for each worker; keeps their memory.
  void reset(int worker_count) {
    lists_.resize(static_cast<std::size_t>(worker_count));
    for (List& list : lists_) {
      list.records.clear();
      list.deepest = 0.0;
    }
  }

  /// Leaves those for which keep(record) is true, in their order; it may change them.
  template <class Keep>
  void keep_if(Keep&& keep) {
    for (List& list : lists_) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < list.records.size(); ++i) {
        Record& record = list.records[i];
        if (!keep(record)) continue;
        if (kept != i) list.records[kept] = record;
        ++kept;
      }
      list.records.shrink(kept);
    }
  }

  List& of_worker(int worker) noexcept { return lists_[static_cast<std::size_t>(worker)]; }

  const std::vector<List>& lists() const noexcept { return lists_; }

  /// Calls visit(span of records) for those of one contact after the other.
  template <class Visit>
  void for_each_contact(Visit&& visit) const {
    for (const List& list : lists_) {
      for (std::size_t i = 0, end = 0; i < list.records.size(); i = end) {
        const Record& first = list.records[i];
        for (end = i + 1; end < list.records.size(); ++end) {
          const Record& next = list.records[end];
          if (next.pair != first.pair || next.contact != first.contact) break;
        }
        visit(std::span<const Record>(list.records.data() + i, end - i));
      }
    }
  }
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const List& list : lists_) {
      for (const Record& record : list.records) visit(record);
    }
  }

  std::size_t size() const noexcept {
    std::size_t count = 0;
    for (const List& list : lists_) count += list.records.size();
    return count;
  }

  /// Largest overlap over the radius of the smaller sphere.
  double deepest() const noexcept {
    double deepest = 0.0;
    for (const List& list : lists_) deepest = std::max(deepest, list.deepest);
    return deepest;
  }

  /// Adds all forces to the nodes. Each thread goes through all records and adds to the nodes it
  /// owns.
  void add_to(NodeForces& forces, geometry::ThreadPool& pool) const {
    if (size() == 0) return;
    if (pool.thread_count() == 1) {
      for_each([&](const Record& record) { record.add_to(forces, [](NodeId) { return true; }); });
      return;
    }
    pool.for_each_range(forces.force.size(), [&](std::size_t begin, std::size_t end, int) {
      const auto owns = [begin, end](NodeId node) {
        return index_of(node) >= begin && index_of(node) < end;
      };
      for_each([&](const Record& record) { record.add_to(forces, owns); });
    });
  }

 private:
  std::vector<List> lists_;
};

}  // namespace plekton::contact
