// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/unbalanced_force.hpp"

#include "dynamics/time_step/step_limits.hpp"
#include "geometry/base/elementary.hpp"

#include <cmath>
#include <limits>

namespace plekton::dynamics {

double mean_carried(const Resistance& of, geometry::Positions x) {
  MeanMagnitude carried;
  of.contacts.for_each_record(
      x, [&](const contact::ContactRecord& row) { carried.add(row.force().norm()); });
  for (std::size_t i = 0; i < of.bonds.size(); ++i) {
    if (of.bonds.is_broken(i) || !of.scene.is_there(of.scene.bonds[i].nodes[0])) continue;
    const BondForces forces = of.yielding_bonds.forces_of(i, of.bonds, of.scene.state);
    carried.add(elementary::hypot(forces.tension, forces.shear.norm()));
  }
  for (std::size_t i = 0; i < of.ties.size(); ++i)
    if (!of.ties.is_broken(i)) carried.add(std::abs(of.ties.pull(i)));
  const SheetFacets& sheets = of.sheet_facets;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    if (sheets.is_broken(i) || !of.scene.is_there(of.scene.sheet_facets[i].nodes[0])) continue;
    for (std::size_t corner = 0; corner < 3; ++corner)
      carried.add(sheets.corner_force(i, corner).norm());
  }
  return carried.value();
}

double unbalanced_force_ratio(const LoadedNodesView& nodes, double carried) noexcept {
  MeanMagnitude resultant;
  for (std::size_t i = 0; i < nodes.forces.force.size(); ++i) {
    const Held held = nodes.properties.held[i];
    if (holds_translation(held)) continue;
    const Vec3 force = nodes.forces.force[i] + nodes.properties.mass[i] * nodes.gravity;
    resultant.add(free_axes(held).cwiseProduct(force).norm());
  }
  if (resultant.value() == 0.0) return 0.0;
  constexpr double kRounding = 1e-10;  // of the resultant: what stiff bonds carry by their lengths
  return carried > kRounding * resultant.value() ? resultant.value() / carried
                                                 : std::numeric_limits<double>::infinity();
}

}  // namespace plekton::dynamics
