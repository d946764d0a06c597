// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/scenes/laws.hpp"

#include "contact/law_list.hpp"
#include "contact/models.hpp"

#include <stdexcept>

namespace plekton::benchmarks {
namespace {

constexpr std::string_view kParts = "+parts";
constexpr double kHertzOverLinearModulus = 100.0;

contact::ContactSettings settings_of(std::size_t law, bool has_parts) {
  contact::ContactSettings settings;
  settings.law = law;
  settings.adhesion.work_of_adhesion = 0.1;    // J/m²: 0.3 mN between spheres of 1 mm
  settings.cohesion.tensile_strength = 300.0;  // Pa: 0.3 mN
  settings.cohesion.shear_strength = 300.0;
  if (has_parts) {
    settings.rolling = {0.2, 0.2, 0.1, 0.1};
    settings.restitution = 0.5;
  }
  return settings;
}

}  // namespace

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const contact::LawEntry& law : contact::contact_laws()) {
    names.emplace_back(law.name);
    names.push_back(names.back() + std::string(kParts));
  }
  return names;
}

void set_law(std::string_view name, BenchmarkScene& scene) {
  const std::vector<std::string> names = law_names();
  std::size_t place = 0;
  std::string known;
  while (place < names.size() && names[place] != name) known += ' ' + names[place++];
  if (place == names.size())
    throw std::invalid_argument("there is no law '" + std::string(name) + "'; there are" + known);
  if (place == 0) return;  // that of all scenes
  const auto settings = settings_of(place / 2, place % 2 == 1);
  // Dashpots of spheres on the light nodes of a sheet ask for a shorter step.
  if (name.ends_with("+parts")) scene.options.time_step *= 0.5;
  if (name.starts_with("hertz_mindlin") || name.starts_with("dmt_adhesion")) {
    for (contact::Material& material : scene.scene.materials)
      material.young_modulus *= kHertzOverLinearModulus;
  }
  contact::PairProperties<contact::AnyLaw> properties;
  for (std::int32_t a = 0; a < static_cast<std::int32_t>(scene.scene.materials.size()); ++a) {
    for (std::int32_t b = a; b < static_cast<std::int32_t>(scene.scene.materials.size()); ++b)
      properties[{contact::MaterialId{a}, contact::MaterialId{b}}] =
          contact::properties_of(settings);
  }
  scene.model = contact::any_law(properties);
}

}  // namespace plekton::benchmarks
