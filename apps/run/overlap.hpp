// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/body_tables.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace plekton::apps {

/// Two bodies that overlap. What the depth is measured against is the radius of the grain, of two
/// grains the smaller one; between structures, and of them with planes, half the smaller thickness.
struct BodyOverlap {
  std::array<BodyTable, 2> of;        ///< the lower one first
  std::array<std::size_t, 2> grains;  ///< which one of its table, where that is one of grains
  double depth = 0.0;                 ///< m
  double ratio = 0.0;                 ///< of the depth, over what largest_overlap_ratio is over
  Vec3 place = Vec3::Zero();          ///< m, of the contact
  /// Deeper than both radii, so that the core of each lies in the other body, or that of one behind
  /// a plane. Not of a membrane with itself: that its mesh crosses itself is told at its import.
  bool is_impossible = false;
};

/// Of a contact of the last step, or nothing where its bodies do not overlap by more than what may
/// be rounding of coordinates, or where it is a bond without a contact.
std::optional<BodyOverlap> overlap_of(const contact::ContactRecord& row, const BodyTables& bodies,
                                      const dynamics::Simulation& simulation);

/// The one of these contacts with the largest ratio; nothing if no bodies overlap.
std::optional<BodyOverlap> deepest_overlap(std::span<const contact::ContactRecord> rows,
                                           const BodyTables& bodies,
                                           const dynamics::Simulation& simulation);

/// Whose body is on a side of it (0 or 1), as in "grains.sand grain 3".
std::string name_of(const BodyOverlap& overlap, std::size_t side, const Scenario& scenario);

/// As in "15 mm (150 % of the radius) of grain 0 and grain 3 at (0.3, 0, 0.01) m".
std::string text_of(const BodyOverlap& overlap);

}  // namespace plekton::apps
