// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/broad_phase.hpp"
#include "geometry/primitive_pairs.hpp"
#include "geometry/query/ray.hpp"
#include "geometry/thread_pool.hpp"

#include <optional>
#include <span>
#include <vector>

namespace plekton::geometry {

/// The cell of a surface that is nearest to something, and how.
struct NearestCell {
  CellId cell;
  Proximity proximity;  ///< a: what was asked with; b: the cell
};

/// The two cells at which two surfaces are nearest.
struct NearestCells {
  CellId a;
  CellId b;
  Proximity proximity;
};

/// Questions to a surface at one moment: what is nearest, what does a ray hit. Const functions may
/// run at the same time, and answers are the same for any number of threads.
///
/// The features that an answer names are exactly those at which its cell is nearest
/// (primitive_pairs.hpp). Which cell it is, the computed gaps decide, of equal ones the lowest
/// cell. They have rounding errors: of cells that are equally near, as those around a nearest edge
/// or node, it may be any.
///
/// A question takes O(log cells) for cells of similar size that do not crowd around the answer.
class SurfaceQuery {
 public:
  /// @param surface  must outlive this
  /// @param x        m, one position for each node; copied
  /// @throws std::invalid_argument if that are not as many as there are nodes, or a node of a cell
  /// is not finite or not below 1e75 m
  SurfaceQuery(const Surface& surface, Positions x);

  /// The nodes have moved. @throws as the constructor; then nothing has changed
  void move(Positions x);

  const Surface& surface() const noexcept { return *surface_; }
  Positions positions() const noexcept { return x_; }

  /// The cell with the smallest gap to a point, ball, cylinder or facet.
  /// @returns nothing if the surface has no cells
  /// @throws std::invalid_argument, as within() and many questions too, for a probe whose numbers
  /// are not finite or whose coordinates are not below 1e75 m
  std::optional<NearestCell> nearest(const Probe& probe) const;

  /// Every cell whose gap to a probe is less than a length (m), ascending.
  std::vector<NearestCell> within(const Probe& probe, double gap) const;

  /// The smallest gap between two surfaces, of equal ones the lowest cells, of this one first.
  /// Takes O(n log m) for n cells here and m there, and the time of one pair more for every two
  /// whose boxes are no further apart than the answer, or overlap: n m if all lie on one another.
  /// @returns nothing if one of them has no cells
  std::optional<NearestCells> nearest(const SurfaceQuery& other) const;

  /// Where a ray first enters the thick surface: of the hits of all cells (ray.hpp) the one with
  /// the smallest t, of equal t that of the lowest cell.
  std::optional<RayHit> first_hit(const Ray& ray) const;

  /// Many questions, shared by threads; the answers in the order of the questions.
  std::vector<std::optional<NearestCell>> nearest(std::span<const Probe> probes,
                                                  ThreadPool& pool) const;
  std::vector<std::optional<RayHit>> first_hits(std::span<const Ray> rays, ThreadPool& pool) const;

 private:
  void check(Positions x) const;
  void make_boxes();
  Box box_of(CellId cell, double margin) const;
  Probe probe_of(CellId cell) const;

  /// Reused by the questions of one thread.
  struct Work {
    std::vector<std::int32_t> cells;
  };
  std::optional<NearestCell> nearest(const Probe& probe, Work& work) const;
  void improve(const Probe& probe, double reach, std::optional<NearestCell>& best,
               Work& work) const;
  void improve(const SurfaceQuery& other, NearestCells& best, Work& work) const;
  double slack(const Ray& ray, double t) const;
  std::optional<RayHit> first_hit(const Ray& ray, Work& work) const;
  std::optional<RayHit> first_hit_near(const Ray& ray, double from, double to, Work& work) const;

  const Surface* surface_;
  std::vector<Vec3> x_;
  std::vector<Box> boxes_;
  BroadPhase tree_;
  Box bounds_{Vec3::Zero(), Vec3::Zero()};
  double cell_size_ = 0.0;  ///< m, mean length of the boxes' diagonals
};

}  // namespace plekton::geometry
