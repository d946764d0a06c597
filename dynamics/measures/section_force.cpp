// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/section_force.hpp"

#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/sheet_facets.hpp"

#include <algorithm>

namespace plekton::dynamics {

ForceAndMoment section_force(const std::vector<char>& is_inside, const NodeState& state,
                             const BeamBonds& bonds, const SheetFacets& sheets, const Vec3& about) {
  ForceAndMoment sum;
  for (std::size_t i = 0; i < bonds.size(); ++i) {
    const auto [a, b] = bonds.nodes(i);
    const bool has_b = is_inside[index_of(b)] != 0;
    if ((is_inside[index_of(a)] != 0) == has_b || bonds.is_broken(i)) continue;
    const auto [force, torque] = bonds.action_on(i, has_b, state);
    sum.add(state.position[index_of(has_b ? b : a)] - about, force, torque);
  }
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const auto corners = sheets.nodes(i);
    const auto inside = std::count_if(corners.begin(), corners.end(), [&](NodeId corner) {
      return is_inside[index_of(corner)] != 0;
    });
    for (std::size_t k = 0; k < 3 && inside < 3; ++k) {
      if (is_inside[index_of(corners[k])] == 0) continue;
      sum.add(state.position[index_of(corners[k])] - about, sheets.corner_force(i, k),
              sheets.corner_torque(i, k));
    }
  }
  return sum;
}

}  // namespace plekton::dynamics
