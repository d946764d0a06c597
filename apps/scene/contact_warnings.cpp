// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/contact_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plekton::apps {
namespace {

/// Whether a membrane of one material may touch one of the other, or itself.
bool may_membranes_meet(const Scenario& scenario, const PairSettings& pair) {
  const auto count = [&](std::size_t material) {
    return std::count_if(scenario.membranes.begin(), scenario.membranes.end(),
                         [&](const MembraneSettings& m) { return m.material == material; });
  };
  if (pair.first != pair.second) return count(pair.first) > 0 && count(pair.second) > 0;
  return count(pair.first) > (scenario.simulation.self_contact ? 0 : 1);
}

bool is_glued(const PairSettings& pair) {
  return contact::contact_laws()[pair.contact.law].name == contact::CohesiveFrictional::name &&
         pair.contact.cohesion.tensile_strength > 0.0;
}

}  // namespace

std::vector<std::string> contact_warnings(const Scenario& scenario) {
  std::vector<std::string> warnings;
  for (const PairSettings& pair : scenario.contacts) {
    if (!is_glued(pair) || !may_membranes_meet(scenario, pair)) continue;
    warnings.push_back(fmt::format(
        "contacts of \"{}\" and \"{}\": membranes are not held together by tensile_strength; "
        "between them, and of one with itself, a bond carries shear while they touch, and no "
        "tension; bonds hold grains, and bodies on planes",
        scenario.materials[pair.first].name, scenario.materials[pair.second].name));
  }
  return warnings;
}

}  // namespace plekton::apps
