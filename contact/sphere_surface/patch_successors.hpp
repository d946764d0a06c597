// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/sphere_surface/patch.hpp"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace plekton::contact {

/// Tells in which of this step's patches a contact of the last step lives on.
///
/// The contact's minima walk downhill on the surface as it is now (geometry/critical/descent.hpp):
/// where they arrive, the contact goes on. A walk stays inside the connected part of the contact
/// region it started in, whatever number of primitives it crosses, so history is handed over at
/// every seam, shared when a patch splits, and summed when two merge; without a tolerance, and
/// without asking which element was listed first.
class PatchSuccessors {
 public:
  explicit PatchSuccessors(const geometry::Surface& surface) : surface_(&surface) {}

  /// @param minima   features of the last step's minima of the contact
  /// @param centre   m, of the sphere, now
  /// @param patches  of this step, from finder
  /// @returns        places in patches, ascending, each once; none if the contact is over. Valid
  /// until the next call.
  std::span<const std::uint32_t> find(std::span<const Feature> minima, const Vec3& centre,
                                      Positions x, std::span<const Patch> patches,
                                      const PatchFinder& finder);

 private:
  using Minimum = std::pair<Feature, std::uint32_t>;  ///< and its patch

  void list_minima(std::span<const Patch> patches, const PatchFinder& finder);
  std::uint32_t patch_with_minimum(Feature feature) const;

  const geometry::Surface* surface_;
  std::vector<Minimum> minima_;  ///< of this step's patches, ascending
  std::vector<std::uint32_t> successors_;
};

}  // namespace plekton::contact
