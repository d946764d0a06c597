// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_contacts.hpp"
#include "geometry/cell_clearance.hpp"
#include "geometry/descent.hpp"

#include <optional>

/// What a step looks at before contacts of balls with surfaces begin, and their forces as a
/// function of the positions alone.
namespace plekton::contact {

template <ContactLaw Law>
template <class Visit>
void SurfaceContacts<Law>::for_each_coming(double margin, std::span<const geometry::CellId> cells,
                                           Positions x, Visit&& visit) const {
  for (const Pair& pair : pairs_) {
    const Vec3& centre = x[index_of(pair.node)];
    const double range = pair.reach + margin;
    std::optional<geometry::SurfaceFoot> nearest;
    bool is_visited = false;  // the nearest one
    for (const geometry::CellId cell : cells.subspan(pair.near.first, pair.near.count)) {
      if (geometry::clearance(*surface_, cell, centre, range, x) > 0.0) continue;
      const geometry::Feature whole = surface_->feature_of(cell);
      const geometry::SurfaceFoot foot = geometry::foot_on(
          *surface_, geometry::closest_feature(*surface_, whole, centre, x), centre, x);
      const bool is_coming =
          foot.core.feature == whole && foot.distance >= pair.range && foot.distance < range;
      if (is_coming) visit(pair.node, foot.core, pair.parameters, pair.range);
      if (nearest && !(foot.distance < nearest->distance)) continue;
      nearest = foot;
      is_visited = is_coming;
    }
    if (pair.contacts.count == 0 && nearest && !is_visited && nearest->distance < range)
      visit(pair.node, nearest->core, pair.parameters, pair.range);
  }
}

template <ContactLaw Law>
template <class Wants>
void SurfaceContacts<Law>::add_elastic_forces(std::span<const geometry::CellId> cells, Positions x,
                                              NodeForces& forces, PatchFinder& finder,
                                              Wants&& wants) const {
  for (const Pair& pair : pairs_) {
    if (pair.contacts.count == 0 || !wants(pair.node)) continue;
    const NormalPart one{&pair};
    for (const Patch& patch :
         finder.find(x[index_of(pair.node)], pair.reach,
                     cells.subspan(pair.near.first, pair.near.count), x, NormalLaw(one))) {
      for (const PatchTerm& term : finder.terms(patch)) {
        const double force = term.weight * one.force(term.distance) + term.slope;
        const SurfaceForce record{
            pair.node, term.core, force * term.normal, Vec3::Zero(), Vec3::Zero(), force, 0, 0};
        record.add_to(forces, [](NodeId) { return true; });
      }
    }
  }
}

}  // namespace plekton::contact
