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

  ContactMemory<Law> memory(std::size_t lane) const noexcept {
    return {history.template at<History>(lane), normal.template at<Vec3>(lane)};
  }
  void set_memory(std::size_t lane, const ContactMemory<Law>& memory) noexcept {
    history.set(lane, memory.history);
    normal.set(lane, memory.normal);
  }
  /// A pair that did not touch in the last step.
  void set_new(std::size_t lane, const Parameters& of_pair) noexcept {
    parameters.set(lane, of_pair);
    set_memory(lane, {});
    gap.set(lane, 0.0);
  }
  void set_from(const PairRows& other, std::size_t other_lane, std::size_t lane) noexcept {
    parameters.set_from(other.parameters, other_lane, lane);
    history.set_from(other.history, other_lane, lane);
    normal.set_from(other.normal, other_lane, lane);
    gap.set_from(other.gap, other_lane, lane);
  }
};

}  // namespace plekton::contact
