// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/structure/pair_term.hpp"

#include "contact/structure/extended.hpp"
#include "contact/structure/nearest.hpp"

#include <algorithm>
#include <limits>

namespace plekton::contact::structure {
namespace {

using geometry::Feature;
using geometry::FeatureKind;

std::array<bool, 3> seams_of(const geometry::Surface& surface, const Feature& feature) {
  if (feature.kind == FeatureKind::node) return {};
  if (feature.kind == FeatureKind::edge) {
    return {!surface.faces_of(geometry::EdgeId{feature.id}).empty(), false, false};
  }
  std::array<bool, 3> is_seam{};
  const auto& edges = surface.edges_of(geometry::FaceId{feature.id});
  for (std::size_t k = 0; k < 3; ++k) is_seam[k] = surface.faces_of(edges[k]).size() > 1;
  return is_seam;
}

/// A facet, or a cylinder that is no side of one.
bool is_cell(const geometry::Surface& surface, const Feature& feature) {
  if (feature.kind == FeatureKind::edge)
    return surface.faces_of(geometry::EdgeId{feature.id}).empty();
  return feature.kind == FeatureKind::face;
}

geometry::Core core_of(const Simplex& simplex) {
  return {simplex.x, simplex.count};
}

Simplex simplex_at(const geometry::FeatureNodes& nodes, const std::array<bool, 3>& is_seam,
                   geometry::Positions x) {
  Simplex simplex;
  simplex.count = nodes.count;
  simplex.is_seam = is_seam;
  for (std::size_t i = 0; i < nodes.count; ++i) simplex.x[i] = x[geometry::index_of(nodes.ids[i])];
  return simplex;
}

/// Of the range. Cores nearer than that meet, up to what matters: side by side has no meaning, and
/// the direction is that of the nearest points.
constexpr double kMeeting = 1e-6;

/// How far the boxes of two simplices are apart along the axis along which they are furthest apart;
/// negative if they overlap. No points of theirs are nearer.
double gap_of_boxes(const Simplex& a, const Simplex& b) {
  double widest = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    double low_a = a.x[0][k], high_a = low_a, low_b = b.x[0][k], high_b = low_b;
    for (std::size_t i = 1; i < a.count; ++i) {
      low_a = std::min(low_a, a.x[i][k]);
      high_a = std::max(high_a, a.x[i][k]);
    }
    for (std::size_t i = 1; i < b.count; ++i) {
      low_b = std::min(low_b, b.x[i][k]);
      high_b = std::max(high_b, b.x[i][k]);
    }
    widest = std::max(widest, std::max(low_a - high_b, low_b - high_a));
  }
  return widest;
}

void add(const PairForces& from, double weight, PairForces& to) {
  to.energy += weight * from.energy;
  for (std::size_t i = 0; i < 3; ++i) {
    to.on_a[i] += weight * from.on_a[i];
    to.on_b[i] += weight * from.on_b[i];
  }
}

void assign(const PairForces& from, double weight, PairForces& to) {
  to.energy = weight * from.energy;
  for (std::size_t i = 0; i < 3; ++i) {
    to.on_a[i] = weight * from.on_a[i];
    to.on_b[i] = weight * from.on_b[i];
  }
}

}  // namespace

PairTerm pair_term(const geometry::Surface& surface, const geometry::FeaturePair& pair) {
  PairTerm term{};
  term.a = geometry::nodes_of(surface, pair.a);
  term.b = geometry::nodes_of(surface, pair.b);
  term.is_seam_a = seams_of(surface, pair.a);
  term.is_seam_b = seams_of(surface, pair.b);
  term.weight = pair.weight;
  term.is_of_cells = is_cell(surface, pair.a) && is_cell(surface, pair.b);
  term.first_holder = pair.first_holder;
  term.holder_count = pair.holder_count;
  return term;
}

double evaluate(PairTerm& term, const NormalSpring& spring, geometry::Positions x) {
  const bool was_in_range = term.in_range;
  term.in_range = term.meets = false;
  const Simplex a = simplex_at(term.a, term.is_seam_a, x);
  const Simplex b = simplex_at(term.b, term.is_seam_b, x);
  if (!was_in_range) {  // what was in range mostly still is
    const double gap = gap_of_boxes(a, b) - spring.range();
    if (gap > 0.0) return gap;
  }
  const CoreProximity nearest = geometry::core_proximity(core_of(a), core_of(b));
  const double clearance = nearest.signed_distance - spring.range();
  if (!(nearest.signed_distance < spring.range())) return clearance;
  term.in_range = true;
  term.meets = nearest.points.relation == geometry::Relation::touching_or_crossing;
  term.overlap = spring.range() - nearest.signed_distance;
  if (nearest.signed_distance < kMeeting * spring.range()) {
    assign(at_nearest_points(nearest, spring), term.weight, term.forces);
    return clearance;
  }
  assign(nearest_part(a, b, nearest, spring), term.weight, term.forces);
  if (can_extend(a, b)) add(extended_part(a, b, spring), term.weight, term.forces);
  return clearance;
}

}  // namespace plekton::contact::structure
