// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/any_law.hpp"
#include "contact/sphere_surface/normal_law.hpp"
#include "contact/sphere_surface/normal_part.hpp"
#include "contact/sphere_surface/patch.hpp"
#include "contact/tracking/force_records.hpp"

#include <span>

namespace plekton::contact {

/// A sphere (a) and a structure of a surface (b) that may touch: their sizes, and what the law
/// makes of both.
struct SphereSurfacePair {
  double radius;                  ///< m, of the sphere
  double range;                   ///< m, radius of sphere + radius of surface
  double reach;                   ///< m, the range and the law's reach
  double attraction;              ///< N, of one contact
  NodeId node;                    ///< the sphere's
  AnyLaw::Parameters parameters;  ///< without the attraction

  NormalPart normal() const noexcept { return {parameters, attraction}; }
};

// What a pair does along its normals as a function of the places alone: without friction, and
// whatever else has a history.

/// J, of the elastic forces and the attraction.
/// @param finder  working space, of the surface
/// @param cells   as PatchFinder::find() takes them
inline double normal_energy(const SphereSurfacePair& pair, PatchFinder& finder,
                            std::span<const geometry::CellId> cells, Positions x) {
  if (cells.empty()) return 0.0;
  const NormalPart one = pair.normal();
  const NormalLaw law(one, pair.range);
  const Vec3& centre = x[index_of(pair.node)];
  double energy = 0.0;
  for (const Patch& patch : finder.find(centre, pair.reach, cells, x, law)) {
    for (const PatchTerm& term : finder.terms(patch))
      energy += term.weight * law.energy(term.distance) + term.energy;
  }
  return energy;
}

/// Adds the elastic forces (N), without the attraction.
/// @param finder  working space, of the surface
/// @param cells   as PatchFinder::find() takes them
inline void add_elastic_forces(const SphereSurfacePair& pair, PatchFinder& finder,
                               std::span<const geometry::CellId> cells, Positions x,
                               NodeForces& forces) {
  const NormalPart elastic(pair.parameters, 0.0);
  const NormalLaw law(elastic, pair.range);
  for (const Patch& patch : finder.find(x[index_of(pair.node)], pair.reach, cells, x, law)) {
    for (const PatchTerm& term : finder.terms(patch)) {
      const double force = term.weight * law.force(term.distance) + term.slope;
      const SurfaceForce record{
          pair.node, 0.0F, term.core, force * term.normal, Vec3::Zero(), Vec3::Zero(), force, 0, 0};
      record.add_to(forces, [](NodeId) { return true; });
    }
  }
}

}  // namespace plekton::contact
