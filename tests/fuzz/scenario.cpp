// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target of the scenario reader. Lines that begin with "--set " before the first other
// one are overrides, the rest is TOML. The outcome is a scenario or an InputError; a scenario that
// is read is read again from the text that it keeps.
#include "apps/scenario/scenario_reader.hpp"
#include "tests/fuzz/require.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace plekton::apps;
using plekton::fuzz::require;

/// Meshes are looked for below it: it is not there, so no file of the machine is ever read.
constexpr const char* kFile = "/nonexistent/fuzzed.toml";

/// Takes the lines of overrides off a text.
std::vector<std::string> taken_overrides(std::string_view& text) {
  constexpr std::string_view kBegin = "--set ";
  std::vector<std::string> overrides;
  while (text.starts_with(kBegin)) {
    const std::size_t end = text.find('\n');
    overrides.emplace_back(text.substr(kBegin.size(), end - kBegin.size()));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return overrides;
}

void require_sound(const Scenario& scenario) {
  require(scenario.simulation.duration > 0.0 && std::isfinite(scenario.simulation.duration),
          "a duration that is none");
  require(!scenario.grains.empty() || !scenario.membranes.empty(), "nothing to simulate");
  for (const GrainSettings& grains : scenario.grains)
    require(grains.material < scenario.materials.size(), "a material that is none");
  require(scenario.output.interval > 0.0, "an interval that is none");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const std::vector<std::string> overrides = taken_overrides(text);
    const Scenario scenario = parse_scenario(text, kFile, overrides);
    require_sound(scenario);
    const Scenario again = parse_scenario(scenario.text, kFile, scenario.overrides);
    require(again.grains.size() == scenario.grains.size(), "another scenario from the same text");
  } catch (const InputError& error) {
    require(error.what()[0] != '\0', "a refusal without a message");
  }
  return 0;
}
