// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contacts.hpp"
#include "dynamics/loads/applied_loads.hpp"
#include "dynamics/model/scene.hpp"
#include "dynamics/stiffness/nodal_stiffness.hpp"
#include "dynamics/structure/beam_bond.hpp"
#include "dynamics/structure/sheet_facets.hpp"
#include "dynamics/structure/yielding_bonds.hpp"
#include "dynamics/ties/ties.hpp"
#include "dynamics/time_step/exact_step.hpp"
#include "dynamics/time_step/expected_contacts.hpp"
#include "dynamics/time_step/present_contacts.hpp"
#include "dynamics/time_step/spread_stiffness.hpp"
#include "dynamics/time_step/step_cause.hpp"
#include "dynamics/time_step/structure_stiffness.hpp"

#include <vector>

namespace plekton::dynamics {

/// What resists in a simulation, as it is now: all of it belongs to the simulation.
struct Resistance {
  const Scene& scene;
  const geometry::Surface& surface;
  const contact::Contacts& contacts;
  const BeamBonds& bonds;
  const YieldingBonds& yielding_bonds;
  const SheetFacets& sheet_facets;
  const Ties& ties;
  const AppliedLoads& loads;
  const RigidNodes& rigid;
};

/// Critical time steps of a simulation as it is now.
///
/// Where positions x are asked for, they are those of the nodes when the forces of the last step
/// were found (m).
class StepLimits {
 public:
  /// @param of  what it refers to must outlive this
  explicit StepLimits(const Resistance& of);

  /// Of the structures and contacts as they are now, or with the contacts that may come
  /// (expected_contacts.hpp), whichever is shorter.
  /// @param space  for some of the nodes or all; its contents are overwritten
  CriticalStep critical(NodalStiffness& space, geometry::Positions x) const;
  CriticalStep critical(geometry::Positions x) const;
  /// Of the structures and contacts as they are now alone.
  CriticalStep present(geometry::Positions x) const;
  /// Of the structures as they are now and the contacts that may come alone.
  CriticalStep coming() const;
  /// What limits critical().
  StepCause cause(geometry::Positions x) const;
  /// By the frequencies of the scene as a whole (exact_step.hpp).
  /// @param time  s, at which loads are taken
  ExactStep exact(geometry::Positions x, double time) const;

  /// What a step is chosen for: contacts of now, and those of bodies that are nearer than a margin
  /// (m), go into the springs.
  /// @param rate  1/s, dashpot_rate() of the step in question
  void add_near_contacts(ContactSprings& springs, double margin, double rate) const;
  /// Wires that are taut, or may be once their ends are further apart by a margin (m).
  void add_near_wires(ContactSprings& springs, double margin) const;
  /// Whether any contact that may come has a dashpot.
  bool is_damped() const noexcept { return is_damped_; }
  void add_structures(NodalStiffness& stiffness) const;
  /// What contacts of structures with each other resist beside their springs
  /// (structure_stiffness.hpp).
  /// @param moved  m, how far nodes are at most from where they were in the last step
  void find_between_structures(StructureStiffness& structures, geometry::Positions x,
                               double moved) const;
  /// What contacts that are more or less than one resist beside their springs
  /// (spread_stiffness.hpp).
  void add_spread(NodalStiffness& stiffness, ContactSprings& springs, SpreadStiffness& spread,
                  geometry::Positions x) const;

  /// Sum over all nodes, with the contacts that may come.
  NodalStiffness::Total total_stiffness(NodalStiffness& space) const;

 private:
  template <class Look>
  void for_each_piece(NodalStiffness& space, const Look& look) const;
  template <class Step, class Find>
  Step with_dashpots(const Find& find) const;
  double of_structures(NodalStiffness& space) const;
  CriticalStep with_loads(CriticalStep step, double of_structures) const;
  template <class Add>
  CriticalStep shortest_of_pieces(NodalStiffness& space, const Add& add_contacts) const;
  CriticalStep structural(NodalStiffness& space, double rate) const;
  CriticalStep present(NodalStiffness& space, const StructureStiffness& between,
                       geometry::Positions x, double rate) const;
  void add_expected(NodalStiffness& stiffness, double rate) const;
  NodeId most_touched_of(NodeId node) const;
  void consider_structures(StiffestPart& parts) const;
  PresentContacts contacts(double rate) const noexcept {
    return {of_.contacts, of_.scene.planes, radii_, rate};
  }

  Resistance of_;
  std::vector<double> radii_;             ///< m, of the ball around each node; 0: none
  std::vector<ExpectedOfNode> expected_;  ///< of the contacts that may come, by node
  bool is_damped_;
  double pace_radius_;  ///< m
};

}  // namespace plekton::dynamics
