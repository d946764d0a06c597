// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/closest_word.hpp"
#include "apps/scenario/read_sections.hpp"

#include <fmt/format.h>

#include <numbers>

namespace plekton::apps {
namespace {

constexpr Range kFrictionAngle{0.0, 0.5 * std::numbers::pi, true, false,
                               " from 0 deg to below 90 deg"};
constexpr Range kPoissonRatio{-1.0, 0.5, false, true, " above -1 and at most 0.5"};

}  // namespace

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

}  // namespace plekton::apps
