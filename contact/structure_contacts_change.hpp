// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/structure_contacts.hpp"
#include "geometry/surface_change.hpp"

/// What becomes of the contacts of structures that lose some of their elements.
namespace plekton::contact {

template <ContactLaw Law>
double StructureContacts<Law>::follow(const geometry::SurfaceChange& change,
                                      std::span<const geometry::CellPair> pairs,
                                      const ContactMaterials<Law>& materials, const Motion& at,
                                      geometry::ThreadPool& pool) {
  double lost = 0.0;
  const bool had_pairs = !pairs_.empty();
  if (had_pairs) {
    std::vector<geometry::CellPair> listed;
    for (const PairOfCells& pair : pairs_) listed.push_back(pair.cells);
    lost += normal_energy(change.before(), listed, at, pool);
    renumber(change);
  }
  if (!bonds_.empty()) lost += keep_bonds(change);
  surface_ = &change.after();
  terms_ = structure::PairTerms(*surface_);
  // Where pairs were listed patches may be left of them, which the terms of now know nothing of.
  if (!had_pairs && pairs.empty()) return lost;
  lost += rebuild(pairs, materials);
  return lost - normal_energy(*surface_, pairs, at, pool);
}

/// J, of the elastic normal forces and of the attraction where the nodes are at a moment.
template <ContactLaw Law>
double StructureContacts<Law>::normal_energy(const geometry::Surface& surface,
                                             std::span<const geometry::CellPair> pairs,
                                             const Motion& at, geometry::ThreadPool& pool) const {
  structure::PairTerms terms(surface);
  terms.rebuild(pairs);
  terms.evaluate(springs_, at, pool);
  double energy = 0.0;
  for (const std::uint32_t acting : terms.acting()) {
    energy += terms[acting].forces.energy;
    if (const structure::PairForces* of = terms.attraction(acting)) energy += of->energy;
  }
  return energy;
}

/// Pairs of cells keep their patches. Those of a torn facet go to its sides that hold the nearest
/// points: there the contact goes on.
template <ContactLaw Law>
void StructureContacts<Law>::renumber(const geometry::SurfaceChange& change) {
  std::vector<PairOfCells> left;
  for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
    const PairOfCells& pair = pairs_[i];
    const auto a = change.now(pair.cells.a);
    const auto b = change.now(pair.cells.b);
    if (a && b) {
      left.push_back({{*a, *b}, pair.patch, pair.is_turned});
      left.back().spread = pair.spread;
    } else if (pair.patch >= 0) {
      hand_to_sides(pair, terms_.carriers(i), change, left);
    }
  }
  std::stable_sort(left.begin(), left.end(),
                   [](const PairOfCells& p, const PairOfCells& q) { return p.cells < q.cells; });
  left.erase(
      std::unique(left.begin(), left.end(),
                  [](const PairOfCells& p, const PairOfCells& q) { return p.cells == q.cells; }),
      left.end());
  pairs_.swap(left);
}

/// @param carriers  corners of the features of both cells that hold the nearest points
template <ContactLaw Law>
void StructureContacts<Law>::hand_to_sides(const PairOfCells& pair,
                                           const std::array<geometry::FeatureNodes, 2>& carriers,
                                           const geometry::SurfaceChange& change,
                                           std::vector<PairOfCells>& left) const {
  const auto has = [&](geometry::CellId cell, const geometry::FeatureNodes& feature) {
    const auto nodes = change.after().nodes_of(cell);
    return std::all_of(feature.begin(), feature.end(), [&](NodeId node) {
      return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
    });
  };
  const bool is_of_one =
      change.before().structure_of(pair.cells.a) == change.before().structure_of(pair.cells.b);
  for (const geometry::CellId a : change.left_of(pair.cells.a)) {
    for (const geometry::CellId b : change.left_of(pair.cells.b)) {
      if (!has(a, carriers[0]) || !has(b, carriers[1])) continue;
      const bool swaps = is_of_one && b < a;  // within one structure the lower cell comes first
      left.push_back({swaps ? geometry::CellPair{b, a} : geometry::CellPair{a, b}, pair.patch,
                      pair.is_turned != swaps});
    }
  }
}

}  // namespace plekton::contact
