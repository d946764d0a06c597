// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/geometry_check/force_check.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::geometry_check {
namespace {

using namespace plekton::geometry;
using test::Complex;
using test::Random;

/// m, from the nearest cell; infinite without any.
double distance_to(const Surface& surface, const Vec3& centre, Positions x) {
  CriticalFeatureFinder finder(surface);
  double nearest = std::numeric_limits<double>::infinity();
  for (const CriticalFeature& feature : finder.find(centre, nearest, test::all_cells(surface), x))
    nearest = std::min(nearest, feature.distance);
  return nearest;
}

/// A centre straight over a side or corner of a facet, where its nearest points pass to the
/// neighbours; or anywhere.
Vec3 hard_centre(const Surface& surface, Random& random, const Complex& complex) {
  if (surface.cell_count() == 0 || random.coin()) return test::random_point(random, complex);
  const auto nodes = surface.nodes_of(id_at<CellId>(random.index(surface.cell_count())));
  const auto at = [&](std::size_t k) -> const Vec3& {
    return complex.x[index_of(nodes[k % nodes.size()])];
  };
  const std::size_t first = random.index(nodes.size());
  const double t = random.coin() ? random.unit() : 0.5 * random.integer(0, 2);
  const Vec3 side = at(first + 1) - at(first);
  const Vec3 normal = nodes.size() == 3 ? side.cross(at(first + 2) - at(first)).eval()
                                        : side.cross(random.direction()).eval();
  return at(first) + t * side + random.signed_power(-2.0, 0.3) * normal.normalized();
}

/// How many forces the rule may add up: each cell in range, and for each of its sides and corners
/// one.
double force_count(const Touch& touch) {
  double count = 0.0;
  for (const CellId cell : test::cells_near(touch.surface, touch.centre, touch.range, touch.x))
    count += touch.surface.nodes_of(cell).size() == 3 ? 7.0 : 3.0;
  return count;
}

bool is_continuous(const Touch& from, const Vec3& to, const Vec3& change, double distance) {
  const double step = (to - from.centre).norm();
  const double steepness = std::max(1.0, from.range / (distance - step));
  Touch around = from;
  around.range += step;  // every cell that is in range on the way
  double size = from.centre.norm();
  for (const Vec3& x : from.x) size = std::max(size, x.norm());
  // Distances are right to 1e-12 and directions are divided by them.
  const double rounding = 1e-12 * size;
  return change.norm() <= force_count(around) * steepness * (step + rounding);
}

}  // namespace

std::optional<Vec3> force_of_patches(const Touch& touch) {
  const auto cells = test::cells_near(touch.surface, touch.centre, touch.range, touch.x);
  contact::PatchFinder patches(touch.surface);
  CriticalFeatureFinder critical(touch.surface);
  const auto total = test::total_contact(patches, touch.centre, touch.range, cells, touch.x);
  if (test::has_cycles_or_voids(critical, touch.centre, touch.range, cells, touch.x, total.patches))
    return std::nullopt;
  return total.force;
}

ForceTally check_force(const Complex& complex, const ForceRule& rule, Random& random, int balls) {
  ForceTally tally;
  const Surface surface = complex.surface();
  for (int k = 0; k < balls; ++k) {
    const Vec3 centre = hard_centre(surface, random, complex);
    const Vec3 to = centre + std::pow(10.0, random.uniform(-10.0, -5.0)) * random.direction();
    const double distance = distance_to(surface, centre, complex.x);
    // A ball with its centre on the surface has no direction to be pushed in.
    if (!(distance > 1e-3 && distance < 10.0)) continue;
    const double range = distance / (1.0 - std::pow(10.0, random.uniform(-6.0, std::log10(0.3))));
    const auto before = rule({surface, complex.x, centre, range});
    const auto after = rule({surface, complex.x, to, range});
    if (!before || !after) continue;
    ++tally.trials;
    tally.violations +=
        !is_continuous({surface, complex.x, centre, range}, to, *after - *before, distance);
  }
  return tally;
}

}  // namespace plekton::geometry_check
