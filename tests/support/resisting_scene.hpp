// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/models.hpp"
#include "dynamics/loads/applied_loads.hpp"
#include "dynamics/model/contact_scene.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/sheet_facets.hpp"
#include "dynamics/structure/yielding_bonds.hpp"
#include "dynamics/ties/ties.hpp"
#include "dynamics/time_step/step_limits.hpp"

#include <memory>
#include <utility>

namespace plekton::test {

/// All that resists in a scene, as a simulation has it, without a simulation: nothing moves by
/// itself.
struct ResistingScene {
  explicit ResistingScene(dynamics::Scene of) : scene(std::move(of)) { find_forces(); }
  ResistingScene(const ResistingScene&) = delete;
  ResistingScene& operator=(const ResistingScene&) = delete;

  /// What acts where the nodes are now.
  void find_forces() {
    contacts->advance(scene.state.motion(), scene.planes, 0.0, pool, forces);
    bonds.advance(scene.state, pool);
    sheets.advance(scene.state, 0.0, pool);
    ties.advance(scene.state.position);
  }
  dynamics::Resistance resistance() const {
    return {scene, surface, *contacts, bonds, yielding, sheets, ties, loads, rigid};
  }

  dynamics::Scene scene;
  geometry::Surface surface{scene.elements.cylinders, scene.elements.facets, scene.state.size()};
  dynamics::RigidNodes rigid{scene.rigid_bodies, scene.state, scene.properties};
  std::unique_ptr<contact::Contacts> contacts =
      contact::linear_frictional()(dynamics::contact_scene(scene, surface, 0.0, false));
  dynamics::BeamBonds bonds{scene.bonds, scene.state.size()};
  dynamics::YieldingBonds yielding{scene.bond_laws, scene.bonds};
  dynamics::SheetFacets sheets{scene.sheet_facets, scene.state.size()};
  dynamics::Ties ties{scene};
  dynamics::AppliedLoads loads{scene};
  contact::NodeForces forces{scene.state.size()};  ///< of contacts
  geometry::ThreadPool pool;
};

}  // namespace plekton::test
