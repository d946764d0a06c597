// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contact_memory.hpp"
#include "geometry/rows.hpp"

#include <type_traits>

namespace plekton::contact {

/// What a list keeps about kLanes pairs that follow each other in it, in rows: pairs side by side
/// are read and written by whole vectors, and every pair of the list from the first to the last
/// line of the cache.
template <ContactLaw Law>
struct alignas(64) PairRows {
  static constexpr std::size_t kLanes = 8;
  template <class Thing>
  using RowsOf = geometry::RowsOf<Thing, kLanes>;
  using Parameters = typename Law::Parameters;
  using History = typename Law::History;
  static_assert(std::is_trivially_copyable_v<Parameters> &&
                sizeof(Parameters) % sizeof(double) == 0);
  static_assert(sizeof(History) % sizeof(double) == 0, "a history is kept as doubles");

  RowsOf<Parameters> parameters;
  RowsOf<History> history;
  RowsOf<Vec3> normal;  ///< unit, of the last step; zero if the pair did not touch
  RowsOf<double> gap;   ///< m, of the last step; any number if the pair did not touch
  RowsOf<Vec3> force;   ///< N, on b, of the last step; any numbers if the pair did not touch

  ContactMemory<Law> memory(std::size_t lane) const noexcept {
    return {history.template at<History>(lane), normal.template at<Vec3>(lane)};
  }
  void set_memory(std::size_t lane, const ContactMemory<Law>& memory) noexcept {
    history.set(lane, memory.history);
    normal.set(lane, memory.normal);
  }
  bool touched(std::size_t lane) const noexcept {
    return !normal.template at<Vec3>(lane).isZero(0.0);
  }
  void set(std::size_t lane, const Parameters& of_pair, const ContactMemory<Law>& memory) noexcept {
    parameters.set(lane, of_pair);
    set_memory(lane, memory);
    gap.set(lane, 0.0);
    force.set(lane, Vec3(Vec3::Zero()));
  }
};

}  // namespace plekton::contact
