// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/surface_query.hpp"
#include "tests/benchmarks/search/codes.hpp"
#include "tests/benchmarks/search/stopwatch.hpp"

namespace plekton::benchmarks {
namespace {

using namespace geometry;

/// m. Surfaces without a thickness are not the common case, so it has one; distances are of cores.
constexpr double kRadius = 1e-4;

Surface surface_of(const Shape& shape) {
  std::vector<Facet> facets;
  facets.reserve(shape.facets.size());
  for (const auto& [a, b, c] : shape.facets)
    facets.push_back({{NodeId{a}, NodeId{b}, NodeId{c}}, kRadius});
  return Surface({}, facets, shape.points.size());
}

}  // namespace

Answer nearest_by_plekton(const Shape& shape, std::span<const Vec3> points) {
  Answer answer{};
  Stopwatch watch;
  const Surface surface = surface_of(shape);
  const SurfaceQuery query(surface, shape.points);
  answer.build_s = watch.lap();
  for (const Vec3& point : points)
    answer.distance += query.nearest(Probe::point(point))->proximity.gap + kRadius;
  answer.ask_s = watch.lap();
  return answer;
}

Answer distance_by_plekton(const Shape& a, const Shape& b) {
  Answer answer{};
  Stopwatch watch;
  const Surface surface_a = surface_of(a), surface_b = surface_of(b);
  const SurfaceQuery query_a(surface_a, a.points), query_b(surface_b, b.points);
  answer.build_s = watch.lap();
  answer.distance = query_a.nearest(query_b)->proximity.gap + 2.0 * kRadius;
  answer.ask_s = watch.lap();
  return answer;
}

}  // namespace plekton::benchmarks
