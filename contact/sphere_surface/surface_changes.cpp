// SPDX-License-Identifier: GPL-3.0-or-later
// What becomes of the contacts of spheres with a surface that loses some of its elements.
#include "contact/sphere_surface/surface_contacts.hpp"
#include "geometry/primitives/surface_change.hpp"

namespace plekton::contact {

double SurfaceContacts::follow(const geometry::SurfaceChange& change,
                               std::span<const geometry::CellId> cells, Positions at) {
  double lost = released_by(change, cells, at);
  for (Pair& pair : pairs_) {
    pair.single_face = kNoFace;
    if (pair.contacts.count > 0) lost += keep_minima(pair, change);
  }
  // What the last step did where elements are gone is not told any more.
  records_.keep_if([&](SurfaceForce& record) {
    const auto now = change.now(record.core.feature);
    if (now) record.core.feature = *now;
    return now.has_value();
  });
  surface_ = &change.after();
  watch_ = DeferredPairs(*surface_);
  workers_.clear();
  return lost;
}

/// Elastic energy (J) of normal forces before, minus what it is afterwards, where the nodes are at
/// a moment. Only pairs with a cell that is gone have changed: a feature in range has all its cells
/// in the list.
double SurfaceContacts::released_by(const geometry::SurfaceChange& change,
                                    std::span<const geometry::CellId> cells, Positions at) const {
  PatchFinder before(change.before());
  PatchFinder after(change.after());
  double released = 0.0;
  std::vector<geometry::CellId> left;
  for (const Pair& pair : pairs_) {
    const auto near = cells.subspan(pair.near.first, pair.near.count);
    if (std::all_of(near.begin(), near.end(),
                    [&](geometry::CellId cell) { return change.now(cell).has_value(); }))
      continue;
    left.clear();
    for (const geometry::CellId cell : near) {
      const auto of_cell = change.left_of(cell);
      left.insert(left.end(), of_cell.begin(), of_cell.end());
    }
    std::sort(left.begin(), left.end());
    left.erase(std::unique(left.begin(), left.end()), left.end());
    released += normal_energy(pair, before, near, at) - normal_energy(pair, after, left, at);
  }
  return released;
}

double SurfaceContacts::normal_energy(const Pair& pair, PatchFinder& finder,
                                      std::span<const geometry::CellId> cells, Positions x) {
  if (cells.empty()) return 0.0;
  const NormalPart one = pair.normal();
  const NormalLaw law(one, pair.range);
  const Vec3& centre = x[index_of(pair.node)];
  double energy = 0.0;
  for (const Patch& patch : finder.find(centre, pair.reach, cells, x, law)) {
    for (const PatchTerm& term : finder.terms(patch))
      energy += term.weight * law.energy(term.distance) + term.energy;
  }
  return energy;
}

/// A contact goes on from the minima that are left; without any nothing follows it. @returns the
/// energy (J) of the histories that are lost
double SurfaceContacts::keep_minima(const Pair& pair, const geometry::SurfaceChange& change) {
  double lost = 0.0;
  Lists& lists = current_[static_cast<std::size_t>(pair.contacts.worker)];
  for (std::uint32_t i = 0; i < pair.contacts.count; ++i) {
    Contact& contact = lists.contacts[pair.contacts.first + i];
    Feature* const minima = lists.minima.data() + contact.first_minimum;
    std::uint32_t left = 0;
    for (std::uint32_t m = 0; m < contact.minimum_count; ++m) {
      if (const auto minimum = change.now(minima[m])) minima[left++] = *minimum;
    }
    contact.minimum_count = left;
    if (left == 0) lost += forget<AnyLaw>(pair.parameters, contact.memory, {});
  }
  return lost;
}

}  // namespace plekton::contact
