// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/thread_pool.hpp"
#include "geometry/query/box_tree.hpp"
#include "geometry/query/enclosure.hpp"
#include "geometry/query/nearest_search.hpp"
#include "geometry/query/ray.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plekton::geometry {

/// How far a point is from a closed surface of facets without thickness, and on which side.
struct SignedDistance {
  double distance;      ///< m, negative inside, 0 on the surface
  Side side;            ///< exact
  NearestCell nearest;  ///< by distance, of equal ones the lowest; its gap counts the radius
};

/// Questions to a surface at one moment: what is nearest, what does a ray hit, what is inside.
/// Const functions may run at the same time, and answers are the same for any number of threads.
///
/// The features that an answer names are exactly those at which its cell is nearest
/// (primitive_pairs.hpp). Which cell it is, the computed gaps decide, of equal ones the lowest
/// cell. They have rounding errors: of cells that are equally near, as those around a nearest edge
/// or node, it may be any. Cells that share the nearest feature of a point agree about its distance
/// to the last bit, so of these it is the lowest.
///
/// Making one takes O(n log n) for n cells, moving O(n). A question takes O(log n + cells as near
/// as the answer to a few ulps) from anywhere, if cells are of similar size and not nearly all as
/// far as each other, as those of a ball are from its centre.
class SurfaceQuery {
 public:
  /// @param surface  must outlive this; no temporary
  /// @param x        m, one position for each node; copied
  /// @throws std::invalid_argument if that are not as many as there are nodes, or a node of a cell
  /// is not finite or not below 1e75 m
  SurfaceQuery(const Surface& surface, Positions x);
  SurfaceQuery(const Surface&& surface, Positions x) = delete;

  /// The nodes have moved. @throws as the constructor; then nothing has changed
  void move(Positions x);

  const Surface& surface() const noexcept { return *surface_; }
  Positions positions() const noexcept { return x_; }

  /// The cell with the smallest gap to a point, ball, cylinder or facet.
  /// @returns nothing if the surface has no cells
  /// @throws std::invalid_argument, as within() and many questions too, for a probe whose numbers
  /// are not finite or whose coordinates are not below 1e75 m
  std::optional<NearestCell> nearest(const Probe& probe) const;

  /// Every cell whose gap to a probe is less than a length, ascending.
  /// @param gap  m; infinite for all cells, below 0 for those that overlap by more than that
  /// @throws std::invalid_argument also if it is NaN
  std::vector<NearestCell> within(const Probe& probe, double gap) const;

  /// The smallest gap between two surfaces, of equal ones the lowest cells, of this one first; of
  /// those that are equal to rounding it may be any.
  /// Goes down both trees: O(log n) if the surfaces are nearest in one place, and the time of one
  /// pair more for every two cells that are as near as the answer, or whose boxes are and that no
  /// plane along one of them keeps apart.
  /// @returns nothing if one of them has no cells
  std::optional<NearestCells> nearest(const SurfaceQuery& other) const;

  /// Where a ray first enters the thick surface: of the hits of all cells (ray.hpp) the one with
  /// the smallest t, of equal t that of the lowest cell.
  /// @returns nothing if it misses, or is none that can hit (can_hit()), as with a direction of
  /// zero or NaN
  std::optional<RayHit> first_hit(const Ray& ray) const;

  /// Where a ray enters each cell that it enters, by t, then by cell: one hit for every cell, so
  /// two or more with one t and one feature where it goes through an edge or a node.
  std::vector<RayHit> all_hits(const Ray& ray) const;

  /// Whether the surface encloses something: it has facets, every edge an even number of them, and
  /// no free cylinders. Decided by the nodes that facets share, not by where they are.
  bool is_closed() const noexcept { return open_reason_.empty(); }

  /// On which side of the closed surface a point is (enclosure.hpp), exactly. The radius does not
  /// count.
  /// @throws std::invalid_argument for a point as for a probe; std::logic_error that names what is
  /// open if the surface is not closed
  Side side_of(const Vec3& point) const;

  /// Distance from the closed surface with the sign of side_of(), which no rounding of the distance
  /// can turn: exactly 0 where that says on. The gap of the nearest cell is rounded also there.
  /// @throws as side_of()
  SignedDistance signed_distance(const Vec3& point) const;

  /// Many questions, shared by threads; the answers in the order of the questions.
  /// @throws std::invalid_argument that names the probes that cannot be used by their places
  std::vector<std::optional<NearestCell>> nearest(std::span<const Probe> probes,
                                                  ThreadPool& pool) const;
  std::vector<std::optional<RayHit>> first_hits(std::span<const Ray> rays, ThreadPool& pool) const;

 private:
  void check(Positions x) const;
  void require_closed() const;
  void make_boxes();
  ThickBox box_of(CellId cell) const;
  SearchedSurface searched() const noexcept { return {{*surface_, x_}, tree_}; }

  const Surface* surface_;
  std::vector<Vec3> x_;
  std::vector<ThickBox> boxes_;
  BoxTree tree_;
  Box bounds_{Vec3::Zero(), Vec3::Zero()};  ///< m, of the thick cells
  std::string open_reason_;                 ///< why the surface is not closed, empty if it is
};

}  // namespace plekton::geometry
