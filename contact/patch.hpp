// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/motion.hpp"
#include "contact/spanning_weights.hpp"
#include "geometry/critical_features.hpp"

#include <span>
#include <vector>

/// Contact of a ball with a surface: features in range that hang together are one patch, and a
/// patch is one contact.
///
/// The elastic force of a patch is the sum of weight * f(gap) * normal over its terms: weight 1 for
/// each minimum of the distance, and for each pass between them minus the weight that keeps a
/// connected part counted once (spanning_weights.hpp). So a flat or convex surface pushes exactly
/// once, a sharp corner from both sides, and the force is continuous in between, with no tolerance:
/// the natural scale is the overlap itself.
namespace plekton::contact {

using geometry::Feature;

/// What one critical feature adds to a patch. Side a is the ball, side b the surface.
struct PatchTerm {
  geometry::CorePoint core;  ///< on b
  Vec3 normal;               ///< unit, from the ball's centre to the core point
  double distance;           ///< m
  double weight;  ///< 1 of a minimum; minus what it joins of a pass: -k between k + 1 parts where
                  ///< no ring closes, and above that, up to 1, where rings do
};

/// One contact of a ball with a surface.
struct Patch {
  Feature root;  ///< its deepest minimum; of equals the lowest feature
  std::uint32_t first_term;
  std::uint32_t term_count;
};

/// Finds patches; keeps its working space. One per thread.
class PatchFinder {
 public:
  explicit PatchFinder(const geometry::Surface& surface) : surface_(&surface), critical_(surface) {}

  /// Patches of a ball on the surface's cells.
  /// @param centre  m, of the ball
  /// @param range   m, ball's radius + radius of the cells: what counts as in range
  /// @param cells   ascending; every cell nearer than range, all of one radius
  /// @returns       sorted by root; valid until the next call
  std::span<const Patch> find(const Vec3& centre, double range,
                              std::span<const geometry::CellId> cells, Positions x);

  std::span<const PatchTerm> terms(const Patch& patch) const noexcept {
    return {terms_.data() + patch.first_term, patch.term_count};
  }
  std::span<PatchTerm> terms(const Patch& patch) noexcept {
    return {terms_.data() + patch.first_term, patch.term_count};
  }

 private:
  using Critical = geometry::CriticalFeature;

  void link_passes(const Vec3& centre, double range, Positions x);
  void add_links(std::uint32_t pass, const Vec3& centre, double range, Positions x);
  std::uint32_t vertex_below(Feature branch, const Vec3& centre, Positions x) const;
  const Critical& critical_of(std::uint32_t vertex) const noexcept {
    return vertex < minima_.size() ? *minima_[vertex] : *passes_[vertex - minima_.size()];
  }
  void weigh_passes();
  void add_term(std::uint32_t root, const Critical& feature, double weight);
  void collect_patches();

  const geometry::Surface* surface_;
  geometry::CriticalFeatureFinder critical_;
  SpanningWeights spanning_;
  std::vector<Patch> patches_;
  std::vector<PatchTerm> terms_;

  /// The links of a pass down to the minima and passes below it.
  struct PassLinks {
    std::uint32_t pass;  ///< its vertex
    std::uint32_t first_link;
    std::uint32_t link_count;
  };
  /// A feature as a vertex of the graph: minima first, then passes.
  struct Vertex {
    Feature feature;
    std::uint32_t id;
    friend constexpr auto operator<=>(const Vertex&, const Vertex&) = default;
  };
  std::vector<const Critical*> minima_;  ///< nearest first
  std::vector<const Critical*> passes_;  ///< nearest first
  std::vector<Vertex> vertices_;         ///< by feature
  std::vector<PassLinks> pass_links_;
  std::vector<Link> links_;
  struct RootedTerm {
    std::uint32_t root;
    std::uint32_t order;
    PatchTerm term;
  };
  std::vector<RootedTerm> rooted_;
};

}  // namespace plekton::contact
