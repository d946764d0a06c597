// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/geometry_check/invariant_check.hpp"

#include "geometry/critical/critical_features.hpp"
#include "tests/geometry_check/any_surface.hpp"
#include "tests/geometry_check/force_check.hpp"
#include "tests/geometry_check/knot_check.hpp"
#include "tests/geometry_check/spread_check.hpp"
#include "tests/geometry_check/structure_check.hpp"
#include "tests/support/contact_surfaces.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string_view>

namespace plekton::geometry_check {
namespace {

using namespace plekton::geometry;
using test::Complex;
using test::Random;

constexpr int kPointsPerSurface = 50;
constexpr std::string_view kEuler = "sum of coefficients = Euler number";
constexpr std::string_view kNumbering = "same features in any numbering";
constexpr std::string_view kLattice = "same features after a lattice motion";
constexpr std::string_view kForce = "force changes no faster than the ball";
constexpr std::string_view kGradient = "spread: force = -gradient of energy";
constexpr std::string_view kOne = "spread: one contact at least";
constexpr std::string_view kAway = "spread: pushed away from what is in front";
constexpr std::string_view kFollows = "spread: force in proportion to the step";
constexpr std::string_view kKnot = "spread: rolls over knots without a bump";
constexpr std::string_view kStructureGradient = "structures: force = -gradient of energy";
constexpr std::string_view kStructureBalance = "structures: forces and moments balance";
constexpr std::string_view kStructureCount = "structures: no less than their pieces";
constexpr std::string_view kStructureFollows = "structures: force in proportion to step";
constexpr std::string_view kCrossedGradient = "crossed: force = -gradient of energy";
constexpr std::string_view kCrossedBalance = "crossed: forces and moments balance";
constexpr std::string_view kCrossedEnergy = "crossed: no leap of the energy of shells";

bool has_euler_number(const Complex& complex, Random& random, int& trials) {
  const Surface surface = complex.surface();
  const auto features = test::features_of(surface);
  CriticalFeatureFinder finder(surface);
  for (int k = 0; k < kPointsPerSurface; ++k, ++trials) {
    const Vec3 point = test::random_point(random, complex);
    int sum = 0;
    for (const Feature feature : features)
      sum += finder.link(feature, point, complex.x).coefficient;
    if (sum != surface.euler_characteristic()) return false;
  }
  return true;
}

/// A critical feature by its nodes, so that numberings can be compared.
struct Named {
  std::vector<int> nodes;
  int coefficient;
  int branches;
  friend auto operator<=>(const Named&, const Named&) = default;
};

std::vector<Named> named_features(const Surface& surface, const Vec3& point, Positions x,
                                  const std::vector<int>& names) {
  CriticalFeatureFinder finder(surface);
  std::vector<Named> found;
  for (const CriticalFeature& feature :
       finder.find(point, std::numeric_limits<double>::infinity(), test::all_cells(surface), x)) {
    Named named{{}, feature.coefficient, feature.branches};
    for (const NodeId node : test::nodes_of(surface, feature.core.feature))
      named.nodes.push_back(names[index_of(node)]);
    std::sort(named.nodes.begin(), named.nodes.end());
    found.push_back(std::move(named));
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Old name of each node of a renumbered complex, found by its place in the list of positions.
std::vector<int> renumber(Complex& complex, Random& random) {
  std::vector<int> names(complex.x.size());
  std::iota(names.begin(), names.end(), 0);
  for (std::size_t i = names.size(); i > 1; --i) std::swap(names[i - 1], names[random.index(i)]);
  std::vector<int> place(names.size());
  std::vector<Vec3> x(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    place[static_cast<std::size_t>(names[i])] = static_cast<int>(i);
    x[i] = complex.x[static_cast<std::size_t>(names[i])];
  }
  complex.x = x;
  const auto move = [&](NodeId& node) { node = NodeId{place[index_of(node)]}; };
  for (Facet& facet : complex.facets) {
    for (NodeId& node : facet.nodes) move(node);
    std::rotate(facet.nodes.begin(), facet.nodes.begin() + random.integer(0, 2), facet.nodes.end());
  }
  for (Cylinder& cylinder : complex.cylinders) {
    for (NodeId& node : cylinder.nodes) move(node);
  }
  for (std::size_t i = complex.facets.size(); i > 1; --i)
    std::swap(complex.facets[i - 1], complex.facets[random.index(i)]);
  return names;
}

std::vector<int> own_names(const Complex& complex) {
  std::vector<int> names(complex.x.size());
  std::iota(names.begin(), names.end(), 0);
  return names;
}

bool keeps_features_in_any_numbering(const Complex& complex, Random& random, int& trials) {
  Complex other = complex;
  const auto names = renumber(other, random);
  const Surface surface = complex.surface(), renumbered = other.surface();
  for (int k = 0; k < kPointsPerSurface; ++k, ++trials) {
    const Vec3 point = test::random_point(random, complex);
    if (named_features(surface, point, complex.x, own_names(complex)) !=
        named_features(renumbered, point, other.x, names)) {
      return false;
    }
  }
  return true;
}

/// One of the 24 turns of the lattice.
Mat3 lattice_turn(Random& random) {
  std::array<int, 3> axes{0, 1, 2};
  for (std::size_t i = 3; i > 1; --i) std::swap(axes[i - 1], axes[random.index(i)]);
  Mat3 turn = Mat3::Zero();
  for (int k = 0; k < 3; ++k)
    turn(k, axes[static_cast<std::size_t>(k)]) = random.coin() ? 1.0 : -1.0;
  if (turn.determinant() < 0.0) turn.row(0) = -turn.row(0);
  return turn;
}

bool keeps_features_on_the_lattice(const Complex& complex, Random& random, int& trials) {
  const Surface surface = complex.surface();
  const Mat3 turn = lattice_turn(random);
  const Vec3 shift = random.on_lattice(-1000000, 1000000);
  const auto moved = [&](const Vec3& x) -> Vec3 { return turn * x + shift; };
  std::vector<Vec3> there;
  for (const Vec3& x : complex.x) there.push_back(moved(x));
  for (int k = 0; k < kPointsPerSurface; ++k, ++trials) {
    const Vec3 point = 0.5 * random.on_lattice(-2, 10);
    if (named_features(surface, point, complex.x, own_names(complex)) !=
        named_features(surface, moved(point), there, own_names(complex))) {
      return false;
    }
  }
  return true;
}

bool spread_holds(std::string_view name, Random& random, int& trials) {
  if (name == kKnot) {
    ++trials;
    return rolls_evenly(any_knot(random), push_of_patches);
  }
  const SpreadTouch touch = any_spread_touch(random);
  if (name == kGradient) {
    const auto seen = has_gradient(touch, push_of_patches, random);
    trials += seen.has_value();
    return seen.value_or(true);
  }
  ++trials;
  if (name == kOne) return counts_one(touch, push_of_patches);
  if (name == kAway) return is_pushed_away(touch, push_of_patches);
  if (name == kFollows) return follows(touch, push_of_patches, random);
  throw std::logic_error("an invariant without a check");
}

bool structures_hold(std::string_view name, Random& random, int& trials) {
  const Structures structures = any_structures(random);
  const auto seen = [&]() -> std::optional<bool> {
    if (name == kStructureGradient) return have_gradient(structures, push_of_structures, random);
    if (name == kStructureBalance) return are_balanced(structures, push_of_structures, random);
    if (name == kStructureCount) return count_pieces(structures, push_of_structures);
    if (name == kStructureFollows) return follow(structures, push_of_structures, random);
    throw std::logic_error("an invariant without a check");
  }();
  trials += seen.has_value();
  return seen.value_or(true);
}

bool crossed_structures_hold(std::string_view name, Random& random, int& trials) {
  const Structures structures =
      name == kCrossedEnergy ? any_crossed_shells(random) : any_crossed_structures(random);
  const auto seen = [&]() -> std::optional<bool> {
    if (name == kCrossedGradient) return have_gradient(structures, push_of_structures, random);
    if (name == kCrossedBalance) return are_balanced(structures, push_of_structures, random);
    if (name == kCrossedEnergy) return keep_energy(structures, push_of_structures, random);
    throw std::logic_error("an invariant without a check");
  }();
  trials += seen.has_value();
  return seen.value_or(true);
}

bool holds(std::string_view name, Random& random, int& trials) {
  if (name == kEuler) return has_euler_number(any_surface(random), random, trials);
  if (name == kNumbering)
    return keeps_features_in_any_numbering(any_surface(random), random, trials);
  if (name == kLattice)
    return keeps_features_on_the_lattice(test::random_complex(random, true), random, trials);
  if (name == kForce) {
    const ForceTally tally =
        check_force(any_surface(random), force_of_patches, random, kPointsPerSurface);
    trials += tally.trials;
    return tally.violations == 0;
  }
  if (name.starts_with("crossed")) return crossed_structures_hold(name, random, trials);
  return name.starts_with("structures") ? structures_hold(name, random, trials)
                                        : spread_holds(name, random, trials);
}

}  // namespace

std::vector<InvariantTally> invariant_rows() {
  return {{kEuler.data()},
          {kNumbering.data()},
          {kLattice.data()},
          {kForce.data()},
          {kGradient.data(), 2},
          {kOne.data()},
          {kAway.data()},
          {kFollows.data(), 8},
          {kKnot.data(), 2},
          {kStructureGradient.data(), 40},
          {kStructureBalance.data(), 10},
          {kStructureCount.data(), 10},
          {kStructureFollows.data(), 100},
          {kCrossedGradient.data(), 40},
          {kCrossedBalance.data(), 10},
          {kCrossedEnergy.data(), 40}};
}

void check_invariant(InvariantTally& row, std::uint64_t trials, std::uint64_t seed,
                     std::vector<std::string>& examples) {
  for (; row.trials < trials; ++seed) {
    Random random(seed);
    int done = 0;
    if (!holds(row.name, random, done)) {
      ++row.violations;
      ++done;
      if (examples.size() < 3)
        examples.push_back(std::string(row.name) + ": not on the surface of seed " +
                           std::to_string(seed));
    }
    row.trials += static_cast<std::uint64_t>(done);
  }
}

}  // namespace plekton::geometry_check
