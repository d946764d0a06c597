// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/patch_successors.hpp"

#include "geometry/critical/descent.hpp"

#include <algorithm>

namespace plekton::contact {
namespace {

/// The patch that has a feature as a minimum; patches.size() if none has.
std::uint32_t patch_with_minimum(Feature feature, std::span<const Patch> patches,
                                 const PatchFinder& finder) {
  for (std::uint32_t i = 0; i < patches.size(); ++i) {
    for (const PatchTerm& term : finder.terms(patches[i])) {
      if (term.is_minimum && term.core.feature == feature) return i;
    }
  }
  return static_cast<std::uint32_t>(patches.size());
}

}  // namespace

std::span<const std::uint32_t> PatchSuccessors::find(std::span<const Feature> minima,
                                                     const Vec3& centre, Positions x,
                                                     std::span<const Patch> patches,
                                                     const PatchFinder& finder) {
  successors_.clear();
  for (const Feature minimum : minima) {
    std::uint32_t successor = patch_with_minimum(minimum, patches, finder);
    if (successor == patches.size()) {
      successor =
          patch_with_minimum(geometry::descend(*surface_, minimum, centre, x), patches, finder);
    }
    if (successor != patches.size()) successors_.push_back(successor);
  }
  std::sort(successors_.begin(), successors_.end());
  successors_.erase(std::unique(successors_.begin(), successors_.end()), successors_.end());
  return successors_;
}

}  // namespace plekton::contact
