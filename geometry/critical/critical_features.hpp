// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/elements.hpp"
#include "geometry/primitives/proximity.hpp"

#include <span>
#include <vector>

/// Which features of a surface push on a point: the critical points of the distance on the union of
/// its cells.
///
/// Near a feature, the directions along the surface in which the distance to the point falls form
/// its descending link. Exact signs tell which they are, so the link and its Euler number chi are
/// exact too:
///
///     feature  directions that fall                                   coefficient
///     face     none, if the foot point is inside                      1, else 0
///     edge     one for each facet on it that falls away from it       1 - facets
///     node     edges that fall are points, facets with two falling    1 - edges + facets
///              sides join them
///
/// coefficient = 1 - chi(descending link), and the sum of all coefficients is the Euler number of
/// the surface, for every point, as long as facets have an area and edges a length: the self-test
/// of the signs. A feature without descending directions is a minimum of the distance; one whose
/// link has several pieces (branches) is a saddle between as many basins. Source: Morse theory of
/// distance functions (Edelsbrunner & Harer, Computational Topology, 2010, VI); feasible regions of
/// contact: Chen et al., Offset Geometric Contact (2025).
namespace plekton::geometry {

/// Descending link of a feature, as seen from a point.
struct DescendingLink {
  int coefficient;  ///< 1 - Euler number of the link; 0 also without a foot point on the feature
  int branches;     ///< connected pieces of the link: 0 at a minimum, -1 without a foot point
};

/// A feature with a foot point of the query point, that is a minimum, a saddle or a maximum of the
/// distance.
struct CriticalFeature {
  CorePoint core;   ///< the foot point
  Vec3 direction;   ///< unit, from the query point to the foot point
  double distance;  ///< m
  int coefficient;
  int branches;

  bool is_minimum() const noexcept { return branches == 0; }
  bool is_saddle() const noexcept { return branches >= 2; }
};

/// Finds critical features; keeps its working space, so that a warm query does not allocate. One
/// per thread.
class CriticalFeatureFinder {
 public:
  explicit CriticalFeatureFinder(const Surface& surface) : surface_(&surface) {}

  /// Critical features nearer than range (m) to a point that are owned by one of the cells.
  ///
  /// If cells holds every cell nearer than range, each critical feature in range is found once,
  /// whatever else it holds. Facets without area and edges without length never push; their rims
  /// and end nodes do. A point on the surface itself has distance 0, and a direction perpendicular
  /// to the feature that depends on the feature alone.
  /// @param cells  ascending
  /// @param x      positions of all nodes of the surface
  /// @returns      in order of the owning cells; valid until the next call
  std::span<const CriticalFeature> find(const Vec3& point, double range,
                                        std::span<const CellId> cells, Positions x);

  /// Link of any feature, without a range or ownership.
  DescendingLink link(Feature feature, const Vec3& point, Positions x);

  /// One cell downhill for each branch of the link of an edge or a node that has a foot point: of a
  /// branch of several the one that comes nearest to the point. Ascending.
  /// @returns  valid until the next call
  std::span<const Feature> branches(Feature feature, const Vec3& point, Positions x);

 private:
  DescendingLink face_link(FaceId face, const Vec3& point, Positions x) const;
  DescendingLink edge_link(EdgeId edge, const Vec3& point, Positions x) const;
  DescendingLink node_link(NodeId node, const Vec3& point, Positions x);
  bool falls_into(FaceId face, EdgeId edge, const Vec3& point, Positions x) const;
  std::uint32_t piece_root(std::uint32_t i) const noexcept;
  void find_on_face(FaceId face, const Vec3& point, double range, Positions x);
  void find_on_edge(EdgeId edge, const Vec3& point, double range, Positions x);
  void find_on_node(NodeId node, const Vec3& point, double range, Positions x);
  void keep(const CriticalFeature& foot, DescendingLink link);

  const Surface* surface_;
  std::vector<CriticalFeature> found_;
  std::vector<EdgeId> falling_edges_;
  std::vector<std::uint32_t> piece_;
  std::vector<Feature> branches_;
};

}  // namespace plekton::geometry
