// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/patch.hpp"

#include "geometry/descent.hpp"

#include <algorithm>
#include <limits>

namespace plekton::contact {
namespace {

/// A walk downhill from a pass in range ends in range, but for the last ulp of the distances: there
/// the overlap of the pass is nothing but rounding, and the pass is left out.
constexpr std::uint32_t kOutOfRange = std::numeric_limits<std::uint32_t>::max();

bool nearer(const geometry::CriticalFeature* a, const geometry::CriticalFeature* b) noexcept {
  return a->distance != b->distance ? a->distance < b->distance : a->core.feature < b->core.feature;
}

}  // namespace

std::span<const Patch> PatchFinder::find(const Vec3& centre, double range,
                                         std::span<const geometry::CellId> cells, Positions x) {
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

  link_passes(centre, range, x);
  weigh_passes();
  collect_patches();
  return patches_;
}

void PatchFinder::link_passes(const Vec3& centre, double range, Positions x) {
  vertices_.clear();
  const auto vertex_count = static_cast<std::uint32_t>(minima_.size() + passes_.size());
  for (std::uint32_t i = 0; i < vertex_count; ++i)
    vertices_.push_back({critical_of(i).core.feature, i});
  std::sort(vertices_.begin(), vertices_.end());

  links_.clear();
  pass_links_.clear();
  for (auto i = static_cast<std::uint32_t>(minima_.size()); i < vertex_count; ++i)
    add_links(i, centre, range, x);
}

void PatchFinder::add_links(std::uint32_t pass, const Vec3& centre, double range, Positions x) {
  const Critical& upper = critical_of(pass);
  const auto first = static_cast<std::uint32_t>(links_.size());
  for (const Feature branch : critical_.branches(upper.core.feature, centre, x)) {
    const std::uint32_t below = vertex_below(branch, centre, x);
    if (below == kOutOfRange) {
      links_.resize(first);
      return;
    }
    const double drop = std::max(0.0, upper.distance - critical_of(below).distance);
    links_.push_back({below, pass, link_resistance(range - upper.distance, drop)});
  }
  pass_links_.push_back({pass, first, static_cast<std::uint32_t>(links_.size()) - first});
}

/// The first minimum or pass on the way down.
std::uint32_t PatchFinder::vertex_below(Feature branch, const Vec3& centre, Positions x) const {
  Feature foot = geometry::closest_feature(*surface_, branch, centre, x);
  while (true) {
    const auto found = std::lower_bound(vertices_.begin(), vertices_.end(), Vertex{foot, 0});
    if (found != vertices_.end() && found->feature == foot) return found->id;
    const Feature next = geometry::downhill_from(*surface_, foot, centre, x);
    if (next == foot) return kOutOfRange;
    foot = geometry::closest_feature(*surface_, next, centre, x);
  }
}

void PatchFinder::weigh_passes() {
  const auto weights = spanning_.find(static_cast<std::uint32_t>(vertices_.size()), links_);
  for (std::uint32_t minimum = 0; minimum < minima_.size(); ++minimum) {
    add_term(spanning_.root_of(minimum), *minima_[minimum], 1.0);
  }
  for (const PassLinks& links : pass_links_) {
    double joined = -1.0;  // the pass itself is no minimum
    for (std::uint32_t i = 0; i < links.link_count; ++i) joined += weights[links.first_link + i];
    const std::uint32_t root = spanning_.root_of(links.pass);
    if (joined != 0.0 && root < minima_.size()) add_term(root, critical_of(links.pass), -joined);
  }
}

void PatchFinder::add_term(std::uint32_t root, const Critical& feature, double weight) {
  rooted_.push_back({root,
                     static_cast<std::uint32_t>(rooted_.size()),
                     {feature.core, feature.direction, feature.distance, weight}});
}

void PatchFinder::collect_patches() {
  // minima_ is sorted by distance and a root is the lowest of its vertices: the root's minimum is
  // the deepest one.
  const auto root_feature = [this](const RootedTerm& rooted) {
    return minima_[rooted.root]->core.feature;
  };
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
