// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/expected_contacts.hpp"
#include "dynamics/present_contacts.hpp"
#include "dynamics/simulation.hpp"

#include <algorithm>

/// How a simulation finds out what limits its time step.
namespace plekton::dynamics {

StepCause Simulation::critical_cause() const {
  NodalStiffness space(scene_.state.size(), &scene_.properties);
  const CriticalStep coming = structural_step(space, true);
  const CriticalStep present = present_step(space);
  const CriticalStep& shortest = present.dt < coming.dt ? present : coming;
  StepCause cause{shortest, {}, 0.0, shortest.dt};
  if (std::isfinite(shortest.dt)) {
    StiffestPart parts(shortest, scene_.properties);
    consider_structures(parts);
    if (&shortest == &present) {
      present_contacts().add_to(parts, 0.0, force_positions());
    } else {
      StepPart part{StepPart::Kind::coming_contacts};
      const ExpectedContacts contacts(scene_, surface_, *contacts_);
      part.partner = contacts.partner_of(parts.node());
      parts.consider(part, [&](NodalStiffness& stiffness) {
        stiffness.add(parts.node(), expected_[index_of(parts.node())]);
      });
    }
    cause = parts.cause();
  }
  cause.step.dt = loads_.critical_step(shortest.dt, scene_);
  return cause;
}

/// Everything but contacts that holds the node.
void Simulation::consider_structures(StiffestPart& parts) const {
  const auto holds_it = [&](const auto& nodes) {
    return std::find(nodes.begin(), nodes.end(), parts.node()) != nodes.end();
  };
  for (std::size_t i = 0; i < scene_.bonds.size(); ++i) {
    if (bonds_.is_broken(i) || !holds_it(scene_.bonds[i].nodes)) continue;
    parts.consider({StepPart::Kind::bond, i}, [&](NodalStiffness& stiffness) {
      stiffness.add_beam(scene_.bonds[i], scene_.state, bonds_.spring(i).length);
    });
  }
  for (std::size_t i = 0; i < sheet_facets_.size(); ++i) {
    if (sheet_facets_.is_broken(i) || !holds_it(sheet_facets_.nodes(i))) continue;
    parts.consider({StepPart::Kind::sheet_facet, i}, [&](NodalStiffness& stiffness) {
      sheet_facets_.add_to(stiffness, scene_.state, i);
    });
  }
  parts.consider({StepPart::Kind::ground_springs},
                 [&](NodalStiffness& stiffness) { loads_.add_springs_to(stiffness); });
  parts.consider({StepPart::Kind::pressure}, [&](NodalStiffness& stiffness) {
    loads_.add_pressures_to(stiffness, scene_.state.position);
  });
}

}  // namespace plekton::dynamics
