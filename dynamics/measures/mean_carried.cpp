// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/mean_carried.hpp"

#include "dynamics/structure/beam_bonds.hpp"
#include "geometry/base/elementary.hpp"

#include <cmath>

namespace plekton::dynamics {

double mean_carried(const Resistance& of, const NodeState& then) {
  MeanMagnitude carried;
  of.contacts.for_each_record(
      then.position, [&](const contact::ContactRecord& row) { carried.add(row.force().norm()); });
  for (std::size_t i = 0; i < of.bonds.size(); ++i) {
    if (of.bonds.is_broken(i) || !of.scene.is_there(of.scene.bonds[i].nodes[0])) continue;
    const BondForces forces = of.bonds.forces_of(i, then);
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

}  // namespace plekton::dynamics
