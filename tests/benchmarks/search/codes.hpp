// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/benchmarks/search/shapes.hpp"

#include <span>

/// The same questions to Plekton, to CGAL's AABB tree and to FCL. Each file includes one of them.
namespace plekton::benchmarks {

/// What a code took, and what it found.
struct Answer {
  double build_s;   ///< s, from points and facets to what can be asked
  double ask_s;     ///< s, all questions
  double distance;  ///< m, the sum of the distances that were found, by which codes are compared
};

/// Nearest points, with the facets that hold them, of a surface to points (m).
Answer nearest_by_plekton(const Shape& shape, std::span<const geometry::Vec3> points);
Answer nearest_by_cgal(const Shape& shape, std::span<const geometry::Vec3> points);

/// The smallest distance of two surfaces, with the facets between which it is.
Answer distance_by_plekton(const Shape& a, const Shape& b);
Answer distance_by_fcl(const Shape& a, const Shape& b);

}  // namespace plekton::benchmarks
