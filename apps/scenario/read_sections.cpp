// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_sections.hpp"

#include "apps/scenario/closest_word.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace plekton::apps {
namespace {

constexpr Quantity kAnyNumber{kNumber};
constexpr Range kFrictionAngle{0.0, 0.5 * std::numbers::pi, true, false,
                               " from 0 deg to below 90 deg"};
constexpr Range kPoissonRatio{-1.0, 0.5, false, true, " above -1 and at most 0.5"};
constexpr std::int64_t kLargestSeed = std::numeric_limits<std::int64_t>::max();
constexpr int kMostThreads = 1024;

}  // namespace

Known::Known(const Scenario& scenario)
    : materials(scenario.materials),
      folder(scenario.file.parent_path()),
      seed(scenario.simulation.seed) {
  for (std::size_t i = 0; i < materials.size(); ++i) material_places.emplace(materials[i].name, i);
}

SimulationSettings read_simulation(Section section) {
  SimulationSettings settings;
  settings.duration = section.quantity("duration", {kTime, kPositive});
  settings.time_step = section.quantity_unless("time_step", "auto", {kTime, kPositive});
  settings.time_step_place = section.place_of("time_step");
  settings.gravity = section.vector("gravity", {kAcceleration}, settings.gravity);
  settings.damping = section.quantity("damping", {kNumber, kBelowOne}, settings.damping);
  settings.damp_gravity = section.truth("damp_gravity", settings.damp_gravity);
  settings.self_contact = section.truth("self_contact", settings.self_contact);
  settings.skin = section.quantity_unless("skin", "auto", {kLength, kPositive}).value_or(0.0);
  settings.seed = static_cast<std::uint64_t>(section.integer("seed", 0, kLargestSeed, 1));
  settings.threads = static_cast<int>(section.integer("threads", 1, kMostThreads, 1));
  section.finish();
  return settings;
}

MaterialSettings read_material(const std::string& name, Section section) {
  MaterialSettings material;
  material.name = name;
  if (section.has("density")) material.density = section.quantity("density", {kDensity, kPositive});
  material.young_modulus = section.quantity("young_modulus", {kPressure, kPositive});
  material.stiffness_ratio =
      section.quantity("stiffness_ratio", {kNumber, kNotNegative}, material.stiffness_ratio);
  material.friction_angle = section.quantity("friction_angle", {kAngle, kFrictionAngle});
  material.poisson_ratio =
      section.quantity("poisson_ratio", {kNumber, kPoissonRatio}, material.poisson_ratio);
  section.finish();
  return material;
}

std::optional<std::size_t> read_material_of(Section& section, const Known& known,
                                            std::string_view key) {
  const std::string name = section.text(key);
  if (name.empty()) return std::nullopt;
  const auto found = known.material_places.find(name);
  if (found != known.material_places.end()) return found->second;
  std::vector<std::string_view> names;
  for (const MaterialSettings& material : known.materials) names.push_back(material.name);
  const std::string closest = closest_word(name, names);
  const std::string hint = !closest.empty() ? fmt::format("did you mean \"{}\"?", closest)
                           : names.empty()
                               ? fmt::format("describe it in a table [materials.{}]", name)
                               : "the materials are " + listed(names);
  section.complain(key, fmt::format("there is no material \"{}\"; {}", name, hint));
  return std::nullopt;
}

ValueType box_type() {
  const ValueType corner = ValueType::of(ValueType::Kind::vector, {kLength});
  ValueType type = ValueType::of(ValueType::Kind::table);
  type.members = {{"min", corner}, {"max", corner}};
  return type;
}

geometry::Box read_box(Section section) {
  const Vec3 lower = section.vector("min", {kLength});
  const Vec3 upper = section.vector("max", {kLength});
  for (int axis = 0; axis < 3; ++axis) {
    if (std::isinf(upper[axis] - lower[axis])) {
      section.complain("max", fmt::format("component {} is {} m, further from {} m of min than any "
                                          "double can hold; expected a smaller box",
                                          "xyz"[axis], upper[axis], lower[axis]));
    }
    if (!(upper[axis] <= lower[axis])) continue;
    section.complain(
        "max",
        fmt::format("component {} is {} m, not above {} m of min; expected the larger corner",
                    "xyz"[axis], upper[axis], lower[axis]));
  }
  section.finish();
  return {lower, upper};
}

PlaneSettings read_plane(Section section, const Known& known) {
  PlaneSettings plane;
  plane.name = section.name("name", "");
  plane.point = section.vector("point", {kLength});
  plane.normal = section.vector("normal", kAnyNumber, plane.normal);
  plane.velocity = section.vector("velocity", {kVelocity}, plane.velocity);
  plane.material = read_material_of(section, known).value_or(0);
  const double length = plane.normal.stableNorm();
  if (length == 0.0)
    section.complain(
        "normal", "got a vector of no length; expected the direction into the space of the bodies");
  if (length > 0.0) plane.normal.stableNormalize();
  section.finish();
  return plane;
}

StopSettings read_stop(Section section) {
  StopSettings stop;
  stop.kinetic_energy = section.quantity("kinetic_energy", {kEnergy, kPositive});
  if (section.has("after")) stop.after = section.quantity("after", {kTime, kNotNegative});
  section.finish();
  return stop;
}

}  // namespace plekton::apps
