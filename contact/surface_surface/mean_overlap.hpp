// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/any_law.hpp"

#include <algorithm>

namespace plekton::contact::structure {

/// Mean overlap of contacts that together push with a force and store an energy: that at which one
/// of them has the same ratio of both.
///
/// Of a law whose energy grows with the overlap u as u^k it is u = k E / F, exact for any number of
/// contacts that are equally deep: k is 2 of a linear spring, 5/2 after Hertz. The law is asked for
/// k = u F_1(u) / E_1(u), at the overlap of a linear spring.
/// @param energy  J; what counts as negative may leave no more than 0
/// @param force   N, > 0
/// @returns       m; not above 0 if the energy is not
inline double mean_overlap(const AnyLaw::Parameters& parameters, double energy, double force) {
  const double linear = 2.0 * energy / force;
  const double energy_of_one = AnyLaw::elastic_normal_energy(parameters, -linear);
  if (!(energy_of_one > 0.0)) return linear;
  const double exponent =
      linear * AnyLaw::elastic_normal_force(parameters, -linear) / energy_of_one;
  return exponent * energy / force;
}

/// How much of the force of two bodies that lie on each other can be a push. Contacts whose
/// overlaps fall linearly over an area or a line to 0 have half of the deepest as their mean at
/// least, that of a corner that dips in; what has less is the slope by which the area grows or
/// shrinks. Of facets beside each other whose rims fall together that is all there is, and cancels
/// in their sum.
/// @param energy, force  J and N, of both; force > 0
/// @param deepest        m, of the nearest points, > 0
/// @returns              0 to 1
inline double pushing_part(const AnyLaw::Parameters& parameters, double energy, double force,
                           double deepest) {
  return std::clamp(mean_overlap(parameters, energy, force) / (0.5 * deepest), 0.0, 1.0);
}

}  // namespace plekton::contact::structure
