// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/material.hpp"
#include "contact/contacts.hpp"
#include "geometry/neighbor/exclusion_groups.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace plekton::contact {

/// What a scene's contacts are between. Whoever makes contacts of it checks the properties of pairs
/// of materials alone (models.hpp): lists have to be as long as is said, ids those of materials,
/// the skin >= 0, as dynamics::check() sees to for a Scene.
struct ContactScene {
  std::span<const geometry::Sphere> spheres;  ///< they and the surface must outlive the contacts
  const geometry::Surface& surface;
  std::vector<Material> materials;
  std::vector<MaterialId> of_spheres;     ///< by SphereId
  std::vector<MaterialId> of_structures;  ///< by StructureId
  /// kg, by NodeId, for laws that ask for masses; empty: all bodies count as held.
  std::vector<double> masses;
  double skin;  ///< m, how far a pair may be apart when it is listed as a candidate
  /// By NodeId: which nodes of the surface touch planes; empty: all of them.
  std::vector<bool> meets_planes;
  Positions
      rest;  ///< m, of all nodes, for structures that may touch themselves; empty: they do not
  /// Nodes whose elements do not touch each other: those of each rigid body.
  geometry::ExclusionGroups groups{};
};

/// Which contact law a scene has, with the properties of its pairs of materials: makes the contacts
/// of a scene.
///
/// contact/models.hpp has them: of laws that come with the library, and of one's own.
using ContactModel = std::function<std::unique_ptr<Contacts>(ContactScene)>;

/// LinearFrictional between all pairs, by what their materials say: the usual one.
ContactModel linear_frictional();

}  // namespace plekton::contact
