// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/unit_warnings.hpp"

#include <fmt/format.h>

#include <optional>

namespace plekton::apps {
namespace {

void warn_about_density(const std::string& path, const std::optional<double>& density,
                        std::vector<std::string>& warnings) {
  if (!density || (*density >= kLightest && *density <= kHeaviest)) return;
  warnings.push_back(fmt::format(
      "{}.density: {:.4g} kg/m3 is {} there is; check its unit (a number alone is in kg/m3, "
      "\"2.65 g/cm3\" is 2650)",
      path, *density,
      *density < kLightest ? "lighter than any solid" : "heavier than any material"));
}

}  // namespace

std::vector<std::string> warnings_about_units(const Scenario& scenario) {
  std::vector<std::string> warnings;
  for (const MaterialSettings& material : scenario.materials)
    warn_about_density("materials." + material.name, material.density, warnings);
  if (const double gravity = scenario.simulation.gravity.norm(); gravity > kLargestGravity)
    warnings.push_back(
        fmt::format("simulation.gravity: {:.4g} m/s2 is {:.3g} times that of the earth; check its "
                    "unit (a number alone is in m/s2)",
                    gravity, gravity / 9.81));
  return warnings;
}

}  // namespace plekton::apps
