// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/bodies_of_cells.hpp"
#include "tests/support/contact_rule_reference.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>

/// Reference of the contact rule for body against body, written as "cells minus seams", in plain
/// double and without any part of the library: slow and short. It knows contacts at points only.
namespace plekton::test {

using NodeList = std::vector<int>;

/// From a point of one simplex to the nearest of another, and how far.
inline ReferenceFoot reference_separation(const NodeList& a, const std::vector<Vec3>& xa,
                                          const NodeList& b, const std::vector<Vec3>& xb) {
  ReferenceFoot best{Vec3::Zero(), std::numeric_limits<double>::infinity()};
  const auto offer = [&](const Vec3& separation) {
    if (separation.norm() < best.distance) best = {separation, separation.norm()};
  };
  const auto at = [](const std::vector<Vec3>& x, int node) {
    return x[static_cast<std::size_t>(node)];
  };
  for (const int node : a) offer(ReferenceSimplex(b, xb).foot(at(xa, node)).separation);
  for (const int node : b) offer(-ReferenceSimplex(a, xa).foot(at(xb, node)).separation);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      if (a.size() < 2 || b.size() < 2) continue;
      const Vec3 p = at(xa, a[i]), q = at(xb, b[k]);
      const Vec3 u = at(xa, a[(i + 1) % a.size()]) - p, v = at(xb, b[(k + 1) % b.size()]) - q;
      const Vec3 n = u.cross(v);
      if (n.norm() < 1e-9 * u.norm() * v.norm()) continue;  // parallel: corners have it
      const double s = (q - p).cross(v).dot(n) / n.squaredNorm();
      const double t = (q - p).cross(u).dot(n) / n.squaredNorm();
      if (s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0) offer(q + t * v - p - s * u);
    }
  }
  return best;
}

inline std::vector<NodeList> cells_of(const Body& body) {
  std::vector<NodeList> cells;
  for (const auto& facet : body.facets) cells.emplace_back(facet.begin(), facet.end());
  for (const auto& cylinder : body.cylinders) cells.emplace_back(cylinder.begin(), cylinder.end());
  for (NodeList& cell : cells) std::sort(cell.begin(), cell.end());
  return cells;
}

/// Every simplex of a body with the weight that counts a closed part of it once: 1 of a facet, 1 -
/// facets of an edge, 1 - edges + facets of a node.
inline std::map<NodeList, int> weighted_simplices(const Body& body) {
  std::map<NodeList, int> weights;
  std::set<NodeList> all;
  for (const NodeList& cell : cells_of(body)) {
    all.insert(cell);
    for (std::size_t i = 0; i < cell.size(); ++i) {
      all.insert({cell[i]});
      for (std::size_t k = i + 1; k < cell.size(); ++k) all.insert({cell[i], cell[k]});
    }
  }
  for (const NodeList& simplex : all) {
    int& weight = weights[simplex] = 1;
    for (const NodeList& other : all) {
      if (other.size() <= simplex.size()) continue;
      if (!std::includes(other.begin(), other.end(), simplex.begin(), simplex.end())) continue;
      weight += (other.size() - simplex.size()) % 2 == 1 ? -1 : 1;
    }
  }
  return weights;
}

struct ReferenceStructurePair {
  Vec3 force = Vec3::Zero();  ///< on b, for f(overlap) = overlap
  double energy = 0.0;        ///< of these, as pieces count
  int components = 0;
  int pairs = 0;             ///< of cells, in range
  double most_parallel = 0;  ///< largest |cosine| between the planes or lines of two cells in range
  bool has_rings = false;    ///< or hollows: at some level, what is nearer is more than pieces
  bool has_wraps = false;    ///< a joint of cylinders in range that bends around the other body
};

/// Of two cells the cosine of the angle between them: of normals or axes, 0 if parallel to each
/// other cannot be.
inline double alignment(const NodeList& a, const std::vector<Vec3>& xa, const NodeList& b,
                        const std::vector<Vec3>& xb) {
  const auto direction = [](const NodeList& cell, const std::vector<Vec3>& x) -> Vec3 {
    const auto at = [&](std::size_t i) { return x[static_cast<std::size_t>(cell[i])]; };
    const Vec3 u = at(1) - at(0);
    return cell.size() == 2 ? u.normalized() : u.cross(at(2) - at(0)).normalized();
  };
  const double cosine = std::abs(direction(a, xa).dot(direction(b, xb)));
  return a.size() == b.size() ? cosine : std::sqrt(1.0 - std::min(1.0, cosine * cosine));
}

/// Whether the cylinders at a node that only cylinders have bend around another body in range, seen
/// along the separations from its simplices that are nearest where they are (the others take each
/// other off).
inline bool bends_around(const Body& chain, int node, const Body& other, double range) {
  const Vec3& at = chain.x[static_cast<std::size_t>(node)];
  Vec3 arms = Vec3::Zero();
  int count = 0;
  for (const NodeList& cell : cells_of(chain)) {
    if (std::find(cell.begin(), cell.end(), node) == cell.end()) continue;
    if (cell.size() != 2) return false;
    const int end = cell[0] == node ? cell[1] : cell[0];
    arms += (chain.x[static_cast<std::size_t>(end)] - at).normalized();
    ++count;
  }
  const auto all = weighted_simplices(other);
  for (const auto& weighted : all) {
    const auto& simplex = weighted.first;
    const ReferenceFoot foot = reference_separation(simplex, other.x, {node}, chain.x);
    if (count < 2 || !(foot.distance < range) || !(foot.separation.dot(arms) < 0.0)) continue;
    const bool is_beaten = std::any_of(all.begin(), all.end(), [&](const auto& larger) {
      return std::includes(larger.first.begin(), larger.first.end(), simplex.begin(),
                           simplex.end()) &&
             reference_separation(larger.first, other.x, {node}, chain.x).distance <
                 (1.0 - 1e-12) * foot.distance;
    });
    if (!is_beaten) return true;
  }
  return false;
}

/// Pieces alone, and nothing of rings and wraps.
/// @param levels  m, gets the number of pieces integrated over the levels
inline ReferenceStructurePair reference_pieces(const Body& a, const Body& b, double range,
                                               double* levels = nullptr) {
  struct Pair {
    NodeList a;
    NodeList b;
  };
  struct Seam {
    ReferenceFoot foot;
    std::size_t i;
    std::size_t k;
  };
  ReferenceStructurePair result;
  double pieces = 0.0;  // m, their number integrated over the levels
  std::vector<Pair> pairs;
  for (const NodeList& cell_a : cells_of(a)) {
    for (const NodeList& cell_b : cells_of(b)) {
      const ReferenceFoot foot = reference_separation(cell_a, a.x, cell_b, b.x);
      if (!(foot.distance < range)) continue;
      result.force += (range - foot.distance) / foot.distance * foot.separation;
      result.energy += 0.5 * (range - foot.distance) * (range - foot.distance);
      pieces += range - foot.distance;
      result.most_parallel = std::max(result.most_parallel, alignment(cell_a, a.x, cell_b, b.x));
      pairs.push_back({cell_a, cell_b});
    }
  }
  std::vector<Seam> seams;
  const auto shared = [](const NodeList& one, const NodeList& other) {
    NodeList nodes;
    std::set_intersection(one.begin(), one.end(), other.begin(), other.end(),
                          std::back_inserter(nodes));
    return nodes;
  };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t k = i + 1; k < pairs.size(); ++k) {
      if (pairs[i].a != pairs[k].a && pairs[i].b != pairs[k].b) continue;
      const NodeList on_a = shared(pairs[i].a, pairs[k].a), on_b = shared(pairs[i].b, pairs[k].b);
      if (on_a.empty() || on_b.empty()) continue;
      const ReferenceFoot foot = reference_separation(on_a, a.x, on_b, b.x);
      if (foot.distance < range) seams.push_back({foot, i, k});
    }
  }
  std::stable_sort(seams.begin(), seams.end(), [](const Seam& one, const Seam& other) {
    return one.foot.distance < other.foot.distance;
  });
  std::vector<std::size_t> root(pairs.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i];
    return i;
  };
  result.pairs = result.components = static_cast<int>(pairs.size());
  for (const Seam& seam : seams) {
    if (find(seam.i) == find(seam.k)) continue;
    root[find(seam.i)] = find(seam.k);
    result.force -= (range - seam.foot.distance) / seam.foot.distance * seam.foot.separation;
    result.energy -= 0.5 * (range - seam.foot.distance) * (range - seam.foot.distance);
    pieces -= range - seam.foot.distance;
    --result.components;
  }
  if (levels != nullptr) *levels = pieces;
  return result;
}

inline ReferenceStructurePair reference_structure_pair(const Body& a, const Body& b, double range) {
  double pieces = 0.0;
  ReferenceStructurePair result = reference_pieces(a, b, range, &pieces);
  if (result.pairs == 0) return result;
  const auto wraps = [range](const Body& chain, const Body& other) {
    for (std::size_t node = 0; node < chain.x.size(); ++node)
      if (bends_around(chain, static_cast<int>(node), other, range)) return true;
    return false;
  };
  result.has_wraps = wraps(a, b) || wraps(b, a);
  double euler_number = 0.0;  // m, likewise
  const auto of_a = weighted_simplices(a), of_b = weighted_simplices(b);
  for (const auto& [simplex_a, weight_a] : of_a) {
    for (const auto& [simplex_b, weight_b] : of_b) {
      if (weight_a * weight_b == 0) continue;
      const double distance = reference_separation(simplex_a, a.x, simplex_b, b.x).distance;
      euler_number += weight_a * weight_b * std::max(0.0, range - distance);
    }
  }
  result.has_rings = std::abs(euler_number - pieces) > 1e-12 * range;
  return result;
}

}  // namespace plekton::test
