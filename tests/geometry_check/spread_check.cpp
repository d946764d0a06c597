// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/geometry_check/spread_check.hpp"

#include "contact/counting/wrap.hpp"

#include <algorithm>
#include <limits>

namespace plekton::geometry_check {
namespace {

using namespace plekton::geometry;
using contact::Patch;
using contact::PatchFinder;
using contact::PatchTerm;
using test::Random;

constexpr double kRange = SpreadTouch::kRange;

/// What all patches do.
struct Total {
  double energy = 0.0;
  Vec3 on_ball = Vec3::Zero();
  std::vector<Vec3> on_nodes;
  double deepest = 0.0;  ///< m, overlap
  std::size_t terms = 0;
};

Total total_of(PatchFinder& finder, const Surface& surface, const Vec3& centre, Positions x) {
  Total total;
  total.on_nodes.assign(x.size(), Vec3::Zero());
  for (const Patch& patch : finder.find(centre, kRange, test::all_cells(surface), x)) {
    for (const PatchTerm& term : finder.terms(patch)) {
      const double overlap = kRange - term.distance;
      const Vec3 force = (term.weight * overlap + term.slope) * term.normal;
      total.energy += 0.5 * term.weight * overlap * overlap + term.energy;
      total.on_ball -= force;
      for (int k = 0; k < 3; ++k)
        total.on_nodes[index_of(term.core.nodes[static_cast<std::size_t>(k)])] +=
            term.core.weights[k] * force;
      if (term.is_minimum) total.deepest = std::max(total.deepest, overlap);
      ++total.terms;
    }
  }
  return total;
}

std::vector<Vec3> moved(const std::vector<Vec3>& x, const std::vector<Vec3>& ways, double part) {
  std::vector<Vec3> result;
  for (std::size_t i = 0; i < x.size(); ++i) result.push_back(x[i] + part * ways[i]);
  return result;
}

double least_bar(const test::Complex& complex) {
  double least = std::numeric_limits<double>::infinity();
  for (const Cylinder& bar : complex.cylinders)
    least = std::min(
        least, (complex.x[index_of(bar.nodes[1])] - complex.x[index_of(bar.nodes[0])]).norm());
  return least;
}

}  // namespace

bool has_gradient(const SpreadTouch& touch, Random& random) {
  const Surface surface = touch.complex.surface();
  PatchFinder finder(surface);
  const auto& x = touch.complex.x;
  // Differences tell the slope of what has a curvature: not right over a seam, where a surface that
  // bends with the step has one on either side.
  const double deepest = total_of(finder, surface, touch.centre, x).deepest;
  const Vec3 centre = touch.centre + 0.03 * deepest * random.in_cube(1.0);
  const Total here = total_of(finder, surface, centre, x);
  std::vector<Vec3> ways(x.size(), Vec3::Zero());
  Vec3 way = Vec3::Zero();
  if (random.coin()) {
    ways[random.index(x.size())] = random.in_cube(1.0);
  } else {
    for (Vec3& w : ways) w = random.in_cube(1.0);
    way = random.in_cube(1.0);
  }
  double power = here.on_ball.dot(way);
  for (std::size_t i = 0; i < x.size(); ++i) power += here.on_nodes[i].dot(ways[i]);
  const auto energy_at = [&](double part) {
    return total_of(finder, surface, centre + part * way, moved(x, ways, part)).energy;
  };
  const double scale = here.deepest * std::sqrt(static_cast<double>(here.terms));
  // Differences of the fourth order. Where a feature comes into range within a step the slope has a
  // kink, and a smaller step sees less of it, until distances are rounded.
  for (const double part : {1e-4, 1e-5, 1e-6, 1e-7, 3e-8}) {
    const double step = part * here.deepest;
    const double slope = (8.0 * (energy_at(step) - energy_at(-step)) -
                          (energy_at(2.0 * step) - energy_at(-2.0 * step))) /
                         (12.0 * step);

    if (std::abs(slope + power) < (1e-7 + 1e-15 * kRange / step) * scale) return true;
  }
  return false;
}

bool counts_one(const SpreadTouch& touch) {
  const Surface surface = touch.complex.surface();
  PatchFinder finder(surface);
  const Total total = total_of(finder, surface, touch.centre, touch.complex.x);
  const double one = 0.5 * total.deepest * total.deepest;
  const double missing = touch.complex.facets.empty() ? 1e-9 : 2e-3;
  return total.energy >= (1.0 - missing) * one - 1e-15;
}

bool is_pushed_away(const SpreadTouch& touch) {
  const Surface surface = touch.complex.surface();
  PatchFinder finder(surface);
  const Total total = total_of(finder, surface, touch.centre, touch.complex.x);
  Vec3 away = Vec3::Zero();
  for (const Patch& patch :
       finder.find(touch.centre, kRange, test::all_cells(surface), touch.complex.x)) {
    for (const PatchTerm& term : finder.terms(patch)) away -= term.normal;
  }
  const double length = away.norm();
  if (!(length > 0.0)) return true;
  for (const CellId cell : test::cells_near(surface, touch.centre, kRange, touch.complex.x)) {
    for (const NodeId node : surface.nodes_of(cell)) {
      if ((touch.complex.x[index_of(node)] - touch.centre).dot(away) > 0.0) return true;
    }
  }
  return total.on_ball.dot(away) >= -1e-12 * total.deepest * length;
}

bool follows(const SpreadTouch& touch, Random& random) {
  const Surface surface = touch.complex.surface();
  PatchFinder finder(surface);
  const Total here = total_of(finder, surface, touch.centre, touch.complex.x);
  double contacts = 0.0;
  for (const CellId cell :
       test::cells_near(surface, touch.centre, kRange + here.deepest, touch.complex.x))
    contacts += surface.nodes_of(cell).size() == 3 ? 7.0 : 3.0;
  const double width_over_bar = std::sqrt(2.0 * kRange * here.deepest) / least_bar(touch.complex);
  const double turn = 0.53 / contact::kTurn * width_over_bar * width_over_bar *
                      std::hypot(1.0, 0.375 * std::numbers::pi * width_over_bar);
  // A step may lead through the core of a bar that the ball's centre lies next to.
  if (!(1.001 * here.deepest < kRange)) return true;
  const double steepness = kRange / (kRange - 1.001 * here.deepest);
  const Vec3 direction = random.direction();
  for (const double part : {1e-3, 1e-4, 1e-5}) {
    const double step = part * here.deepest;
    const Total there = total_of(finder, surface, touch.centre + step * direction, touch.complex.x);
    if ((there.on_ball - here.on_ball).norm() >
        contacts * (1.0 + turn) * steepness * (step + 1e-13))
      return false;
  }
  return true;
}

}  // namespace plekton::geometry_check
