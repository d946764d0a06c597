// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/material.hpp"

#include <cmath>

/// How two bodies are curved against each other where they touch, before they are deformed: what
/// laws after Hertz ask for.
///
///     sphere, sphere        R' = R'' = R_a R_b / (R_a + R_b)
///     sphere, flat          R' = R'' = R of the sphere; a sheet may be as thin as it likes
///     sphere, cylinder      R' = R of the sphere, 1/R'' = 1/R + 1/r
///     cylinder, cylinder    R' and R'' are their radii: crossed at right angles
///     cylinder, flat        R' = R'' = r: the round end of a bar on a plane
///     flat, flat            as cylinders of half the thickness: the rims of sheets crossed
///
/// The first three are the surfaces' own. Structures on structures also touch along lines and over
/// areas, where there is no point contact; there each of the contacts that the measure counts is
/// one with these radii. They do not follow the angle at which bars cross, nor which feature is
/// touched: with them the energy would have to have moments and forces of their own, or would be no
/// function of the positions.
namespace plekton::contact {

/// Principal radii of the gap between two bodies about the point where they touch:
/// gap = x²/(2 R') + y²/(2 R''). Johnson, Contact Mechanics (1985), section 4.1.
struct RelativeRadii {
  double larger;   ///< m, R'
  double smaller;  ///< m, R''

  /// m.
  double equivalent() const noexcept {
    return larger == smaller ? smaller : std::sqrt(larger * smaller);
  }
};

/// The order of the bodies does not matter.
RelativeRadii relative_radii(const Body& a, const Body& b) noexcept;

/// Radius (m) of the sphere that presses on a plane as two bodies with these radii press on each
/// other: with an approach d, P = 4/3 E* sqrt(R) d^(3/2). For R' > R'' they touch in an ellipse,
/// and R is the equivalent radius over the cube of Johnson's factor F_2 (figure 4.4): 1.02, 1.05
/// and 1.23 times it at R' = 2, 3 and 10 R''. To some roundings, by the complete elliptic
/// integrals.
double hertz_radius(const RelativeRadii& radii) noexcept;

}  // namespace plekton::contact
