// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <variant>
#include <vector>

/// Ties between bodies, as plain data: what dynamics/ties/ties.hpp makes of them.
namespace plekton::dynamics {

/// A place in space that stays.
struct FixedPoint {
  Vec3 place;  ///< m
};

/// A point of the material: a node, or between the nodes of a bar or a facet.
struct MaterialPoint {
  std::array<NodeId, 3> nodes;  ///< one that is not needed repeats the first, with weight 0
  Vec3 weights;                 ///< each >= 0, sum 1
};

inline MaterialPoint material_point(NodeId node) noexcept {
  return {{node, node, node}, Vec3(1.0, 0.0, 0.0)};
}

/// A chain of nodes along which ties slide; mostly there are cylinders and bonds between them.
struct Cable {
  std::vector<NodeId> nodes;  ///< at least two, each once
  bool is_closed = false;     ///< the first node follows the last one

  std::size_t segments() const noexcept { return nodes.size() - (is_closed ? 0 : 1); }
};

/// A place on a cable, from where the tie slides on.
struct CablePlace {
  std::size_t cable = 0;    ///< by place in Scene::cables
  std::size_t segment = 0;  ///< from its node of that number to the next one
  double along = 0.0;       ///< part of the segment, 0 to 1
};

/// A spring between a node and something else, along the line between them: so its forces are
/// opposite and on one line, and turn nothing.
///
/// With d the distance of its ends, e = d - rest_length - (what a brake has paid out) and k its
/// stiffness, it carries the tension k e, none below e = 0 unless it pushes.
struct Tie {
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  NodeId node;
  std::variant<FixedPoint, MaterialPoint, CablePlace> to;
  double stiffness = 0.0;    ///< N/m, > 0
  double rest_length = 0.0;  ///< m, >= 0
  bool pushes = true;        ///< whether it resists being shorter too; not on a cable or a brake
  double strength = kNever;  ///< N, > 0: tension above which it breaks for good

  /// N, > 0: tension at which it pays out, until it is longer by the stroke: then it is a spring
  /// again. What it has paid out it does not take back. Not on a cable.
  double brake_force = kNever;
  double stroke = 0.0;  ///< m, >= 0

  /// On a cable it slides once the force along that is above friction times the force across it
  /// plus slip_force.
  double friction = 0.0;    ///< coefficient, >= 0
  double slip_force = 0.0;  ///< N, >= 0
};

}  // namespace plekton::dynamics
