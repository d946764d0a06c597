// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/overlap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plekton::apps {
namespace {

using contact::BodyKind;
using contact::ContactBody;
using contact::ContactRecord;

/// m; nothing for a plane.
std::optional<double> radius_of(const ContactBody& body, const dynamics::Simulation& simulation) {
  const auto i = static_cast<std::size_t>(body.index);
  if (body.kind == BodyKind::plane) return std::nullopt;
  if (body.kind == BodyKind::sphere) return simulation.elements().spheres[i].radius;
  return simulation.surface().radius(geometry::id_at<geometry::StructureId>(i));
}

bool is_of_structures(const ContactRecord& row) {
  return row.a.kind == BodyKind::structure && row.b.kind == BodyKind::structure;
}

/// m. Where structures touch over an area the gap of their contact stands for all of it; how far
/// they are in each other is seen where they are deepest.
double depth_of(const ContactRecord& row) {
  return is_of_structures(row) ? row.deepest : -row.gap;
}

/// m, what an overlap is measured against, as Simulation::largest_overlap_ratio() does.
double measure_of(const ContactRecord& row, double radius_a, double radius_b) {
  if (row.a.kind == row.b.kind) return std::min(radius_a, radius_b);
  return row.b.kind == BodyKind::sphere ? radius_b : radius_a;
}

/// Between structures a bond has a row of its own beside that of the contact.
bool is_bond_alone(const ContactRecord& row) {
  return row.is_bonded && is_of_structures(row);
}

/// What a depth may be off by (m): centres and their distance are rounded.
double rounding_of(const ContactRecord& row) {
  constexpr double kRoundings = 8.0;
  const double furthest =
      std::max(row.point_a.cwiseAbs().maxCoeff(), row.point_b.cwiseAbs().maxCoeff());
  return kRoundings * std::numeric_limits<double>::epsilon() * (furthest + std::abs(row.gap));
}

}  // namespace

std::optional<BodyOverlap> overlap_of(const ContactRecord& row, const BodyTables& bodies,
                                      const dynamics::Simulation& simulation) {
  const double depth = depth_of(row);
  if (is_bond_alone(row) || !(depth > rounding_of(row))) return std::nullopt;
  const double radius_a = radius_of(row.a, simulation).value();  // Only b may be a plane.
  const double radius_b = radius_of(row.b, simulation).value_or(radius_a);
  BodyOverlap overlap;
  overlap.of = {bodies.table_of(row.a), bodies.table_of(row.b)};
  overlap.grains = {bodies.grain_of(row.a), bodies.grain_of(row.b)};
  if (std::pair(overlap.of[1], overlap.grains[1]) < std::pair(overlap.of[0], overlap.grains[0])) {
    std::swap(overlap.of[0], overlap.of[1]);
    std::swap(overlap.grains[0], overlap.grains[1]);
  }
  overlap.depth = depth;
  overlap.ratio = depth / measure_of(row, radius_a, radius_b);
  overlap.place = row.point;
  const bool is_own =
      overlap.of[0] == overlap.of[1] && overlap.of[0].kind == BodyTable::Kind::membrane;
  overlap.is_impossible = !is_own && depth > std::max(radius_a, radius_b);
  return overlap;
}

std::optional<BodyOverlap> deepest_overlap(std::span<const ContactRecord> rows,
                                           const BodyTables& bodies,
                                           const dynamics::Simulation& simulation) {
  std::optional<BodyOverlap> deepest;
  for (const ContactRecord& row : rows) {
    const auto overlap = overlap_of(row, bodies, simulation);
    if (overlap && (!deepest || overlap->ratio > deepest->ratio)) deepest = overlap;
  }
  return deepest;
}

std::string name_of(const BodyOverlap& overlap, std::size_t side, const Scenario& scenario) {
  const BodyTable& table = overlap.of[side];
  const std::string path = path_of(table, scenario);
  return table.kind == BodyTable::Kind::grains
             ? fmt::format("{} grain {}", path, overlap.grains[side])
             : path;
}

std::string text_of(const BodyOverlap& overlap) {
  std::string who;
  for (std::size_t side = 0; side < 2; ++side) {
    if (overlap.of[side].kind != BodyTable::Kind::grains) continue;
    who += fmt::format("{} grain {}", who.empty() ? " of" : " and", overlap.grains[side]);
  }
  const Vec3& x = overlap.place;
  return fmt::format("{:.3g} mm ({:.3g} % of the radius){} at ({:.4g}, {:.4g}, {:.4g}) m",
                     1e3 * overlap.depth, 100.0 * overlap.ratio, who, x[0], x[1], x[2]);
}

}  // namespace plekton::apps
