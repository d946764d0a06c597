// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "contact/tracking/contact_record.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>

namespace plekton::contact {

/// What all contacts of one kind are to a scene, whatever touches there: spheres, planes or
/// surfaces. How they list and step them differs by what they have to know.
///
/// All of it is of the last step.
template <class Kind>
concept ContactKind = requires(const Kind& kind, Kind& changing, std::int64_t& last_number,
                               Positions x, VisitRecord visit) {
  /// How many contacts there are.
  { kind.touching() } -> std::same_as<std::size_t>;
  /// Largest overlap over the radius of the smaller body.
  { kind.largest_overlap_ratio() } -> std::same_as<double>;
  /// J, stored in all of them.
  { kind.elastic_energy() } -> std::same_as<double>;
  /// Gives a number after the last one to every contact that has none.
  { changing.assign_ids(last_number) } -> std::same_as<void>;
  /// Calls visit(ContactRecord) for each, in the order of the list.
  { kind.for_each_record(x, visit) } -> std::same_as<void>;
};

}  // namespace plekton::contact
