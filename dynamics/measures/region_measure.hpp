// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/tracking/contact_record.hpp"
#include "geometry/primitives/sphere.hpp"
#include "geometry/query/region.hpp"

#include <cstddef>
#include <span>
#include <vector>

/// What a sample of grains is like in a part of space.
namespace plekton::dynamics {

using geometry::Mat3;
using geometry::Vec3;

/// Grains and all contacts of a step, at the places where they were then.
struct SampleView {
  geometry::Positions position;  ///< m, by node
  std::span<const geometry::Sphere> spheres;
  std::vector<bool> is_grain;  ///< by sphere: not of a rigid body, which is a wall
  std::span<const contact::ContactRecord> contacts;
};

/// Quantities that there is nothing to tell of, as the coordination number where there is no grain,
/// are not numbers.
struct RegionMeasure {
  double volume = 0.0;        ///< m³, of the region
  double porosity = 0.0;      ///< 1 - (volume of the grains in the region) / volume; exact
                              ///< intersections; where grains overlap they count twice
  std::size_t grains = 0;     ///< with their centres in it
  std::size_t rattlers = 0;   ///< of these, with at most one contact
  double coordination = 0.0;  ///< contacts of a grain, those with walls too: mean of these grains
  double coordination_without_rattlers = 0.0;  ///< the same of the others
  std::size_t contacts = 0;                    ///< between grains, with their contact points in it
  Mat3 stress = Mat3::Zero();                  ///< Pa, compression below 0
  Mat3 fabric = Mat3::Zero();  ///< mean of normal (x) normal of these contacts; its trace is 1

  /// Pa, compression above 0
  double mean_pressure() const noexcept { return -stress.trace() / 3.0; }
  /// Pa, sqrt(3/2) of the norm of the deviator: the difference of the principal stresses in a
  /// triaxial test.
  double deviator_stress() const noexcept;
};

/// Measures a sample in a region. Touching grains are those that overlap or stick to each other.
///
/// Stress after Love and Weber (Christoffersen, Mehrabadi & Nemat-Nasser, J. Appl. Mech. 48 (1981)
/// 339): -1 / V times the sum of force (x) branch over contacts, force on b, branch from a to b:
/// from centre to centre of two grains, from centre to contact point at a wall (plane, membrane or
/// rigid body). Of a branch that crosses the border of the region the part inside counts (the bond
/// function of Hardy, J. Chem. Phys. 76 (1982) 622), so regions that fill a space side by side add
/// up to it. Motion adds nothing: grains are at rest or slow.
///
/// Coordination without rattlers after Thornton, Geotechnique 50 (2000) 43: (2 N_c - N_1) /
/// (N_p - N_0 - N_1).
/// Linear in grains and contacts; one order of sums, so the same bits for any number of threads.
RegionMeasure measure_region(const geometry::Region& region, const SampleView& sample);

/// Smallest box around the grains of a sample; a point at the origin if there are none.
geometry::Box box_around(const SampleView& sample) noexcept;

}  // namespace plekton::dynamics
