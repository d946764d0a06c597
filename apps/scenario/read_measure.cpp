// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_measure.hpp"

#include "apps/scenario/closest_word.hpp"
#include "apps/scenario/read_load_targets.hpp"
#include "apps/scenario/read_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace plekton::apps {
namespace {

constexpr std::array<std::string_view, 4> kShapes = {"sphere", "box", "cylinder", "heights"};

/// The name of a file: what every file system takes, and no folder of its own.
std::string read_file_name(Section& section, const std::vector<MeasureSettings>& earlier) {
  const std::string name = section.name("name");
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  };
  if (!std::all_of(name.begin(), name.end(), is_plain) || (!name.empty() && name[0] == '.'))
    section.complain("name", fmt::format("got \"{}\", which names a file, measures/NAME.csv; "
                                         "expected letters (a to z), digits, _, - and . alone, "
                                         "not beginning with .",
                                         name));
  const bool taken = std::any_of(earlier.begin(), earlier.end(),
                                 [&](const auto& other) { return other.name == name; });
  if (taken && !name.empty())
    section.complain("name", fmt::format("\"{}\" is a measure already, and names a file; expected "
                                         "a name of its own",
                                         name));
  return name;
}

geometry::BallRegion read_ball(Section section) {
  const geometry::BallRegion ball{section.vector("centre", {kLength}),
                                  section.quantity("radius", {kLength, kPositive})};
  section.finish();
  return ball;
}

void read_heights(Section section, MeasureSettings& measure) {
  section.tell_default("bottom", "none");
  section.tell_default("top", "none");
  if (section.has("bottom")) measure.bottom = section.quantity("bottom", {kLength});
  if (section.has("top")) measure.top = section.quantity("top", {kLength});
  if (measure.bottom >= measure.top)
    section.complain("top", fmt::format("got {} m, not above {} m of bottom; expected the larger "
                                        "height",
                                        measure.top, measure.bottom));
  section.finish();
}

/// Whether planes of a normal can cut the region so that its kind stays.
bool can_cut(const MeasureSettings& measure, const Vec3& normal) {
  constexpr double kTolerance = 1e-9;  // of unit normals
  if (!measure.region || std::holds_alternative<geometry::Box>(*measure.region))
    return normal.cwiseAbs().maxCoeff() > 1.0 - kTolerance;
  const auto* const cylinder = std::get_if<geometry::CylinderRegion>(&*measure.region);
  return cylinder != nullptr &&
         normal.cross((cylinder->to - cylinder->from).normalized()).norm() < kTolerance;
}

/// Whether a container and the region are cylinders about one axis, or balls about one centre.
bool surrounds(const PlaneSettings& plane, const MeasureSettings& measure) {
  if (!measure.region) return false;
  const double near = 1e-9 * plane.radius;
  if (const auto* const cylinder = std::get_if<geometry::CylinderRegion>(&*measure.region))
    return plane.form == contact::Plane::Form::cylinder &&
           (cylinder->from - plane.point).cross(plane.axis).norm() < near &&
           (cylinder->to - plane.point).cross(plane.axis).norm() < near;
  const auto* const ball = std::get_if<geometry::BallRegion>(&*measure.region);
  return ball != nullptr && plane.form == contact::Plane::Form::sphere &&
         (ball->centre - plane.point).norm() < near;
}

void read_planes_between(Section& section, const Scenario& scenario, MeasureSettings& measure) {
  if (!section.has("between")) return;
  measure.planes = read_plane_names(section, "between", scenario);
  for (const std::size_t plane : measure.planes) {
    const PlaneSettings& settings = scenario.planes[plane];
    if (!settings.is_flat()) {
      if (!surrounds(settings, measure))
        section.complain("between",
                         fmt::format("container \"{}\" and the region differ in shape or "
                                     "middle; expected a region of the same of both",
                                     settings.name));
      continue;
    }
    if (can_cut(measure, settings.normal)) continue;
    section.complain(
        "between",
        fmt::format("plane \"{}\" has the normal [{:.4g}, {:.4g}, {:.4g}]; expected planes along "
                    "the sides of a box, or along the ends of a cylinder; a sphere cannot be cut",
                    settings.name, settings.normal[0], settings.normal[1], settings.normal[2]));
  }
}

}  // namespace

geometry::CylinderRegion read_cylinder(Section section) {
  const geometry::CylinderRegion cylinder{section.vector("from", {kLength}),
                                          section.vector("to", {kLength}),
                                          section.quantity("radius", {kLength, kPositive})};
  const double length = (cylinder.to - cylinder.from).norm();
  if (!std::isnormal(length))
    section.complain("to", fmt::format("is {:.4g} m from `from`; expected the centre of the other "
                                       "end",
                                       length));
  section.finish();
  return cylinder;
}

MeasureSettings read_measure(Section section, const Scenario& scenario,
                             const std::vector<MeasureSettings>& earlier) {
  MeasureSettings measure;
  measure.name = read_file_name(section, earlier);
  const auto given = std::count_if(kShapes.begin(), kShapes.end(),
                                   [&](std::string_view key) { return section.has(key); });
  if (given > 1)
    section.complain(
        "name", fmt::format("got {} of {}; expected at most one of them", given, listed(kShapes)));
  if (auto sphere = section.optional_table("sphere")) measure.region = read_ball(*sphere);
  if (auto box = section.optional_table("box")) measure.region = read_box(*box);
  if (auto cylinder = section.optional_table("cylinder")) measure.region = read_cylinder(*cylinder);
  if (auto heights = section.optional_table("heights")) read_heights(*heights, measure);
  read_planes_between(section, scenario, measure);
  section.finish();
  return measure;
}

}  // namespace plekton::apps
