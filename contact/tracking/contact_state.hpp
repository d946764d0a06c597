// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/any_law.hpp"
#include "contact/tracking/contact_memory.hpp"
#include "geometry/base/state_archive.hpp"
#include "geometry/critical/product_features.hpp"
#include "geometry/primitives/feature.hpp"
#include "geometry/primitives/proximity.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>

/// What all kinds of contacts have in a state that is written or read.
namespace plekton::geometry {

/// Kind and id.
template <>
struct NumbersOf<Feature> : NumbersAs<std::int32_t, 2> {
  static void put(const Feature& thing, std::int32_t* to) noexcept {
    to[0] = static_cast<std::int32_t>(thing.kind);
    to[1] = thing.id;
  }
  static void get(const std::int32_t* from, Feature& thing) noexcept {
    thing.kind = static_cast<FeatureKind>(from[0]);
    thing.id = from[1];
  }
};

/// Nodes, and how many of them count.
template <>
struct NumbersOf<FeatureNodes> : NumbersAs<std::int32_t, 4> {
  static void put(const FeatureNodes& thing, std::int32_t* to) noexcept {
    NumbersOf<std::array<NodeId, 3>>::put(thing.ids, to);
    to[3] = static_cast<std::int32_t>(thing.count);
  }
  static void get(const std::int32_t* from, FeatureNodes& thing) noexcept {
    NumbersOf<std::array<NodeId, 3>>::get(from, thing.ids);
    thing.count = static_cast<std::size_t>(from[3]);
  }
};

}  // namespace plekton::geometry

namespace plekton::contact {

// What a surface has of nodes, cells and features: others are refused when a state is read.

template <class Id>
bool is_below(std::size_t count, Id id) noexcept {
  const auto i = static_cast<std::int64_t>(id);
  return i >= 0 && i < static_cast<std::int64_t>(count);
}
template <class Nodes>
bool has_nodes(const geometry::Surface& surface, const Nodes& nodes) noexcept {
  return std::all_of(std::begin(nodes), std::end(nodes),
                     [&](NodeId node) { return is_below(surface.node_count(), node); });
}
inline bool has(const geometry::Surface& surface, const geometry::FeatureNodes& of) noexcept {
  return of.count >= 1 && of.count <= of.ids.size() && has_nodes(surface, of);
}
inline bool has(const geometry::Surface& surface, const geometry::CellPair& cells) noexcept {
  return is_below(surface.cell_count(), cells.a) && is_below(surface.cell_count(), cells.b);
}
inline bool has(const geometry::Surface& surface, const geometry::Feature& feature) noexcept {
  switch (feature.kind) {
    case geometry::FeatureKind::node:
      return is_below(surface.node_count(), feature.id);
    case geometry::FeatureKind::edge:
      return is_below(surface.edge_count(), feature.id);
    case geometry::FeatureKind::face:
      return is_below(surface.face_count(), feature.id);
  }
  return false;
}

/// @param on  the surface that the point is on
inline void exchange(geometry::RowFields& row, const std::string& name, geometry::CorePoint& core,
                     const geometry::Surface& on) {
  row(name + "_nodes", core.nodes);
  row.require(has_nodes(on, core.nodes), name + "_nodes");
  row(name + "_weights", core.weights);
  row(name + "_feature", core.feature);
  row.require(has(on, core.feature), name + "_feature");
}

/// Numbers of a history; none of one that no law has looked at.
/// @param law  of the contact
inline void exchange(geometry::RowFields& row, AnyLaw::History& history,
                     const AnyLaw::Functions* law) {
  bool is_seen = history.law != nullptr;
  row("has_history", is_seen);
  if (row.is_reading()) history.law = is_seen ? law : nullptr;
  row.numbers("history", history.numbers.data(), is_seen ? history.law->history_numbers : 0);
}

inline void exchange(geometry::RowFields& row, ContactMemory<AnyLaw>& memory,
                     const AnyLaw::Functions* law) {
  row("normal", memory.normal);
  exchange(row, memory.history, law);
}

/// Looks up the places of keys that come in ascending order.
/// @param is_before  (place) -> whether its key is before the one that is sought
/// @returns the first place from `from` on that is not before it
template <class IsBefore>
std::size_t next_place(std::size_t from, std::size_t count, IsBefore is_before) {
  while (from < count && is_before(from)) ++from;
  return from;
}

/// Whether a history is that of another law.
inline bool is_other_law(const AnyLaw::History& history, const AnyLaw::Functions* law) noexcept {
  return history.law != nullptr && history.law != law;
}
[[noreturn]] inline void throw_other_law() {
  throw geometry::StateMismatch(
      "bodies that touch had another contact law before; what they remember means nothing to this "
      "one");
}

/// @throws geometry::StateMismatch if a history is that of another law
inline void require_same_law(const AnyLaw::History& history, const AnyLaw::Functions* law) {
  if (is_other_law(history, law)) throw_other_law();
}

[[noreturn]] inline void throw_unlisted_contact() {
  throw geometry::StateMismatch(
      "the state has a contact between bodies that its lists hold apart: it is damaged");
}

}  // namespace plekton::contact
