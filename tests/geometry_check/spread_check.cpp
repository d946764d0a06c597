// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/geometry_check/spread_check.hpp"

#include "contact/counting/wrap.hpp"
#include "tests/geometry_check/slope.hpp"

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

void add(const PatchTerm& term, SpreadPush& push) {
  const double overlap = kRange - term.distance;
  const double size = term.weight * overlap + term.slope;
  push.energy += 0.5 * term.weight * overlap * overlap + term.energy;
  push.on_ball -= size * term.normal;
  for (int k = 0; k < 3; ++k)
    push.on_nodes[index_of(term.core.nodes[static_cast<std::size_t>(k)])] +=
        term.core.weights[k] * size * term.normal;
  push.away -= term.normal;
  if (term.is_minimum) push.deepest = std::max(push.deepest, overlap);
  push.sum += std::abs(size);
}

double least_bar(const test::Complex& complex) {
  double least = std::numeric_limits<double>::infinity();
  for (const Cylinder& bar : complex.cylinders)
    least = std::min(
        least, (complex.x[index_of(bar.nodes[1])] - complex.x[index_of(bar.nodes[0])]).norm());
  return least;
}

/// A ball on a surface, both of which move.
struct Moving {
  const SpreadRule& rule;
  Surface surface;
  Vec3 centre;          ///< m
  std::vector<Vec3> x;  ///< m
  Vec3 way;             ///< of the centre
  std::vector<Vec3> ways;

  SpreadPush at(double part) const {
    std::vector<Vec3> there;
    for (std::size_t i = 0; i < x.size(); ++i) there.push_back(x[i] + part * ways[i]);
    return rule(surface, centre + part * way, there);
  }
  Forces forces_at(double part) const {
    SpreadPush push = at(part);
    push.on_nodes.push_back(push.on_ball);
    return std::move(push.on_nodes);
  }
  /// N, work of the forces by length of the way.
  double power(const SpreadPush& push) const {
    double sum = push.on_ball.dot(way);
    for (std::size_t i = 0; i < x.size(); ++i) sum += push.on_nodes[i].dot(ways[i]);
    return sum;
  }
};

/// Everything moves, or a single node. Right over a seam a surface that bends has another stiffness
/// on either side: the ball is a little beside the touch.
Moving any_motion(const SpreadTouch& touch, const SpreadRule& rule, Random& random) {
  const Surface surface = touch.complex.surface();
  const auto& x = touch.complex.x;
  const double deepest = rule(surface, touch.centre, x).deepest;
  Moving moving{rule, surface,      touch.centre + 0.03 * deepest * random.in_cube(1.0),
                x,    Vec3::Zero(), std::vector<Vec3>(x.size(), Vec3::Zero())};
  if (random.coin()) {
    moving.ways[random.index(x.size())] = random.in_cube(1.0);
  } else {
    for (Vec3& w : moving.ways) w = random.in_cube(1.0);
    moving.way = random.in_cube(1.0);
  }
  return moving;
}

/// m, of a distance: a moved coordinate below 2 ranges is rounded by eps / 2 of a range, those of
/// both ends together by sqrt(6) / 2 eps, and the distance itself by a few more eps / 2.
constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon() * kRange;

std::optional<Slope> slope_of(const Moving& moving, const SpreadPush& here) {
  return slope_at([&](double part) { return moving.at(part).energy; },
                  {4e-3 * here.deepest, kRounding * here.sum, 1e-7 * here.force()});
}

}  // namespace

double SpreadPush::force() const {
  return on_ball.norm() + size_of(on_nodes);
}

SpreadPush push_of_patches(const Surface& surface, const Vec3& centre, const std::vector<Vec3>& x) {
  SpreadPush push;
  push.on_nodes.assign(x.size(), Vec3::Zero());
  PatchFinder finder(surface);
  for (const Patch& patch : finder.find(centre, kRange, test::all_cells(surface), x)) {
    for (const PatchTerm& term : finder.terms(patch)) add(term, push);
  }
  return push;
}

std::optional<bool> has_gradient(const SpreadTouch& touch, const SpreadRule& rule, Random& random) {
  constexpr int kPlaces = 4;
  for (int k = 0; k < kPlaces; ++k) {
    const Moving moving = any_motion(touch, rule, random);
    const SpreadPush here = moving.at(0.0);
    if (const auto slope = slope_of(moving, here))
      return std::abs(slope->value + moving.power(here)) < 1e-7 * here.force();
  }
  return std::nullopt;
}

bool counts_one(const SpreadTouch& touch, const SpreadRule& rule) {
  const SpreadPush push = rule(touch.complex.surface(), touch.centre, touch.complex.x);
  const double one = 0.5 * push.deepest * push.deepest;
  const double missing = touch.complex.facets.empty() ? 1e-9 : 2e-3;
  return push.energy >= (1.0 - missing) * one - 1e-15;
}

bool is_pushed_away(const SpreadTouch& touch, const SpreadRule& rule) {
  const Surface surface = touch.complex.surface();
  const SpreadPush push = rule(surface, touch.centre, touch.complex.x);
  const double length = push.away.norm();
  if (!(length > 0.0)) return true;
  for (const CellId cell : test::cells_near(surface, touch.centre, kRange, touch.complex.x)) {
    for (const NodeId node : surface.nodes_of(cell)) {
      if ((touch.complex.x[index_of(node)] - touch.centre).dot(push.away) > 0.0) return true;
    }
  }
  return push.on_ball.dot(push.away) >= -1e-12 * push.deepest * length;
}

namespace {

/// N/m, of the force on the ball within a thousandth of the overlap.
double largest_stiffness(const SpreadTouch& touch, const Surface& surface, double deepest) {
  double contacts = 0.0;
  for (const CellId cell :
       test::cells_near(surface, touch.centre, kRange + deepest, touch.complex.x))
    contacts += surface.nodes_of(cell).size() == 3 ? 7.0 : 3.0;
  const double width_over_bar = std::sqrt(2.0 * kRange * deepest) / least_bar(touch.complex);
  const double turn = 0.53 / contact::kTurn * width_over_bar * width_over_bar *
                      std::hypot(1.0, 0.375 * std::numbers::pi * width_over_bar);
  return contacts * (1.0 + turn) * kRange / (kRange - 1.001 * deepest);
}

/// N, by which the force on the ball may jump: 0.037 of a contact, in another direction, for every
/// top that another may tie with.
double largest_jump(const SpreadTouch& touch, const Surface& surface, double deepest) {
  CriticalFeatureFinder finder(surface);
  int tops = 0;
  for (const CriticalFeature& feature :
       finder.find(touch.centre, kRange + deepest, test::all_cells(surface), touch.complex.x))
    tops += !feature.is_minimum() && !feature.is_saddle();
  return tops < 2 ? 0.0 : 0.037 * 2.0 * deepest * tops;
}

bool is_in_proportion(const SpreadTouch& touch, const SpreadRule& rule, Random& random) {
  const Moving moving = any_motion(touch, rule, random);
  const SpreadPush here = moving.at(0.0);
  const auto slope = slope_of(moving, here);
  return !slope || is_proportional([&](double part) { return moving.forces_at(part); }, *slope,
                                   kRounding * here.sum / here.deepest);
}

}  // namespace

bool follows(const SpreadTouch& touch, const SpreadRule& rule, Random& random) {
  if (!is_in_proportion(touch, rule, random)) return false;
  const Surface surface = touch.complex.surface();
  const double deepest = rule(surface, touch.centre, touch.complex.x).deepest;
  // A step may lead through the core of a bar that the ball's centre lies next to.
  if (!(1.001 * deepest < kRange)) return true;
  const double stiffness = largest_stiffness(touch, surface, deepest);
  const double jump = largest_jump(touch, surface, deepest);
  const Vec3 direction = random.direction();
  const auto force_at = [&](double part) -> Forces {
    return {rule(surface, touch.centre + part * direction, touch.complex.x).on_ball};
  };
  double step = 1e-3 * deepest;
  for (const double change : steepest_changes(force_at, step)) {
    if (!(change <= jump + stiffness * (step + 1e-13))) return false;
    step = std::ldexp(step, -kHalvings);
  }
  return true;
}

}  // namespace plekton::geometry_check
