// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "contact/counting/link.hpp"
#include "contact/counting/wrap.hpp"
#include "contact/sphere_surface/merge_shares.hpp"
#include "contact/sphere_surface/normal_law.hpp"
#include "geometry/critical/critical_features.hpp"

#include <memory>
#include <span>
#include <vector>

/// Contact of a sphere with a surface: features in range that hang together are one patch, and a
/// patch is one contact.
///
/// The energy of a patch counts pieces: the part of the surface nearer than s has so many pieces,
/// for every level s, and each of them pushes as one contact. With phi(d) the energy of one contact
/// at a distance d that is the sum of phi over the minima less that over the saddles, as often as
/// each joins pieces. So a flat or convex surface pushes exactly once, a sharp corner from both
/// sides, and the force is continuous in between, with no tolerance: the natural scale is the
/// overlap itself. A saddle that closes a cycle joins nothing; what it takes too much is given
/// back, smoothly (cycle_weights.hpp). Maxima, which fill cycles or shut voids, count for nothing.
/// What a wire or a net that wraps the sphere loses as its bars hang together is given back as far
/// as it turns around it (wrap.hpp).
///
/// The energy depends on the places of the sphere and of the nodes alone, and the force on each of
/// them is its gradient, for every law: no energy is gained in any closed path of motion, however
/// the surface deforms.
namespace plekton::contact {

using geometry::Feature;
using geometry::NodeId;
using geometry::Positions;

class NearComplex;
class CycleWeights;

/// What one critical feature adds to a patch. Side a is the sphere, side b the surface.
struct PatchTerm {
  geometry::CorePoint core;  ///< on b
  Vec3 normal;               ///< unit, from the sphere's centre to the core point
  double distance;           ///< m
  double weight;             ///< of the energy of one contact at this distance
  double slope;              ///< N, what the force has beside weight * force of one contact: on
                             ///< cycles and wraps, where weights change with the distances
  double energy;             ///< J, what the energy has beside weight * energy of one contact
  double share;              ///< of what the patch holds beside its elastic force: all of it, in
                             ///< sum, is held by minima (merge_shares.hpp)
  bool is_minimum;
  bool is_inner = false;  ///< a force between nodes of the surface, along any direction: those of a
                          ///< patch cancel on the sphere or go with the push of a node, and hold
                          ///< nothing else (wrap.hpp)
};

/// One contact of a sphere with a surface.
struct Patch {
  Feature root;  ///< its deepest minimum; of equals the lowest feature
  std::uint32_t first_term;
  std::uint32_t term_count;
};

/// Finds patches; keeps its working space. One per thread.
class PatchFinder {
 public:
  explicit PatchFinder(const geometry::Surface& surface);
  PatchFinder(PatchFinder&&) noexcept;
  PatchFinder& operator=(PatchFinder&&) noexcept;
  ~PatchFinder();

  /// Patches of a sphere on the surface's cells.
  /// @param centre  m, of the sphere
  /// @param range   m, sphere's radius + radius of the cells: what counts as in range
  /// @param cells   ascending; every cell nearer than range, all of one radius
  /// @param law     of one contact: slopes of cycles depend on it, and wraps, nothing else
  /// @returns       sorted by root; valid until the next call
  std::span<const Patch> find(const Vec3& centre, double range,
                              std::span<const geometry::CellId> cells, Positions x,
                              const NormalLaw& law);
  /// For springs of 1 N/m.
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

  void keep_alone(std::span<const Critical> critical);
  void find_several(std::span<const Critical> critical, const Vec3& centre, double range,
                    std::span<const geometry::CellId> cells, Positions x, const NormalLaw& law);
  void sort_out(std::span<const Critical> critical);
  void link_saddles(const Vec3& centre, Positions x);
  void number_vertices();
  std::size_t place_of(Feature feature) const noexcept;
  void add_links(std::uint32_t saddle, const Vec3& centre, Positions x);
  std::uint32_t vertex_of(Feature foot) const noexcept;
  std::uint32_t vertex_below(Feature branch, const Vec3& centre, Positions x) const;
  const Critical& critical_of(std::uint32_t vertex) const noexcept {
    return vertex < minima_.size() ? *minima_[vertex] : *saddles_[vertex - minima_.size()];
  }
  std::uint32_t root_of(std::uint32_t vertex) const noexcept;
  void join_parts();
  void join(const Link& link);
  double share_of(std::uint32_t vertex) const noexcept {
    return vertex < minima_.size() ? shares_[vertex] : 0.0;
  }
  void add_terms_of_cycles(const Vec3& centre, double range,
                           std::span<const geometry::CellId> cells, Positions x,
                           const NormalLaw& law);
  void find_wraps(const Vec3& centre, double range, std::span<const geometry::CellId> cells,
                  Positions x, const NormalLaw& law);
  void find_wrap(geometry::NodeId node, const Vec3& centre, double range, Positions x,
                 const NormalLaw& law);
  void add_terms_of_wraps(const Vec3& centre, Positions x);
  void add_term(std::uint32_t root, const PatchTerm& term);
  void add_terms();
  void collect_patches();

  const geometry::Surface* surface_;
  geometry::CriticalFeatureFinder critical_;
  std::unique_ptr<NearComplex> near_;
  std::unique_ptr<CycleWeights> cycles_;
  std::vector<WrapArm> arms_;  ///< of a node
  std::vector<geometry::NodeId> arm_ends_;
  std::vector<double> energies_;  ///< J, by vertex of near_
  std::vector<PatchTerm> wrap_terms_;
  struct NodeTerms {
    geometry::NodeId node;
    std::size_t first, end;  ///< in wrap_terms_
  };
  std::vector<NodeTerms> wrap_nodes_;
  std::vector<Patch> patches_;
  std::vector<PatchTerm> terms_;

  /// The links of a saddle down to the minima and saddles below it.
  struct SaddleLinks {
    std::uint32_t saddle;  ///< its vertex
    std::uint32_t first_link;
    std::uint32_t link_count;
  };
  std::vector<const Critical*> minima_;   ///< nearest first
  std::vector<const Critical*> saddles_;  ///< and maxima: what is no minimum; nearest first
  // Features as vertices of the graph: minima first, then saddles.
  std::uint32_t vertex_count() const noexcept {
    return static_cast<std::uint32_t>(minima_.size() + saddles_.size());
  }
  std::vector<std::uint32_t> vertex_at_;  ///< by place of a feature
  std::vector<std::size_t> places_;       ///< that have one
  std::vector<SaddleLinks> saddle_links_;
  std::vector<Link> links_;
  std::vector<std::uint32_t> root_;  ///< by vertex: the lowest of those that hang together, or one
                                     ///< on the way to it
  std::vector<double> weights_;      ///< by vertex
  MergeShares merging_;
  std::vector<std::uint32_t> part_;  ///< in merging_, by root
  std::vector<double> distances_;    ///< m, of minima_
  std::span<const double> shares_;   ///< by minimum
  bool has_cycles_ = false;
  struct RootedTerm {
    std::uint32_t root;
    std::uint32_t order;
    PatchTerm term;
  };
  std::vector<RootedTerm> rooted_;
};

}  // namespace plekton::contact
