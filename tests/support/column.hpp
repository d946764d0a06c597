// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/structure/beam_bonds.hpp"
#include "tests/support/beam_structure.hpp"
#include "tests/support/linear_algebra.hpp"

#include <vector>

namespace plekton::test {

/// Whether a straight column between pins, along x, is stable in the x-z plane under a force.
inline bool is_stable(Scene column, double force) {
  const BeamSection& section = column.bonds.front().section;
  const double strain = force / (section.young_modulus * section.area);
  for (Vec3& position : column.state.position) position *= 1.0 - strain;
  BeamBonds bonds(column.bonds, column.state.size());
  const Eigen::MatrixXd stiffness = stiffness_matrix(bonds, column.state, 1e-6);

  std::vector<Eigen::Index> free;  // all turns about y, and the deflections between the pins
  for (std::size_t i = 0; i < column.state.size(); ++i) {
    if (i > 0 && i + 1 < column.state.size()) free.push_back(first_entry(i) + 2);
    free.push_back(first_entry(i) + 4);
  }
  const Eigen::MatrixXd in_plane = stiffness(free, free);
  return is_positive_definite(in_plane);
}

}  // namespace plekton::test
