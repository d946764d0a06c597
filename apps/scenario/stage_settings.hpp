// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/load_settings.hpp"
#include "apps/scenario/problems.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace plekton::apps {

/// The force of a servo is reached.
struct ServoEnd {
  std::string load;                       ///< its name
  double tolerance = 0.0;                 ///< of the force
  std::size_t plane = 0;                  ///< that it drives
  std::optional<std::size_t> body_servo;  ///< of rigid bodies, by place among those
};

/// A plane, or the mean of some nodes, is so far from where it was at the start of the stage; or a
/// container is narrower or wider by that.
struct DisplacementEnd {
  double distance = 0.0;  ///< m
  std::size_t plane = 0;
  std::optional<NodeSetSettings> nodes;  ///< instead of the plane
};

/// The distance of two planes, or of the centres of two rigid bodies, has changed by this part of
/// what it was at the start of the stage.
struct StrainEnd {
  Place place;  ///< of the key between
  double strain = 0.0;
  std::array<std::size_t, 2> of{};
  bool are_rigid_bodies = false;
};

/// A component of a reaction is beyond a force.
struct ForceEnd {
  std::string reaction;  ///< its name
  int axis = 0;          ///< 0 to 2
  double force = 0.0;    ///< N
  bool is_above = true;  ///< or below
};

/// When a stage ends, or a run without stages before its duration is over: the first of these. In
/// such a run what is said of the start of the stage is of its own start.
struct StageEnd {
  std::optional<double> duration;          ///< s, from its start
  std::optional<double> kinetic_energy;    ///< J, below
  std::optional<double> unbalanced_force;  ///< ratio, below
  std::optional<ServoEnd> servo;
  std::optional<DisplacementEnd> displacement;
  std::optional<StrainEnd> strain;
  std::optional<ForceEnd> force;
  /// s, from its start, before which kinetic energy and forces do not count;
  /// nothing: once they were above.
  std::optional<double> after;
};

/// Grains that are taken out: those whose centres are in all of this.
struct RemovalSettings {
  std::size_t grains = 0;                                   ///< table
  double above = -std::numeric_limits<double>::infinity();  ///< m, height
  double below = std::numeric_limits<double>::infinity();   ///< m, height
  std::optional<geometry::Box> box;                         ///< m
};

/// What a plane without a name is called, as in "planes[0]".
/// @param number  among all planes that have come, in any stage
inline std::string default_plane_name(std::size_t number) {
  return "planes[" + std::to_string(number) + "]";
}
/// What a load without a name is called, as in "loads 0".
/// @param number  among all loads that have come, in any stage
inline std::string default_load_name(std::size_t number) {
  return "loads " + std::to_string(number);
}

/// What of a stage is that of the stage before. A load begins in the stage that names it, and goes
/// on until one names it again; a plane goes on from where it is, unless a stage says its point, and
/// as wide as it is, unless one says its radius.
struct StageOrigins {
  std::vector<std::size_t> loads;          ///< by load: the stage in which it began
  std::vector<std::size_t> reactions;      ///< by reaction, likewise
  std::vector<std::size_t> load_numbers;   ///< by load: its number among all that have come
  std::vector<int> planes;                 ///< by plane: its number in the stage before; -1: new
  std::vector<std::size_t> plane_numbers;  ///< by plane: its number among all that have come
  std::vector<bool> moved_planes;          ///< by plane: whether the stage says where or how it is
  std::vector<bool> says_point;            ///< by plane: whether the stage says its point
  std::vector<bool> says_radius;           ///< by plane: likewise
  std::vector<bool> absent_membranes;      ///< by membrane: it is not there yet, or any more
  std::vector<bool> absent_rigid_bodies;   ///< likewise
  std::vector<bool> says_hold;             ///< by rigid body: whether the stage says what is held
  bool changes_nothing = false;            ///< but when it ends and what is written
};

/// What a stage says beside its scenario.
struct StageSettings {
  std::string name;
  std::string path;  ///< what messages call it, as in "stages.pack"
  Place place;
  std::size_t number = 0;  ///< from 0
  bool is_last = false;
  StageEnd end;
  std::optional<double> max_duration;  ///< s, by which it has failed
  std::vector<RemovalSettings> removals;
  std::vector<NodeSetSettings> fixed;  ///< at its start
  std::vector<NodeSetSettings> freed;  ///< at its start
  StageOrigins origins;

  /// s, from its start: it ends, or fails, at the latest then.
  double longest() const noexcept {
    const double never = std::numeric_limits<double>::infinity();
    return std::min(end.duration.value_or(never), max_duration.value_or(never));
  }
};

/// A load of kind pressure, as pressures.csv has it.
struct PressureColumn {
  std::string load;
  bool has_volume = false;
  bool operator==(const PressureColumn&) const = default;
};

/// What there is in any stage, in the order in which it comes: columns of histories stay the same.
struct NamesOfStages {
  std::vector<std::string> planes;  ///< names, or as in "planes[0]"
  std::vector<PressureColumn> pressures;
  std::vector<std::string> reactions;
};

}  // namespace plekton::apps
