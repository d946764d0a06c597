// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/elements.hpp"
#include "geometry/neighbours.hpp"
#include "geometry/proximity.hpp"
#include "geometry/thread_pool.hpp"

#include <memory>
#include <span>
#include <vector>

namespace plekton::geometry {

/// Geometry alone: positions in, proximities out. For whoever wants to know what is near what,
/// without any dynamics.
class ProximityQuery {
 public:
  /// @param largest_gap  m, > 0: how far apart a pair may be to be reported
  /// @throws std::invalid_argument listing every problem of the elements (see Surface; spheres
  /// whose node does not
  ///         exist or whose radius is not positive and finite) and of largest_gap
  ProximityQuery(Elements elements, std::size_t node_count, double largest_gap, int threads = 1);

  /// Every sphere with every sphere, facet and cylinder that is nearer than largest_gap: spheres
  /// with spheres first, then spheres with cells, each in ascending order of the ids. One entry for
  /// each pair of elements; use contact/patch.hpp for what pushes. Valid until the next call.
  /// @param x  m, one position for each node
  /// @throws std::invalid_argument if that are not as many as there are nodes
  std::span<const Proximity> find(Positions x);

  const Surface& surface() const noexcept { return *surface_; }

 private:
  void add_if_near(const Proximity& proximity);

  Elements elements_;
  std::vector<Sphere>
      grown_;  ///< the spheres with largest_gap more radius: what the neighbours see
  std::unique_ptr<Surface> surface_;  ///< at a fixed address, which the neighbours know
  double largest_gap_;
  ThreadPool pool_;
  std::unique_ptr<Neighbours> neighbours_;
  std::vector<Proximity> found_;
};

}  // namespace plekton::geometry
