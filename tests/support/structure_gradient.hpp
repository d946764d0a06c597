// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/bodies_of_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

/// Whether what a pair of bodies does to the second one is the gradient of its energy.
namespace plekton::test {

/// J, with the nodes of the second body some of their ways (m) away.
template <class Law>
double energy_along(StructurePairUnder<Law>& pair, Body b, const std::vector<Vec3>& ways,
                    double part) {
  for (std::size_t i = 0; i < b.x.size(); ++i) b.x[i] += part * ways[i];
  pair.place(b);
  return pair.energy();
}

struct Slope {
  double power;   ///< J, of the forces along the ways
  double change;  ///< J, of the energy per part of the ways, by central differences
  double scale;   ///< J, of all forces as if each were along its way
};

/// Leaves the second body where it is given.
template <class Law>
Slope slope_along(StructurePairUnder<Law>& pair, const Body& b, const std::vector<Vec3>& ways,
                  double step) {
  const double after = energy_along(pair, b, ways, step);
  const double before = energy_along(pair, b, ways, -step);
  pair.place(b);
  Slope slope{0.0, (after - before) / (2.0 * step), 0.0};
  for (std::size_t i = 0; i < b.x.size(); ++i) {
    const Vec3& force = pair.forces()[pair.first_node_of_b() + i];
    slope.power += force.dot(ways[i]);
    slope.scale += force.norm() * ways[i].norm();
  }
  return slope;
}

/// The most by which a component of the forces on nodes of the second body is not the slope of the
/// energy, over the largest force; infinite where that is none. NaN if anything is.
/// @param each  of how many nodes one is looked at
template <class Law>
double worst_gradient_error(StructurePairUnder<Law>& pair, const Body& b, double step,
                            std::size_t each = 1) {
  pair.place(b);
  const std::vector<Vec3> forces = pair.forces();
  double largest = 0.0;
  for (const Vec3& force : forces) {
    if (!force.allFinite()) return std::numeric_limits<double>::quiet_NaN();
    largest = std::max(largest, force.norm());
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < b.x.size(); i += each) {
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Vec3> ways(b.x.size(), Vec3::Zero());
      ways[i] = Vec3::Unit(axis);
      const double expected =
          (energy_along(pair, b, ways, -step) - energy_along(pair, b, ways, step)) / (2.0 * step);
      const double error = std::abs(forces[pair.first_node_of_b() + i][axis] - expected);
      if (!std::isfinite(error)) return error;
      worst = std::max(worst, error);
    }
  }
  return worst > 0.0 ? worst / largest : 0.0;
}

}  // namespace plekton::test
