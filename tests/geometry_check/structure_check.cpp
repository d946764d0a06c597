// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/geometry_check/structure_check.hpp"

#include "tests/geometry_check/slope.hpp"
#include "tests/support/structure_rule_reference.hpp"

#include <algorithm>
#include <limits>

namespace plekton::geometry_check {
namespace {

using geometry::Vec3;
using test::Random;

constexpr double kRange = Structures::kRange;

/// m, of a distance: coordinates are below 1 m, a moved one is rounded by eps / 4 of that, those of
/// both ends together by sqrt(6) / 4 eps.
constexpr double kRounding = std::numeric_limits<double>::epsilon();

/// m. Shares of tilts change over some 3e-4 of a length of 0.1 (contact/surface_surface/
/// tilt_share.hpp): a third of that is still smooth. Two tenths of it are above rounding.
constexpr double kLargestStep = 1.2e-5;

/// Structures whose nodes move.
struct Moving {
  StructureScene& scene;
  const StructureRule& rule;
  std::vector<Vec3> x;  ///< m
  std::vector<Vec3> ways;

  StructurePush at(double part) const {
    std::vector<Vec3> there;
    for (std::size_t i = 0; i < x.size(); ++i) there.push_back(x[i] + part * ways[i]);
    return rule(scene, there);
  }
  Forces forces_at(double part) const { return at(part).forces; }
  double power(const StructurePush& push) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += push.forces[i].dot(ways[i]);
    return sum;
  }
};

/// Whether there is anything to be checked.
bool is_touched(const Structures& structures, const StructureScene& scene,
                const StructurePush& push) {
  return structures.do_cross == (scene.crossings() > 0) && push.energy > 0.0;
}

bool have_bars(const Structures& structures) {
  return !structures.a.cylinders.empty() || !structures.b.cylinders.empty();
}

std::vector<Vec3> any_ways(std::size_t count, Random& random) {
  std::vector<Vec3> ways;
  for (std::size_t i = 0; i < count; ++i) ways.push_back(random.in_cube(1.0));
  return ways;
}

/// What lies above comes down.
std::vector<Vec3> down(const std::vector<Vec3>& x) {
  std::vector<Vec3> ways;
  for (const Vec3& at : x) ways.emplace_back(0.0, 0.0, at.z() > 0.5 * kRange ? -1.0 : 0.0);
  return ways;
}

/// Every node a little beside where it is.
std::vector<Vec3> beside(std::vector<Vec3> x, Random& random) {
  const double way = std::pow(10.0, random.uniform(-6.0, -4.0));
  for (Vec3& at : x) at += way * random.in_cube(1.0);
  return x;
}

std::optional<Slope> slope_of(const Moving& moving, const StructurePush& here) {
  const double size = size_of(here.forces);
  return slope_at([&](double part) { return moving.at(part).energy; },
                  {kLargestStep, kRounding * size, 1e-7 * size});
}

/// Calls visit(moving, push, slope) at the first of a few places where the energy is smooth.
template <class Visit>
std::optional<bool> where_smooth(const Structures& structures, const StructureRule& rule,
                                 Random& random, Visit visit) {
  constexpr int kPlaces = 4;
  StructureScene scene(structures);
  const auto x = structures.nodes();
  for (int k = 0; k < kPlaces; ++k) {
    const auto there = beside(x, random);
    const Moving moving{scene, rule, there, any_ways(x.size(), random)};
    const StructurePush here = moving.at(0.0);
    if (!is_touched(structures, scene, here)) return std::nullopt;
    if (const auto slope = slope_of(moving, here)) return visit(moving, here, *slope);
  }
  return std::nullopt;
}

bool is_slope(const Moving& moving, const StructurePush& here, const Slope& slope) {
  return std::abs(slope.value + moving.power(here)) < 1e-7 * size_of(here.forces);
}

}  // namespace

StructurePush push_of_structures(StructureScene& scene, const std::vector<Vec3>& x) {
  return scene.push(x);
}

std::optional<bool> have_gradient(const Structures& structures, const StructureRule& rule,
                                  Random& random) {
  if (!structures.are_sheets || random.coin())
    return where_smooth(structures, rule, random, is_slope);
  StructureScene scene(structures);
  const auto x = structures.nodes();
  const Moving moving{scene, rule, x, down(x)};
  const StructurePush here = moving.at(0.0);
  if (!is_touched(structures, scene, here)) return std::nullopt;
  const auto slope = slope_of(moving, here);
  if (!slope) return std::nullopt;
  return is_slope(moving, here, *slope);
}

std::optional<bool> are_balanced(const Structures& structures, const StructureRule& rule,
                                 Random& random) {
  StructureScene scene(structures);
  const bool has_bars = have_bars(structures);
  const auto x = has_bars ? beside(structures.nodes(), random) : structures.nodes();
  const StructurePush push = rule(scene, x);
  if (!is_touched(structures, scene, push)) return std::nullopt;
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) {
    force += push.forces[i];
    moment += x[i].cross(push.forces[i]);
  }
  const double tolerance = (has_bars ? 1e-10 : 1e-12) * size_of(push.forces);
  return force.norm() <= tolerance && moment.norm() <= tolerance;
}

std::optional<bool> count_pieces(const Structures& structures, const StructureRule& rule) {
  if (structures.are_sheets) return std::nullopt;
  StructureScene scene(structures);
  const StructurePush push = rule(scene, structures.nodes());
  const auto pieces = test::reference_pieces(structures.a, structures.b, kRange);
  if (scene.crossings() != 0 || !(pieces.energy > 0.0)) return std::nullopt;
  // Less parallel than this facets touch at points (contact/surface_surface/extended.hpp).
  const bool have_facets = !structures.a.facets.empty() || !structures.b.facets.empty();
  if (have_facets && pieces.most_parallel > 0.89) return std::nullopt;
  // Bars that cross share with points whose separation is up to that slope off the nearest: each
  // pair of cells, and of their joints, loses no more than the force of all times what that is.
  constexpr double kTilt = contact::structure::kLargestTilt;
  constexpr double kFarther = 0.5 * kTilt * kTilt * kRange;
  const double lost = 3.0 * pieces.pairs * kFarther * std::sqrt(2.0 * pieces.energy);
  // A ring takes four pairs of cells. One that is left when another is filled may miss what it gave
  // too much (contact/counting/cycle_weights.hpp).
  const double missing = pieces.pairs < 4 ? 1e-9 : 0.064;
  return push.energy >= (1.0 - missing) * pieces.energy - lost;
}

namespace {

/// Whether steps change the energy by no more than forces do. These are those at both ends, and a
/// few times as much: what touches in a small part of the step may push harder there.
bool is_continuous(const Moving& moving) {
  const auto energy_at = [&](double part) -> Forces {
    return {moving.at(part).energy * Vec3::UnitX()};
  };
  double step = kLargestStep;
  const double size = std::max(size_of(moving.forces_at(0.0)), size_of(moving.forces_at(step)));
  constexpr double kMost = 4.0;
  for (const double change : steepest_changes(energy_at, step)) {
    if (!(change <= size * (kMost * step + 4.0 * kRounding))) return false;
    step = std::ldexp(step, -kHalvings);
  }
  return true;
}

bool is_in_proportion(const Moving& moving, const StructurePush& here, const Slope& slope) {
  // N/m over N: shares of tilts make what is rounded by an angle a force.
  constexpr double kStiffness = 1e4;
  return is_proportional([&](double part) { return moving.forces_at(part); }, slope,
                         kStiffness * kRounding * size_of(here.forces));
}

}  // namespace

std::optional<bool> keep_energy(const Structures& structures, const StructureRule& rule,
                                Random& random) {
  if (have_bars(structures)) return std::nullopt;
  StructureScene scene(structures);
  const auto x = structures.nodes();
  if (!is_touched(structures, scene, rule(scene, x))) return std::nullopt;
  const Moving moving{scene, rule, x, any_ways(x.size(), random)};
  const auto energy_at = [&](double part) -> Forces {
    return {moving.at(part).energy * Vec3::UnitX()};
  };
  const double energy = std::max(moving.at(0.0).energy, moving.at(kRange).energy);
  constexpr double kJump = 0.01;
  return steepest_changes(energy_at, kRange).back() <= kJump * energy;
}

std::optional<bool> follow(const Structures& structures, const StructureRule& rule,
                           Random& random) {
  const auto in_proportion = where_smooth(structures, rule, random, is_in_proportion);
  if (!in_proportion || !*in_proportion || have_bars(structures)) return in_proportion;
  StructureScene scene(structures);
  const auto x = structures.nodes();
  return is_continuous({scene, rule, x, any_ways(x.size(), random)});
}

}  // namespace plekton::geometry_check
