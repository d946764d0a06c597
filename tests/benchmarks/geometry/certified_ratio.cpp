// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/geometry/certified_ratio.hpp"

#include "geometry/closest/point_triangle.hpp"
#include "tests/support/point_triangle_families.hpp"

#include <algorithm>
#include <chrono>

namespace plekton::benchmarks {
namespace {

using geometry::Vec3;
using Json = nlohmann::ordered_json;

constexpr std::size_t kQueries = 65536;  // so many that no branch can be learnt by heart
constexpr int kRuns = 15;

/// What a plain routine gives: nearest point by weights, separation and distance.
struct PlainPoint {
  Vec3 weights;
  Vec3 separation;
  double distance;
};

PlainPoint at_weights(const Vec3& p, const std::array<Vec3, 3>& x, const Vec3& weights) {
  const Vec3 separation = (x[0] - p) + weights[1] * (x[1] - x[0]) + weights[2] * (x[2] - x[0]);
  return {weights, separation, separation.norm()};
}

/// Regions by the signs of products in double, as in Ericson, Real-Time Collision Detection (2005),
/// 5.1.5.
PlainPoint plain_point_triangle(const Vec3& p, const std::array<Vec3, 3>& x) {
  const Vec3 u = x[1] - x[0], v = x[2] - x[0], w = p - x[0];
  const double uw = u.dot(w), vw = v.dot(w);
  if (uw <= 0.0 && vw <= 0.0) return at_weights(p, x, {1, 0, 0});
  const Vec3 w1 = p - x[1];
  const double uw1 = u.dot(w1), vw1 = v.dot(w1);
  if (uw1 >= 0.0 && vw1 <= uw1) return at_weights(p, x, {0, 1, 0});
  const double c = uw * vw1 - uw1 * vw;
  if (c <= 0.0 && uw >= 0.0 && uw1 <= 0.0) {
    const double t = uw / (uw - uw1);
    return at_weights(p, x, {1 - t, t, 0});
  }
  const Vec3 w2 = p - x[2];
  const double uw2 = u.dot(w2), vw2 = v.dot(w2);
  if (vw2 >= 0.0 && uw2 <= vw2) return at_weights(p, x, {0, 0, 1});
  const double b = uw2 * vw - uw * vw2;
  if (b <= 0.0 && vw >= 0.0 && vw2 <= 0.0) {
    const double t = vw / (vw - vw2);
    return at_weights(p, x, {1 - t, 0, t});
  }
  const double a = uw1 * vw2 - uw2 * vw1;
  if (a <= 0.0 && vw1 - uw1 >= 0.0 && uw2 - vw2 >= 0.0) {
    const double t = (vw1 - uw1) / ((vw1 - uw1) + (uw2 - vw2));
    return at_weights(p, x, {0, 1 - t, t});
  }
  const double sum = a + b + c;
  return at_weights(p, x, {a / sum, b / sum, c / sum});
}

/// ns for each query. The sum keeps the compiler from leaving anything out.
template <class Queries, class Kernel>
double time_of(const Queries& queries, Kernel kernel, double& sum) {
  const auto start = std::chrono::steady_clock::now();
  for (const auto& query : queries) sum += kernel(query).distance;
  const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
  return time.count() / static_cast<double>(queries.size());
}

std::vector<test::PointTriangle> point_triangles(test::Family family) {
  test::PointTriangleFamilies families(1);
  std::vector<test::PointTriangle> queries;
  while (queries.size() < kQueries) queries.push_back(families.draw(family));
  return queries;
}

Json ratio_on(const char* data, test::Family family) {
  const auto queries = point_triangles(family);
  double certified = 1e300, plain = 1e300, sum = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    certified = std::min(
        certified,
        time_of(
            queries,
            [](const test::PointTriangle& q) { return geometry::point_triangle(q.p, q.x); }, sum));
    plain = std::min(
        plain,
        time_of(
            queries, [](const test::PointTriangle& q) { return plain_point_triangle(q.p, q.x); },
            sum));
  }
  return {{"kernel", "point-triangle"}, {"data", data}, {"ns", certified}, {"plain_ns", plain},
          {"ratio", certified / plain}, {"check", sum}};
}

}  // namespace

std::vector<Json> certified_ratios() {
  using test::Family;
  return {ratio_on("generic", Family::generic),
          ratio_on("over edges of flat grids", Family::rotated_flat_grid),
          ratio_on("integer grid", Family::integer_grid), ratio_on("on edges", Family::on_an_edge)};
}

}  // namespace plekton::benchmarks
