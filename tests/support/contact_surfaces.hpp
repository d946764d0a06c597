// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/sphere_surface/patch.hpp"
#include "tests/support/complexes.hpp"

#include <numeric>
#include <utility>
#include <vector>

/// Surfaces that are hard for a contact rule, and what a ball feels on them.
namespace plekton::test {

using namespace plekton::contact;

inline std::vector<CellId> all_cells(const Surface& surface) {
  std::vector<CellId> cells(surface.cell_count());
  for (std::size_t c = 0; c < cells.size(); ++c) cells[c] = id_at<CellId>(c);
  return cells;
}

/// Those with a bounding box nearer than a range, ascending.
inline std::vector<CellId> cells_near(const Surface& surface, const Vec3& centre, double range,
                                      Positions x) {
  std::vector<CellId> cells;
  for (const CellId cell : all_cells(surface)) {
    Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 upper = -lower;
    for (const NodeId node : surface.nodes_of(cell)) {
      lower = lower.cwiseMin(x[index_of(node)]);
      upper = upper.cwiseMax(x[index_of(node)]);
    }
    const Vec3 apart = (lower - centre).cwiseMax(centre - upper).cwiseMax(Vec3::Zero());
    if (apart.norm() <= range) cells.push_back(cell);
  }
  return cells;
}

/// Node lists of the maximal cells: the facets, then the cylinders that are no side of a facet.
inline std::vector<std::vector<int>> cell_nodes(const Surface& surface) {
  std::vector<std::vector<int>> cells;
  for (const CellId cell : all_cells(surface)) {
    auto& nodes = cells.emplace_back();
    for (const NodeId node : surface.nodes_of(cell)) nodes.push_back(static_cast<int>(node));
  }
  return cells;
}

template <class Map>
Complex mapped(Complex complex, Map map) {
  for (Vec3& x : complex.x) x = map(x);
  return complex;
}

/// Sheet or net over a square of n cells a side, of this spacing (m), with a node at the origin.
inline Complex centred(const Complex& grid, int n, double spacing) {
  return mapped(grid, [&](const Vec3& x) { return Vec3(spacing * (x - Vec3(n / 2, n / 2, 0))); });
}

/// Moves the nodes by up to a fifth of the spacing in the plane, and up to this roughness (m) out
/// of it.
inline Complex roughened(const Complex& flat, double spacing, double roughness, Random& random) {
  return mapped(flat, [&](const Vec3& x) {
    const Vec3 move = random.in_cube(1.0);
    return Vec3(x + Vec3(0.2 * spacing * move[0], 0.2 * spacing * move[1], roughness * move[2]));
  });
}

/// k cylinders of length 1 from one node, in random directions.
inline Complex junction(int k, Random& random) {
  Complex result;
  result.node(Vec3::Zero());
  for (int i = 0; i < k; ++i) result.cylinder(0, result.node(random.direction()));
  return result;
}

/// A rough sheet of 4 x 4 squares with a fin on one of its lines, and free cylinders from some of
/// its nodes.
inline Complex sheet_with_fin(double roughness, Random& random) {
  Complex result = roughened(sheet(4), 1.0, roughness, random);
  for (int j = 0; j < 4; ++j) {
    const int top = result.node(result.x[static_cast<std::size_t>(10 + j)] +
                                Vec3(0.1, 0.4, random.uniform(-1.0, 1.0)));
    result.facet(10 + j, 11 + j, top);
  }
  for (int k = 0; k < 3; ++k) {
    const int node = random.integer(0, 24);
    result.cylinder(node,
                    result.node(result.x[static_cast<std::size_t>(node)] + random.in_cube(1.0)));
  }
  return result;
}

/// Plate in z = 0 with a regular hole: n corners at the rim radius (m), out to a polygon at the
/// outer radius.
inline Complex plate_with_hole(int n, double rim_radius, double outer_radius) {
  Complex result;
  const auto ring = [&](double radius, double shift) {
    for (int k = 0; k < n; ++k) {
      const double angle = 2.0 * std::numbers::pi * (k + shift) / n;
      result.node(radius * Vec3(std::cos(angle), std::sin(angle), 0.0));
    }
  };
  ring(rim_radius, 0.0);
  ring(outer_radius, 0.5);
  for (int k = 0; k < n; ++k) {
    result.facet(k, (k + 1) % n, n + k);
    result.facet((k + 1) % n, n + (k + 1) % n, n + k);
  }
  return result;
}

/// The same surface with nodes, facets and cylinders created in another order, facets with other
/// first corners.
inline Complex reordered(const Complex& old, Random& random) {
  std::vector<int> place(old.x.size());
  std::iota(place.begin(), place.end(), 0);
  const auto shuffle = [&](auto& list) {
    for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[random.index(i)]);
  };
  shuffle(place);
  Complex result;
  result.x.resize(old.x.size());
  const auto at = [&](NodeId node) { return place[index_of(node)]; };
  for (std::size_t i = 0; i < place.size(); ++i)
    result.x[static_cast<std::size_t>(place[i])] = old.x[i];
  for (const Facet& facet : old.facets) {
    const std::size_t k = random.index(3);
    result.facet(at(facet.nodes[k]), at(facet.nodes[(k + 1) % 3]), at(facet.nodes[(k + 2) % 3]));
  }
  for (const Cylinder& cylinder : old.cylinders)
    result.cylinder(at(cylinder.nodes[1]), at(cylinder.nodes[0]));
  shuffle(result.facets);
  shuffle(result.cylinders);
  return result;
}

/// What all patches of a ball add up to, for the force f(overlap) = overlap.
struct TotalContact {
  Vec3 force = Vec3::Zero();  ///< on the ball
  double energy = 0.0;        ///< of these
  double overlaps = 0.0;      ///< m, sum of weight * overlap of all terms
  int patches = 0;
  double nearest = std::numeric_limits<double>::infinity();  ///< m, the least distance of a term

  /// Number of contacts by the force: one contact of the deepest overlap pushes with 1.
  double effective_number(double range) const { return force.norm() / (range - nearest); }
};

inline TotalContact total_contact(PatchFinder& finder, const Vec3& centre, double range,
                                  std::span<const CellId> cells, Positions x) {
  TotalContact total;
  for (const Patch& patch : finder.find(centre, range, cells, x)) {
    ++total.patches;
    for (const PatchTerm& term : finder.terms(patch)) {
      const double overlap = range - term.distance;
      total.force -= (term.weight * overlap + term.slope) * term.normal;
      total.energy += 0.5 * term.weight * overlap * overlap + term.energy;
      total.overlaps += term.weight * overlap;
      total.nearest = std::min(total.nearest, term.distance);
    }
  }
  return total;
}

/// Whether what is in range has rings, filled or not, or hollows: more passes than it takes to join
/// the minima to the patches, or coefficients that count more than patches.
inline bool has_cycles_or_voids(CriticalFeatureFinder& finder, const Vec3& centre, double range,
                                std::span<const CellId> cells, Positions x, int patches) {
  int joins = 0;
  int minima = 0;
  int sum = 0;
  for (const CriticalFeature& feature : finder.find(centre, range, cells, x)) {
    if (feature.is_minimum()) ++minima;
    if (feature.is_saddle()) joins += feature.branches - 1;
    sum += feature.coefficient;
  }
  return joins != minima - patches || sum != patches;
}

}  // namespace plekton::test
