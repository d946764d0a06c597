// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"

#include <Eigen/Core>

#include <array>
#include <iosfwd>
#include <limits>
#include <string_view>

namespace plekton::dynamics {

using Vec2 = Eigen::Vector2d;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Stiffness of a thin isotropic sheet. Stretching and bending are given apart, so that a textile
/// may be stiff in its plane and limp across it.
struct SheetSection {
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  double tensile_stiffness;  ///< N/m, > 0: E t, force per width and strain in a strip
  double poisson_ratio;      ///< > -1, < 1
  double bending_stiffness;  ///< N m, >= 0: moment per width and curvature of a plate. With 0 the
                             ///< sheet is limp, and nothing turns its nodes: hold their rotations
  double thickness;          ///< m, > 0: of what turns with a node
  /// Pa, > 0: the facet breaks where its larger principal membrane force over the thickness is
  /// above.
  double strength = kNever;
};

/// A homogeneous plate: E t and E t³ / (12 (1 - nu²)).
SheetSection solid_sheet(double thickness, double young_modulus, double poisson_ratio) noexcept;

/// A triangle of a thin sheet between three nodes, in total form: force and torque follow from
/// where the nodes are and how they are turned now. The formulas stand at SheetFacets.
struct SheetFacet {
  std::array<NodeId, 3> nodes;
  std::array<Vec2, 3> corners;  ///< m, at rest, in the facet's frame: (0, 0), (> 0, 0), (any, > 0)
  SheetSection section;
  std::array<Quat, 3> rest;  ///< unit; from the facet's frame (z along its normal) to that of the
                             ///< node, at rest
};

/// m², at rest.
double area_of(const SheetFacet& facet) noexcept;

/// The facet between three nodes that is at rest where and as they are now.
/// @throws std::invalid_argument listing every problem (see list_problems)
SheetFacet make_sheet_facet(const std::array<NodeId, 3>& nodes, const NodeState& at_rest,
                            const SheetSection& section);

/// Writes a line for everything that is wrong with a facet: a node that does not exist, a node
/// twice, no area at rest, a section out of range, a rest rotation that is not a unit quaternion.
/// @param name  how the lines begin, as in "sheet facet 12"
void list_problems(const SheetFacet& facet, std::size_t node_count, std::string_view name,
                   std::ostream& problems);

}  // namespace plekton::dynamics
