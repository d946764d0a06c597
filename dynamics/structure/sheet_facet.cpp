// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/sheet_facet.hpp"

#include "geometry/base/problems.hpp"

#include <cmath>
#include <ostream>
#include <sstream>
#include <string>

namespace plekton::dynamics {
namespace {

void list_section(const SheetSection& section, const std::string& where, std::ostream& problems) {
  const auto expect = [&](bool is_good, const char* what, double value, const char* expected) {
    if (is_good && std::isfinite(value)) return;
    problems << where << ": " << what << " is " << value << "; it must be " << expected << '\n';
  };
  expect(section.tensile_stiffness > 0.0, "tensile stiffness (N/m)", section.tensile_stiffness,
         "positive and finite");
  expect(section.poisson_ratio > -1.0 && section.poisson_ratio < 1.0, "Poisson's ratio",
         section.poisson_ratio, "above -1 and below 1");
  expect(section.bending_stiffness >= 0.0, "bending stiffness (N m)", section.bending_stiffness,
         "zero or positive, and finite");
  expect(section.thickness > 0.0, "thickness (m)", section.thickness, "positive and finite");
  if (!(section.strength > 0.0))
    problems << where << ": strength (Pa) is " << section.strength
             << "; it must be positive, or infinite for a sheet that never tears\n";
}

bool list_nodes(const std::array<NodeId, 3>& nodes, std::size_t node_count,
                const std::string& where, std::ostream& problems) {
  bool is_good = true;
  for (const NodeId id : nodes) {
    const auto node = static_cast<std::int32_t>(id);
    if (node >= 0 && static_cast<std::size_t>(node) < node_count) continue;
    problems << where << ": there is no node " << node << ", only " << node_count << " nodes\n";
    is_good = false;
  }
  if (nodes[0] != nodes[1] && nodes[1] != nodes[2] && nodes[2] != nodes[0]) return is_good;
  problems << where << ": it repeats a node; delete the facet\n";
  return false;
}

std::string place(const std::array<NodeId, 3>& nodes, std::string_view name) {
  std::ostringstream text;
  text << name << " (nodes " << static_cast<std::int32_t>(nodes[0]) << ", "
       << static_cast<std::int32_t>(nodes[1]) << ", " << static_cast<std::int32_t>(nodes[2]) << ")";
  return text.str();
}

}  // namespace

SheetSection solid_sheet(double thickness, double young_modulus, double poisson_ratio) noexcept {
  const double stiffness = young_modulus * thickness;
  return {stiffness, poisson_ratio,
          stiffness * thickness * thickness / (12.0 * (1.0 - poisson_ratio * poisson_ratio)),
          thickness, SheetSection::kNever};
}

double area_of(const SheetFacet& facet) noexcept {
  const Vec2 e1 = facet.corners[1] - facet.corners[0];
  const Vec2 e2 = facet.corners[2] - facet.corners[0];
  return 0.5 * (e1.x() * e2.y() - e1.y() * e2.x());
}

void list_problems(const SheetFacet& facet, std::size_t node_count, std::string_view name,
                   std::ostream& problems) {
  const std::string where = place(facet.nodes, name);
  list_nodes(facet.nodes, node_count, where, problems);
  list_section(facet.section, where, problems);
  const double area = area_of(facet);
  if (!(area > 0.0 && std::isnormal(area)))
    problems << where << ": its area at rest is " << area
             << " m2; it must be positive and finite: delete the facet or move its nodes apart\n";
  for (const Quat& rest : facet.rest) {
    constexpr double kTolerance = 1e-9;  // far above rounding, far below any real mistake
    if (std::abs(rest.squaredNorm() - 1.0) < kTolerance) continue;
    problems << where << ": its rotation at rest is not a unit quaternion; normalise it\n";
  }
}

SheetFacet make_sheet_facet(const std::array<NodeId, 3>& nodes, const NodeState& at_rest,
                            const SheetSection& section) {
  std::ostringstream problems;
  if (!list_nodes(nodes, at_rest.size(), place(nodes, "sheet facet"), problems))
    geometry::throw_if_any(problems);
  const Vec3& x0 = at_rest.position[index_of(nodes[0])];
  const Vec3 e1 = at_rest.position[index_of(nodes[1])] - x0;
  const Vec3 e2 = at_rest.position[index_of(nodes[2])] - x0;
  const Vec3 normal = e1.cross(e2).stableNormalized();
  Mat3 axes;
  axes.col(0) = e1.stableNormalized();
  axes.col(2) = normal;
  axes.col(1) = normal.cross(axes.col(0));
  const Quat frame = Quat(axes).normalized();
  SheetFacet facet{
      nodes,
      {Vec2::Zero(), Vec2(e1.norm(), 0.0), Vec2(e2.dot(axes.col(0)), e2.dot(axes.col(1)))},
      section,
      {}};
  for (std::size_t i = 0; i < 3; ++i)
    facet.rest[i] = at_rest.orientation[index_of(nodes[i])].conjugate() * frame;
  if (normal.isZero(0.0))
    facet.rest.fill(Quat::Identity());  // no area: that is the problem to tell
  list_problems(facet, at_rest.size(), "sheet facet", problems);
  geometry::throw_if_any(problems);
  return facet;
}

}  // namespace plekton::dynamics
