// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"
#include "dynamics/stiffness/contact_springs.hpp"
#include "dynamics/ties/ties.hpp"

#include <functional>
#include <limits>

namespace plekton::dynamics {

class AppliedLoads;
class BeamBonds;
class SheetFacets;

/// Critical time step of a scene as it is, from the highest frequency of all its motions together.
struct ExactStep {
  double dt = std::numeric_limits<double>::infinity();  ///< s; infinite if nothing is stiff and
                                                        ///< free
  /// Half of the residual over the eigenvalue: an eigenvalue of the scene has a step within error
  /// dt of this one. That it is the largest has no proof, but residuals are below 1e-5.
  double error = 0.0;
  int products = 0;          ///< of the stiffness with a motion
  std::size_t contacts = 0;  ///< how many contacts count
};

/// What resists in a scene.
struct Structures {
  const BeamBonds& bonds;
  const SheetFacets& sheets;
  const Ties& ties;
  double critical_step;  ///< s, of these alone, or less; asked for where they are damped
};

/// Adds forces (N) that follow from where the nodes are (m) alone.
using ForcesOfPlaces = std::function<void(geometry::Positions x, NodeForces& forces)>;

/// 2 / omega_max, omega² the largest eigenvalue of K x = omega² M x, by Lanczos' method, and what
/// viscous damping makes of it. An eigenvalue below zero, where something is about to buckle or
/// snap through, counts by its magnitude: what grows by exp(sqrt(-omega²) t) needs as short a step
/// as what swings.
///
/// K times a motion is a central difference of the forces of bonds, sheets, ties, springs to ground and
/// pressure (with the stiffness of gases), and of what else follows from the places of nodes, and
/// what the contacts' springs resist. So it has what coupling, tension and pressure do to the scene
/// where it is now, and nothing of contacts that are still to come: critical_step() counts those.
///
/// It costs two evaluations of all forces of structures for each product, of which there are some
/// ten to some hundred, and memory for four motions and a second copy of the structures.
/// @param structures  of the scene, as they have yielded and broken
/// @param contacts  as they touch now
/// @param time      s, at which loads are taken
/// @param normal    forces of contacts that are not among the springs; may be empty
ExactStep exact_critical_step(const Scene& scene, const Structures& structures,
                              const AppliedLoads& loads, const ContactSprings& contacts,
                              double time, const ForcesOfPlaces& normal = {});

}  // namespace plekton::dynamics
