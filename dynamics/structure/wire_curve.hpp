// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/structure/beam_bond.hpp"

#include <iosfwd>
#include <optional>
#include <string_view>
#include <vector>

namespace plekton::dynamics {

/// Force along a wire against its strain when it is pulled for the first time: straight pieces from
/// the origin through the points, in their order. At the last point the wire breaks.
///
/// Let e be the strain (L - L0) / L0, c the slope of the first piece, and p the plastic strain, 0
/// at first. A wire carries
///
///     F = max(0, min(c (e - p), f(e))),   f the curve,
///
/// and where f is the smaller, p = e - F / c from then on: it is pulled along the curve, unloads
/// and reloads along the first slope, and is slack below the length to which it was stretched for
/// good. Beyond the strain of the last point it breaks. It never pushes, bends or twists.
///
/// No piece may be steeper than the first: p would shrink along it, and the wire give back work
/// that was taken as lost. So p never shrinks, and every closed cycle loses F dp >= 0.
///
/// Source of the idea: Thoeni, Lambert, Giacomini, Sloan (2013), Discrete modelling of hexagonal
/// wire meshes with a stochastically distorted contact model, Computers and Geotechnics 49,
/// 158-169. Without the stochastic part: wires that begin crooked get curves of their own.
struct WireCurve {
  struct Point {
    double strain;  ///< -, above that of the point before, the first one above 0
    double force;   ///< N, >= 0; of the first point > 0
  };
  std::vector<Point> points;  ///< at least one: what follows needs it, and does not check

  /// N for each unit of strain, of the first piece.
  double first_slope() const noexcept { return points.front().force / points.front().strain; }
  double breaking_strain() const noexcept { return points.back().strain; }
  /// N. Beyond the last point that of the last, below 0 along the first piece.
  double force_at(double strain) const noexcept;
  /// The smallest strain at which a wire that is pulled for the first time carries a force (N), >= 0;
  /// nothing where it breaks before.
  std::optional<double> strain_at(double force) const noexcept;
};

/// Section of a bar that is as stiff as the first piece of a curve: E = first slope / (pi r²).
/// @param radius  m, > 0
/// @throws std::invalid_argument for a curve without points
BeamSection wire_section(double radius, const WireCurve& curve);

/// Writes a line for everything that is wrong with a curve.
/// @param name  how the lines begin
void list_problems(const WireCurve& curve, std::string_view name, std::ostream& problems);

}  // namespace plekton::dynamics
