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
  if (!pairs_.empty()) {
    std::vector<geometry::CellPair> listed;
    for (const PairOfCells& pair : pairs_) listed.push_back(pair.cells);
    lost += normal_energy(change.before(), listed, at, pool);
    renumber(change);
  }
  surface_ = &change.after();
  terms_ = structure::PairTerms(*surface_);
  if (pairs_.empty() && pairs.empty()) return lost;
  lost += rebuild(pairs, materials);
  return lost - normal_energy(*surface_, pairs, at, pool);
}

/// J, of the elastic normal forces where the nodes are at a moment.
template <ContactLaw Law>
double StructureContacts<Law>::normal_energy(const geometry::Surface& surface,
                                             std::span<const geometry::CellPair> pairs,
                                             const Motion& at, geometry::ThreadPool& pool) const {
  structure::PairTerms terms(surface);
  terms.rebuild(pairs);
  terms.evaluate(springs_, at, pool);
  double energy = 0.0;
  for (const std::uint32_t acting : terms.acting()) energy += terms[acting].forces.energy;
  return energy;
}

/// Pairs of cells keep their patches. Those of a torn facet go to its sides, where a term that acts
/// lies on the side: a patch lives as long as one of its features does.
template <ContactLaw Law>
void StructureContacts<Law>::renumber(const geometry::SurfaceChange& change) {
  std::vector<PairOfCells> left;
  for (const PairOfCells& pair : pairs_) {
    const auto a = change.now(pair.cells.a);
    const auto b = change.now(pair.cells.b);
    if (a && b) left.push_back({{*a, *b}, pair.patch, pair.is_turned});
  }
  for (const std::uint32_t acting : terms_.acting()) {
    for (const structure::Holder& holder : terms_.holders(terms_[acting]))
      hand_to_sides(terms_[acting], holder, change, left);
  }
  std::stable_sort(left.begin(), left.end(),
                   [](const PairOfCells& p, const PairOfCells& q) { return p.cells < q.cells; });
  left.erase(
      std::unique(left.begin(), left.end(),
                  [](const PairOfCells& p, const PairOfCells& q) { return p.cells == q.cells; }),
      left.end());
  pairs_.swap(left);
}

template <ContactLaw Law>
void StructureContacts<Law>::hand_to_sides(const PairTerm& term, const structure::Holder& holder,
                                           const geometry::SurfaceChange& change,
                                           std::vector<PairOfCells>& left) const {
  const PairOfCells& pair = pairs_[holder.pair];
  if (change.now(pair.cells.a) && change.now(pair.cells.b)) return;
  const auto has = [&](geometry::CellId cell, const geometry::FeatureNodes& feature) {
    const auto nodes = change.after().nodes_of(cell);
    return std::all_of(feature.begin(), feature.end(), [&](NodeId node) {
      return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
    });
  };
  for (const geometry::CellId a : change.left_of(pair.cells.a)) {
    for (const geometry::CellId b : change.left_of(pair.cells.b)) {
      if (!has(holder.is_turned ? b : a, term.a) || !has(holder.is_turned ? a : b, term.b))
        continue;
      // Within one structure the lower cell comes first.
      const bool swaps =
          b < a && surface_->structure_of(pair.cells.a) == surface_->structure_of(pair.cells.b);
      left.push_back({swaps ? geometry::CellPair{b, a} : geometry::CellPair{a, b}, pair.patch,
                      pair.is_turned != swaps});
    }
  }
}

}  // namespace plekton::contact
