// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"
#include "apps/scene/build_scene.hpp"
#include "dynamics/simulation.hpp"

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace plekton::apps {

/// A table of a scenario whose bodies touch something.
struct BodyTable {
  enum class Kind : std::uint8_t { grains, membrane, plane };
  Kind kind = Kind::grains;
  std::size_t number = 0;  ///< among the tables of its kind

  friend auto operator<=>(const BodyTable&, const BodyTable&) = default;
};

/// Two bodies that overlap.
struct InitialOverlap {
  std::array<BodyTable, 2> of;        ///< the lower one first
  std::array<std::size_t, 2> grains;  ///< which one of its table, where that is one of grains
  double depth = 0.0;                 ///< m
  double ratio = 0.0;                 ///< of the depth to the smaller radius
  Vec3 place = Vec3::Zero();          ///< m, of the contact
  /// Deeper than both radii, so that the core of each lies in the other body, or that of one behind
  /// a plane. Not of a membrane with itself: that its mesh crosses itself is told at its import.
  bool is_impossible = false;
};

/// What touches at the start.
struct InitialContacts {
  std::vector<InitialOverlap> overlaps;  ///< the deepest first, against the radius
  std::vector<std::size_t> bonds;        ///< how many hold, by table [[contacts]]
};

/// Looks at the contacts of a simulation that has not made a step. Overlaps that may be rounding of
/// coordinates do not count.
InitialContacts initial_contacts(const Scenario& scenario, const BuiltScene& built,
                                 const dynamics::Simulation& simulation);

/// Bonds that were asked for and of which there are none, and overlaps that are deep.
std::vector<std::string> warnings_about(const InitialContacts& contacts, const Scenario& scenario);

/// @throws InputError listing who is in whom, if any overlap is impossible
void require_possible_start(const InitialContacts& contacts, const Scenario& scenario);

/// "grains.sand", "membranes.net", "planes.floor" or, without a name, "planes[0]".
std::string path_of(const BodyTable& table, const Scenario& scenario);

/// As in "15 mm (150 % of the radius) of grain 0 and grain 3 at (0.3, 0, 0.01) m".
std::string text_of(const InitialOverlap& overlap);

}  // namespace plekton::apps
