// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/surface_pressure_check.hpp"

#include "dynamics/loads/surface_pressure.hpp"
#include "dynamics/model/scene.hpp"
#include "geometry/primitives/node_sets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <tuple>

namespace plekton::dynamics {
namespace {

/// A side of a facet, from its lower to its higher node.
struct Side {
  NodeId low, high;
  int direction;  ///< 1 if the facet goes round from low to high, else -1
  std::size_t facet;
};

/// Sorted: the sides of one edge follow each other.
std::vector<Side> sides_of(std::span<const geometry::Facet> facets) {
  std::vector<Side> sides;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    for (const auto& [from, to] : geometry::sides_of(facets[i]))
      sides.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1, i});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.facet) < std::tie(b.low, b.high, b.facet);
  });
  return sides;
}

/// Calls visit(span of sides) for each edge.
template <class Visit>
void for_each_edge(const std::vector<Side>& sides, Visit&& visit) {
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin + 1;
    while (end < sides.size() && sides[end].low == sides[begin].low &&
           sides[end].high == sides[begin].high)
      ++end;
    visit(std::span(sides).subspan(begin, end - begin));
    begin = end;
  }
}

/// The facets that exist; a line for each that does not or is named twice.
std::vector<geometry::Facet> facets_of(const SurfacePressure& load, const Scene& scene,
                                       const std::string& name, std::ostream& problems) {
  const std::vector<geometry::Facet>& all = scene.elements.facets;
  std::vector<bool> named(all.size(), false);
  std::vector<geometry::Facet> facets;
  for (const geometry::FaceId facet : load.facets) {
    const auto id = static_cast<std::int32_t>(facet);
    if (id < 0 || index_of(facet) >= all.size()) {
      problems << name << ": there is no facet " << id << ", only " << all.size() << " facets\n";
    } else if (named[index_of(facet)]) {
      problems << name << ": names facet " << id << " twice; name it once\n";
    } else {
      named[index_of(facet)] = true;
      facets.push_back(all[index_of(facet)]);
    }
  }
  if (load.facets.empty()) problems << name << ": has no facets; give at least one\n";
  return facets;
}

void list_facets_the_other_way(const SurfacePressure& load, std::span<const geometry::Facet> facets,
                               const std::string& name, std::ostream& problems) {
  const auto two = opposite_neighbours(facets);
  if (!two) return;
  problems << name << ": facets " << index_of(load.facets[(*two)[0]]) << " and "
           << index_of(load.facets[(*two)[1]])
           << " are neighbours but face opposite ways; swap two nodes of one of them\n";
}

void list_gas_problems(const Gas& gas, const std::string& name, std::ostream& problems) {
  if (!(gas.outside_pressure >= 0.0) || !std::isfinite(gas.outside_pressure))
    problems << name << ": outside pressure " << gas.outside_pressure
             << " Pa must be finite and not negative\n";
  if (!(gas.exponent > 0.0) || !std::isfinite(gas.exponent))
    problems << name << ": exponent " << gas.exponent << " of the gas must be above 0\n";
}

void list_row_problems(const PressureByVolume& pressure, const std::string& name,
                       std::ostream& problems) {
  if (pressure.rows.empty())
    problems << name << ": its pressure by volume has no rows; give at least one\n";
  for (std::size_t i = 0; i < pressure.rows.size(); ++i) {
    const auto& [volume, value] = pressure.rows[i];
    if (!std::isfinite(volume) || !std::isfinite(value))
      problems << name << ": row " << i << " of its pressure by volume is not finite\n";
    else if (i > 0 && !(volume > pressure.rows[i - 1][0]))
      problems << name << ": row " << i << " of its pressure by volume is at " << volume
               << " m3, not above " << pressure.rows[i - 1][0]
               << " m3 of the row before; list the rows by increasing volume\n";
  }
}

/// Of what needs a volume.
/// @param name_and_what  as in "surface pressure 0: a gas"
void list_volume_problems(std::span<const geometry::Facet> facets, const Scene& scene,
                          const std::string& name_and_what, std::ostream& problems) {
  if (!are_closed(facets)) {
    problems << name_and_what << " needs a closed surface, and this one is open; give a pressure "
             << "without it, or close it\n";
    return;
  }
  std::vector<std::array<NodeId, 3>> corners;
  for (const geometry::Facet& facet : facets) corners.push_back(facet.nodes);
  const double volume = facets.empty() ? 1.0 : volume_under(corners, scene.state.position);
  if (!(volume > 0.0))
    problems << name_and_what << " needs a volume, and this surface encloses " << volume
             << " m3; let its facets face outward\n";
}

}  // namespace

bool are_closed(std::span<const geometry::Facet> facets) {
  bool closed = true;
  for_each_edge(sides_of(facets), [&](std::span<const Side> sides) {
    int sum = 0;
    for (const Side& side : sides) sum += side.direction;
    closed = closed && sum == 0;
  });
  return closed;
}

std::optional<std::array<std::size_t, 2>> opposite_neighbours(
    std::span<const geometry::Facet> facets) {
  std::optional<std::array<std::size_t, 2>> two;
  for_each_edge(sides_of(facets), [&](std::span<const Side> sides) {
    if (two || sides.size() != 2 || sides[0].direction != sides[1].direction) return;
    two = {sides[0].facet, sides[1].facet};
  });
  return two;
}

double lowest_gas_pressure(const SurfacePressure& load) noexcept {
  const std::vector<TimeTable::Row>& rows = load.factor.rows();
  double lowest = std::numeric_limits<double>::infinity();
  for (const TimeTable::Row& row : rows)
    lowest = std::min(lowest, load.gas->outside_pressure + load.pressure * row.value);
  return lowest;
}

void list_problems(const SurfacePressure& load, const Scene& scene, const std::string& name,
                   std::ostream& problems) {
  const std::vector<geometry::Facet> facets = facets_of(load, scene, name, problems);
  if (!std::isfinite(load.pressure))
    problems << name << ": its pressure is " << load.pressure << " Pa; it must be finite\n";
  if (load.gas) list_gas_problems(*load.gas, name, problems);
  if (load.gas && lowest_gas_pressure(load) < 0.0)
    problems << name << ": leaves its gas " << lowest_gas_pressure(load)
             << " Pa, outside pressure and pressure times factor; let no sum be below 0\n";
  if (load.by_volume) list_row_problems(*load.by_volume, name, problems);
  if (load.by_volume && (load.gas || load.pressure != 0.0))
    problems << name << ": has a pressure by volume and another pressure or a gas; give one\n";
  if (load.start_volume && !(*load.start_volume > 0.0 && std::isfinite(*load.start_volume)))
    problems << name << ": its volume at the start is " << *load.start_volume
             << " m3; it must be positive and finite\n";
  if (facets.size() != load.facets.size()) return;
  for (const geometry::Facet& facet : facets) {
    for (const NodeId node : facet.nodes) {
      if (static_cast<std::int32_t>(node) < 0 || index_of(node) >= scene.state.size()) return;
    }
  }
  list_facets_the_other_way(load, facets, name, problems);
  if (load.gas) list_volume_problems(facets, scene, name + ": a gas", problems);
  if (load.by_volume)
    list_volume_problems(facets, scene, name + ": a pressure by volume", problems);
}

}  // namespace plekton::dynamics
