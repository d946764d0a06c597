// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/sphere_surface/patch.hpp"

namespace plekton::contact {

/// Normal of a term whose core point is the sphere's centre itself, to the last bit. There the
/// surface leaves the side open (on a face) or any direction across (on an edge, on a node): the
/// contact stays on the side where it was.
/// @param last  unit, the contact's normal in the last step
/// @param x     m, of all nodes
/// @returns     unit; the term's own normal where the last one lies in the face or along the edge
inline Vec3 normal_on_last_side(const PatchTerm& term, const Vec3& last, Positions x) noexcept {
  Vec3 across = last;
  switch (term.core.feature.kind) {
    case geometry::FeatureKind::face:
      across = last.dot(term.normal) * term.normal;
      break;
    case geometry::FeatureKind::edge: {
      const Vec3 along =
          (x[index_of(term.core.nodes[1])] - x[index_of(term.core.nodes[0])]).normalized();
      across -= across.dot(along) * along;
      break;
    }
    case geometry::FeatureKind::node:
      break;
  }
  constexpr double kRounding = 1e-12;  // of a last normal that has no part across
  const double length = across.norm();
  return length > kRounding ? Vec3(across / length) : term.normal;
}

}  // namespace plekton::contact
