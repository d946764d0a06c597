// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/takeover/yade_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

namespace plekton::apps::yade {
namespace {

using Pair = std::array<std::size_t, 2>;

constexpr double kSame = 1e-6;  // relative: what rounding and YADE's shortened pi may differ by
constexpr double kUnreachable = 10.0;  // strain: no beam is still one when it has it

Pair sorted(std::size_t a, std::size_t b) {
  return {std::min(a, b), std::max(a, b)};
}

/// What stands out most among values that should be one: the middle one, and how far others are off.
struct Spread {
  double middle = 0.0;
  double largest = 0.0;  ///< relative difference
};

Spread spread_of(std::vector<double> values) {
  std::ranges::sort(values);
  Spread spread{values[values.size() / 2], 0.0};
  const double difference = std::max(values.back() - spread.middle, spread.middle - values.front());
  if (difference > 0.0) spread.largest = difference / std::abs(spread.middle);
  return spread;
}

/// Makes the grids one after the other out of the scene.
class GridMaker {
 public:
  GridMaker(const Scene& scene, std::vector<std::string>& notes)
      : scene_(scene), notes_(notes), root_(scene.nodes.size()) {
    std::iota(root_.begin(), root_.end(), std::size_t{0});
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) place_[scene.nodes[i].id] = i;
    for (const Bond& bond : scene.bonds)
      bonds_[sorted(place_.at(bond.nodes[0]), place_.at(bond.nodes[1]))] = &bond;
    for (const GridConnection& c : scene.connections) join(c.nodes[0], c.nodes[1]);
    for (const PFacet& f : scene.pfacets) {
      join(f.nodes[0], f.nodes[1]);
      join(f.nodes[1], f.nodes[2]);
    }
  }

  std::vector<Grid> made() {
    std::map<std::size_t, std::vector<std::size_t>> members;  // by root, which is the lowest
    for (std::size_t i = 0; i < root_.size(); ++i) members[root_of(i)].push_back(i);
    std::size_t single = 0;
    std::vector<Grid> grids;
    for (const auto& [root, nodes] : members) {
      if (nodes.size() > 1)
        grids.push_back(grid_of(root, nodes, grids.size()));
      else
        ++single;
    }
    if (single > 0)
      notes_.push_back(fmt::format("{} grid nodes without a connection: left out", single));
    note_bonds_without_connection();
    return grids;
  }

 private:
  std::size_t root_of(std::size_t i) {
    while (root_[i] != i) i = root_[i] = root_[root_[i]];
    return i;
  }
  void join(int a, int b) {
    const std::size_t ra = root_of(place_.at(a)), rb = root_of(place_.at(b));
    root_[std::max(ra, rb)] = std::min(ra, rb);
  }

  void note(std::size_t number, const std::string& what) {
    notes_.push_back(fmt::format("membrane \"grid {}\": {}", number, what));
  }

  Grid grid_of(std::size_t root, const std::vector<std::size_t>& nodes, std::size_t number) {
    Grid grid;
    grid.nodes = nodes;
    std::map<std::size_t, std::size_t> within;
    for (std::size_t i = 0; i < nodes.size(); ++i) within[nodes[i]] = i;
    std::vector<double> radii;
    std::set<int> materials;
    std::set<Pair> sides, told;
    for (const PFacet& f : scene_.pfacets) {
      std::array<std::size_t, 3> n{};
      for (std::size_t i = 0; i < 3; ++i) n[i] = place_.at(f.nodes[i]);
      if (root_of(n[0]) != root) continue;
      grid.facets.push_back({within[n[0]], within[n[1]], within[n[2]]});
      for (std::size_t i = 0; i < 3; ++i) sides.insert(sorted(n[i], n[(i + 1) % 3]));
      radii.push_back(f.radius);
      materials.insert(f.material);
      grid.material = f.material;
    }
    const bool has_facets = !grid.facets.empty();
    for (const GridConnection& c : scene_.connections) {
      const Pair pair = sorted(place_.at(c.nodes[0]), place_.at(c.nodes[1]));
      if (root_of(pair[0]) != root) continue;
      radii.push_back(c.radius);
      materials.insert(c.material);
      if (!has_facets) grid.material = c.material;
      if (!told.insert(pair).second)
        note(number, fmt::format("two connections between the bodies {} and {}: taken once",
                                 c.nodes[0], c.nodes[1]));
    }
    for (const Pair& pair : told)
      if (!sides.contains(pair)) grid.bars.push_back(sorted(within[pair[0]], within[pair[1]]));
    std::ranges::sort(grid.bars);
    const auto without = static_cast<std::size_t>(
        std::ranges::count_if(sides, [&](const Pair& side) { return !told.contains(side); }));
    if (without > 0)
      note(number, fmt::format("{} sides of PFacets have no connection in YADE; here each is a bar "
                               "with a beam, as all others",
                               without));
    if (materials.size() > 1)
      note(
          number,
          fmt::format("its connections and PFacets are of {} materials; taken: that of the last {}",
                      materials.size(), has_facets ? "PFacet" : "connection"));
    const Spread radius = spread_of(std::move(radii));
    grid.radius = radius.middle;
    if (radius.largest > kSame)
      note(number, fmt::format("its radii differ by up to {:.2g} %; taken: {} m",
                               100.0 * radius.largest, radius.middle));
    sides.insert(told.begin(), told.end());
    set_beams(grid, sides, number);
    set_density(grid, sides, number);
    note_material_of_nodes(grid, number);
    return grid;
  }

  double distance(const Pair& pair) const {
    return (scene_.nodes[pair[1]].position - scene_.nodes[pair[0]].position).norm();
  }

  /// Section and modulus, by the stiffnesses of YADE's bonds.
  void set_beams(Grid& grid, const std::set<Pair>& edges, std::size_t number) {
    const double area = std::numbers::pi * grid.radius * grid.radius;
    const double moment = 0.25 * area * grid.radius * grid.radius;
    std::vector<double> moduli, ratios, shear, strengths;
    std::size_t missing = 0, limp = 0;
    double strain = 0.0, force = 0.0;
    for (const Pair& edge : edges) {
      const auto found = bonds_.find(edge);
      if (found == bonds_.end() || found->second->is_broken) {
        ++missing;
        continue;
      }
      const Bond& bond = *found->second;
      const double modulus = bond.normal_stiffness * bond.rest_length / area;
      moduli.push_back(modulus);
      if (bond.bending_stiffness > 0.0 && bond.twisting_stiffness > 0.0) {
        // kr = E I / L, ktw = G 2 I / L, E = 2 G (1 + nu)
        ratios.push_back(bond.bending_stiffness / bond.twisting_stiffness - 1.0);
        shear.push_back(bond.bending_stiffness * bond.rest_length / (modulus * moment));
      } else {
        ++limp;
      }
      const double reached = bond.adhesion / (bond.normal_stiffness * bond.rest_length);
      if (reached < kUnreachable) {
        strengths.push_back(bond.adhesion / area);
        grid.is_fragile = bond.is_fragile;
      }
      strain = std::max(strain, std::abs(distance(edge) / bond.rest_length - 1.0));
      force = std::max(force, bond.force);
    }
    if (moduli.empty()) {
      note(number, "no beam holds its nodes together; the young_modulus is that of its material");
      grid.young_modulus = scene_.materials[static_cast<std::size_t>(grid.material)].young;
      return;
    }
    if (missing > 0)
      note(number,
           fmt::format("{} of {} sides have no beam in YADE, or a broken one; here each has "
                       "one",
                       missing, edges.size()));
    const Spread modulus = spread_of(std::move(moduli));
    grid.young_modulus = modulus.middle;
    if (modulus.largest > kSame)
      note(number, fmt::format("the moduli of its beams differ by up to {:.2g} %; taken: {:.6g} Pa",
                               100.0 * modulus.largest, modulus.middle));
    if (strain > kSame)
      note(number, fmt::format("its beams are stretched by up to {:.2g} % ({:.3g} N) where it is "
                               "taken over; here they are at rest there, as are their bending and "
                               "torsion",
                               100.0 * strain, force));
    grid.bends = !ratios.empty();
    if (grid.bends && limp > 0)
      note(number, fmt::format("{} of its beams do not bend in YADE; here all do", limp));
    if (grid.bends)
      note(number,
           "across its beams YADE 2023 has 2 r / length of their stiffness in shear, so they "
           "bend more there; here they have all of it");
    if (grid.bends) set_bending(grid, std::move(ratios), std::move(shear), number);
    if (!strengths.empty()) grid.strength = spread_of(std::move(strengths)).middle;
  }

  void set_bending(Grid& grid, std::vector<double> ratios, std::vector<double> bending,
                   std::size_t number) {
    const Spread ratio = spread_of(std::move(ratios));
    grid.poisson_ratio = std::min(ratio.middle, 0.5);
    if (ratio.middle > 0.5)
      note(number,
           fmt::format("its beams resist torsion as if Poisson's ratio were {:.3g}; here it "
                       "is at most 0.5, torsion {:.3g} times as stiff as in YADE",
                       ratio.middle, (1.0 + ratio.middle) / 1.5));
    const Spread bend = spread_of(std::move(bending));
    if (std::abs(bend.middle - 1.0) > kSame || bend.largest > kSame)
      note(number, fmt::format("its beams resist bending {:.3g} times as much as round bars of "
                               "their radius; here they are such bars",
                               bend.middle));
  }

  /// By the mass of the nodes, which are the ends of round bars here.
  void set_density(Grid& grid, const std::set<Pair>& edges, std::size_t number) {
    const double area = std::numbers::pi * grid.radius * grid.radius;
    std::map<std::size_t, double> halves;  // m³
    double volume = 0.0, mass = 0.0;
    for (const Pair& edge : edges) {
      const double half = 0.5 * area * distance(edge);
      for (const std::size_t node : edge) halves[node] += half;
      volume += 2.0 * half;
    }
    for (const std::size_t node : grid.nodes) mass += scene_.nodes[node].mass;
    grid.density = mass / volume;
    double largest = 0.0, inertia = 0.0;
    for (const std::size_t node : grid.nodes) {
      const GridNode& told = scene_.nodes[node];
      largest = std::max(largest, std::abs(halves[node] * grid.density / told.mass - 1.0));
      const double ball = 0.4 * told.mass * grid.radius * grid.radius;
      inertia = std::max(inertia, std::abs(told.inertia / ball - 1.0));
    }
    if (largest > kSame)
      note(number, fmt::format("the mass of nodes differs by up to {:.2g} %; that of all together "
                               "is the same",
                               100.0 * largest));
    if (inertia > kSame && grid.bends)
      note(number, fmt::format("moments of inertia of nodes differ by up to {:.2g} % from 2/5 m r²",
                               100.0 * inertia));
  }

  /// Walls touch nodes in YADE, also below PFacets, and nodes have a material of their own.
  void note_material_of_nodes(const Grid& grid, std::size_t number) {
    if (scene_.walls.empty() || grid.material < 0) return;
    const Material& here = scene_.materials[static_cast<std::size_t>(grid.material)];
    for (const std::size_t node : grid.nodes) {
      if (scene_.nodes[node].material < 0) continue;
      const Material& there =
          scene_.materials[static_cast<std::size_t>(scene_.nodes[node].material)];
      if (there.young == here.young && there.poisson == here.poisson &&
          there.friction_angle == here.friction_angle)
        continue;
      note(number,
           fmt::format("in YADE walls touch its nodes, which are of the material \"{}\"; here "
                       "its surface, of \"{}\"",
                       there.label, here.label));
      return;
    }
  }

  void note_bonds_without_connection() {
    std::set<Pair> told;
    for (const GridConnection& c : scene_.connections)
      told.insert(sorted(place_.at(c.nodes[0]), place_.at(c.nodes[1])));
    const auto count = static_cast<std::size_t>(std::ranges::count_if(
        bonds_, [&](const auto& bond) { return !told.contains(bond.first); }));
    if (count > 0)
      notes_.push_back(
          fmt::format("{} beams between grid nodes have no connection: left out", count));
  }

  const Scene& scene_;
  std::vector<std::string>& notes_;
  std::vector<std::size_t> root_;
  std::map<int, std::size_t> place_;  // of a node, by its id
  std::map<Pair, const Bond*> bonds_;
};

}  // namespace

std::vector<Grid> grids_of(const Scene& scene, std::vector<std::string>& notes) {
  return GridMaker(scene, notes).made();
}

}  // namespace plekton::apps::yade
