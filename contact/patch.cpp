// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/patch.hpp"

#include "geometry/descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plekton::contact {
namespace {

/// A walk downhill from a pass in range ends in range, but for the last ulp of the distances: there the overlap of the
/// pass is nothing but rounding, and the pass is left out.
constexpr std::uint32_t kOutOfRange = std::numeric_limits<std::uint32_t>::max();

bool nearer(const geometry::CriticalFeature* a, const geometry::CriticalFeature* b) noexcept {
  return a->distance != b->distance ? a->distance < b->distance : a->core.feature < b->core.feature;
}

}  // namespace

std::span<const Patch> PatchFinder::find(const Vec3& centre, double range, std::span<const geometry::CellId> cells,
                                         Positions x) {
  const auto critical = critical_.find(centre, range, cells, x);
  minima_.clear();
  passes_.clear();
  rooted_.clear();
  for (const Critical& feature : critical) {
    if (feature.is_minimum()) minima_.push_back(&feature);
    if (feature.is_pass()) passes_.push_back(&feature);
  }
  std::sort(minima_.begin(), minima_.end(), nearer);
  std::sort(passes_.begin(), passes_.end(), nearer);

  link_basins(centre, range, x);
  weigh_passes();
  collect_patches();
  return patches_;
}

void PatchFinder::link_basins(const Vec3& centre, double range, Positions x) {
  links_.clear();
  pass_links_.clear();
  basin_count_ = static_cast<std::uint32_t>(minima_.size());
  for (const Critical* pass : passes_) add_links(*pass, centre, range, x);
}

/// A pass of two branches is a link between their basins. One of more branches is a joint of its own, linked to each
/// basin, so that no branch is treated differently; a link is then half the way, of twice the conductance.
void PatchFinder::add_links(const Critical& pass, const Vec3& centre, double range, Positions x) {
  const auto first = static_cast<std::uint32_t>(links_.size());
  const double overlap = range - pass.distance;
  const auto branches = critical_.branches(pass.core.feature, centre, x);
  basins_.clear();
  for (const Feature branch : branches) {
    const std::uint32_t basin = basin_below(branch, centre, x);
    if (basin == kOutOfRange) return;
    basins_.push_back(basin);
  }
  if (basins_.size() == 2) {
    links_.push_back({basins_[0], basins_[1], overlap});
  } else {
    const std::uint32_t joint = basin_count_++;
    for (const std::uint32_t basin : basins_) links_.push_back({basin, joint, std::sqrt(2.0) * overlap});
  }
  pass_links_.push_back({&pass, first, static_cast<std::uint32_t>(links_.size()) - first, basins_[0]});
}

std::uint32_t PatchFinder::basin_below(Feature branch, const Vec3& centre, Positions x) const {
  const Feature bottom = geometry::descend(*surface_, branch, centre, x);
  const auto found = std::find_if(minima_.begin(), minima_.end(),
                                  [&](const Critical* minimum) { return minimum->core.feature == bottom; });
  return found != minima_.end() ? static_cast<std::uint32_t>(found - minima_.begin()) : kOutOfRange;
}

void PatchFinder::weigh_passes() {
  const auto weights = spanning_.find(basin_count_, links_);
  for (std::uint32_t basin = 0; basin < minima_.size(); ++basin) {
    add_term(spanning_.root_of(basin), *minima_[basin], 1.0);
  }
  for (const PassLinks& pass : pass_links_) {
    double joined = pass.link_count > 1 ? -1.0 : 0.0;  // the joint itself is no minimum
    for (std::uint32_t i = 0; i < pass.link_count; ++i) joined += weights[pass.first_link + i];
    if (joined > 0.0) add_term(spanning_.root_of(pass.basin), *pass.pass, -joined);
  }
}

void PatchFinder::add_term(std::uint32_t root, const Critical& feature, double weight) {
  rooted_.push_back({root, static_cast<std::uint32_t>(rooted_.size()),
                     {feature.core, feature.direction, feature.distance, weight}});
}

void PatchFinder::collect_patches() {
  // minima_ is sorted by distance and a root is the lowest of its basins: the root's minimum is the deepest one.
  const auto root_feature = [this](const RootedTerm& rooted) { return minima_[rooted.root]->core.feature; };
  std::sort(rooted_.begin(), rooted_.end(), [&](const RootedTerm& a, const RootedTerm& b) {
    return a.root != b.root ? root_feature(a) < root_feature(b) : a.order < b.order;
  });
  patches_.clear();
  terms_.clear();
  for (const RootedTerm& rooted : rooted_) {
    const Feature root = root_feature(rooted);
    if (patches_.empty() || patches_.back().root != root) {
      patches_.push_back({root, static_cast<std::uint32_t>(terms_.size()), 0});
    }
    terms_.push_back(rooted.term);
    ++patches_.back().term_count;
  }
}

}  // namespace plekton::contact
