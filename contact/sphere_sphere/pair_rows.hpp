// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/tracking/contact_memory.hpp"
#include "geometry/base/rows.hpp"

#include <type_traits>
#include <variant>

namespace plekton::contact {

/// What a list keeps about kLanes pairs that follow each other in it, in rows: pairs side by side
/// are read and written by whole vectors, and every pair of the list from the first to the last
/// line of the cache.
template <ContactLaw Law>
struct alignas(64) PairRows {
  static constexpr std::size_t kLanes = 8;
  template <class Thing>
  using RowsOf = geometry::RowsOf<Thing, kLanes>;
  using History = typename Law::History;
  static_assert(sizeof(History) % sizeof(double) == 0, "a history is kept as doubles");

  RowsOf<History> history;
  RowsOf<Vec3> normal;  ///< unit, of the last step; zero if the pair did not touch
  RowsOf<double> gap;   ///< m, of the last step; any number if the pair did not touch
  /// N, on b, of the last step, if nothing else tells it; any numbers if the pair did not touch.
  [[no_unique_address]] std::conditional_t<TellsForce<Law>, std::monostate, RowsOf<Vec3>> force;

  ContactMemory<Law> memory(std::size_t lane) const noexcept {
    return {history.template at<History>(lane), normal.template at<Vec3>(lane)};
  }
  void set_memory(std::size_t lane, const ContactMemory<Law>& memory) noexcept {
    history.set(lane, memory.history);
    normal.set(lane, memory.normal);
  }
  void set(std::size_t lane, const ContactMemory<Law>& memory) noexcept {
    set_memory(lane, memory);
    gap.set(lane, 0.0);
    if constexpr (!TellsForce<Law>) force.set(lane, Vec3(Vec3::Zero()));
  }
  /// N, on b, of the last step, of a pair that touched.
  Vec3 force_on_b(std::size_t lane, const typename Law::Parameters& parameters) const noexcept {
    if constexpr (TellsForce<Law>) {
      return Law::force_of_state(parameters, gap.number(lane), normal.template at<Vec3>(lane),
                                 history.template at<History>(lane));
    } else {
      return force.template at<Vec3>(lane);
    }
  }
};

}  // namespace plekton::contact
