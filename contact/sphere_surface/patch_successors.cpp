// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/patch_successors.hpp"

#include "geometry/critical/descent.hpp"

#include <algorithm>
#include <limits>

namespace plekton::contact {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

}  // namespace

void PatchSuccessors::list_minima(std::span<const Patch> patches, const PatchFinder& finder) {
  minima_.clear();
  for (std::uint32_t i = 0; i < patches.size(); ++i) {
    for (const PatchTerm& term : finder.terms(patches[i]))
      if (term.is_minimum) minima_.emplace_back(term.core.feature, i);
  }
  std::sort(minima_.begin(), minima_.end());
}

/// The patch that has a feature as a minimum; kNone if none has.
std::uint32_t PatchSuccessors::patch_with_minimum(Feature feature) const {
  const auto at = std::ranges::lower_bound(minima_, feature, {}, &Minimum::first);
  return at != minima_.end() && at->first == feature ? at->second : kNone;
}

std::span<const std::uint32_t> PatchSuccessors::find(std::span<const Feature> minima,
                                                     const Vec3& centre, Positions x,
                                                     std::span<const Patch> patches,
                                                     const PatchFinder& finder) {
  successors_.clear();
  list_minima(patches, finder);
  for (const Feature minimum : minima) {
    std::uint32_t successor = patch_with_minimum(minimum);
    if (successor == kNone)
      successor = patch_with_minimum(geometry::descend(*surface_, minimum, centre, x));
    if (successor != kNone) successors_.push_back(successor);
  }
  std::sort(successors_.begin(), successors_.end());
  successors_.erase(std::unique(successors_.begin(), successors_.end()), successors_.end());
  return successors_;
}

}  // namespace plekton::contact
