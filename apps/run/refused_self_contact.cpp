// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/refused_self_contact.hpp"

#include <fmt/format.h>

#include <cstddef>

namespace plekton::apps {

InputError refused_self_contact(const Scenario& scenario, std::span<const BuiltMembrane> membranes,
                                const std::string& what) {
  std::size_t worst = 0;
  const auto fineness = [&](std::size_t i) {
    return scenario.membranes[i].thickness / membranes[i].mean_edge;
  };
  for (std::size_t i = 1; i < membranes.size(); ++i) {
    if (fineness(i) > fineness(worst)) worst = i;
  }
  const MembraneSettings& membrane = scenario.membranes[worst];
  return InputError(
      fmt::format("{}: membranes.{}: {}", to_string(membrane.source_place), membrane.name, what));
}

}  // namespace plekton::apps
