// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/stiffness_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plekton::apps {
namespace {

struct NamedModulus {
  std::string name;
  double modulus;  ///< Pa
};

/// Of the materials that a body has, and of the membranes; the surface of a rigid body has none of
/// its own.
std::vector<NamedModulus> moduli_of(const Scenario& scenario, const BuiltScene& built) {
  std::vector<bool> is_used(scenario.materials.size(), false);
  for (const MembraneSettings& membrane : scenario.membranes) is_used[membrane.material] = true;
  for (const GrainSettings& grains : scenario.grains) is_used[grains.material] = true;
  for (const PlaneSettings& plane : scenario.planes) is_used[plane.material] = true;
  std::vector<NamedModulus> moduli;
  for (std::size_t i = 0; i < is_used.size(); ++i) {
    const MaterialSettings& material = scenario.materials[i];
    if (is_used[i]) moduli.push_back({"materials." + material.name, material.young_modulus});
  }
  for (const BuiltMembrane& membrane : built.membranes)
    if (!membrane.is_rigid)
      moduli.push_back({"membranes." + membrane.name, membrane.young_modulus});
  return moduli;
}

void warn_about_moduli(const std::vector<NamedModulus>& moduli,
                       std::vector<std::string>& warnings) {
  const auto [softest, stiffest] = std::minmax_element(
      moduli.begin(), moduli.end(),
      [](const NamedModulus& a, const NamedModulus& b) { return a.modulus < b.modulus; });
  if (softest == stiffest || !(stiffest->modulus > kFarStiffer * softest->modulus)) return;
  warnings.push_back(fmt::format(
      "{} with E = {:.3g} Pa is {:.2g} times as stiff as {} with {:.3g} Pa: steps are as short as "
      "the one asks for, and overlaps as deep as the other allows; check the units of both",
      stiffest->name, stiffest->modulus, stiffest->modulus / softest->modulus, softest->name,
      softest->modulus));
}

void warn_about_ratio(const std::string& path, double ratio, std::vector<std::string>& warnings) {
  if (!(ratio > kLargestStiffnessRatio)) return;
  warnings.push_back(fmt::format(
      "{}: the tangential stiffness is {:.3g} times the normal one; elastic bodies have "
      "2/3 to 1, and what is far above shortens the time step",
      path, ratio));
}

}  // namespace

std::vector<std::string> warnings_about_stiffness(const Scenario& scenario,
                                                  const BuiltScene& built) {
  std::vector<std::string> warnings;
  warn_about_moduli(moduli_of(scenario, built), warnings);
  for (const MaterialSettings& material : scenario.materials)
    warn_about_ratio("materials." + material.name + ".stiffness_ratio", material.stiffness_ratio,
                     warnings);
  for (std::size_t i = 0; i < scenario.contacts.size(); ++i) {
    const auto& springs = scenario.contacts[i].contact.springs;
    if (springs.normal_stiffness > 0.0 && springs.tangential_stiffness > 0.0)
      warn_about_ratio(fmt::format("contacts[{}].tangential_stiffness", i),
                       springs.tangential_stiffness / springs.normal_stiffness, warnings);
  }
  return warnings;
}

}  // namespace plekton::apps
