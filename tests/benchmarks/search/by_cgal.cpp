// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/search/codes.hpp"
#include "tests/benchmarks/search/stopwatch.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <vector>

namespace plekton::benchmarks {

Answer nearest_by_cgal(const Shape& shape, std::span<const geometry::Vec3> points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
  const auto point_at = [](const geometry::Vec3& x) { return Kernel::Point_3(x[0], x[1], x[2]); };

  Answer answer{};
  Stopwatch watch;
  Triangles triangles;
  triangles.reserve(shape.facets.size());
  for (const auto& [a, b, c] : shape.facets) {
    const auto corner = [&](std::int32_t i) {
      return point_at(shape.points[static_cast<std::size_t>(i)]);
    };
    triangles.emplace_back(corner(a), corner(b), corner(c));
  }
  Tree tree(triangles.cbegin(), triangles.cend());
  tree.build();
  tree.accelerate_distance_queries();
  answer.build_s = watch.lap();
  for (const geometry::Vec3& point : points) {
    const Kernel::Point_3 p = point_at(point);
    answer.distance +=
        std::sqrt(CGAL::squared_distance(p, tree.closest_point_and_primitive(p).first));
  }
  answer.ask_s = watch.lap();
  return answer;
}

}  // namespace plekton::benchmarks
