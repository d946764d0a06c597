// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/load_settings.hpp"
#include "dynamics/model/ties.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace plekton::apps {

/// To what nodes are tied: where they are; a point of space; the nearest of some nodes; the nearest
/// point of a surface; a cable on which they slide; where they are on a rigid body.
enum class TieTo : std::uint8_t { ground, point, nodes, surface, cable, body };

/// What one table [[ties]] asks for: a tie for each of some nodes.
struct TieSettings {
  std::string name;
  std::string path;  ///< what messages call it, as in "ties.hang"
  Place place;
  NodeSetSettings from;
  TieTo kind = TieTo::ground;
  Place to_place;
  geometry::Vec3 point = geometry::Vec3::Zero();            ///< m, of kind point
  NodeSetSettings to;                                       ///< of the kinds from nodes on
  double within = std::numeric_limits<double>::infinity();  ///< m, what is further is not tied
  std::optional<double> stiffness;                          ///< N/m; nothing: that of what is tied
  std::optional<double> rest_length;  ///< m; nothing: as far apart as they are
  bool only_pulls = false;
  double strength = dynamics::Tie::kNever;     ///< N
  double brake_force = dynamics::Tie::kNever;  ///< N
  double stroke = 0.0;                         ///< m
  double friction = 0.0;
  double slip_force = 0.0;  ///< N
  bool each = false;        ///< whether ties.csv has each of them
};

}  // namespace plekton::apps
