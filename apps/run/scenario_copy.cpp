// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/scenario_copy.hpp"

#include "dynamics/output/file.hpp"
#include "geometry/base/printable.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <system_error>

namespace plekton::apps {

namespace fs = std::filesystem;

namespace {

/// A comment of one line. Line breaks would end it, and other control characters are no TOML.
std::string comment(std::string_view text) {
  std::string shown = geometry::printable(text);
  for (std::size_t at = shown.find('\n'); at != std::string::npos; at = shown.find('\n', at))
    shown.replace(at, 1, "\\n");
  return "# " + shown + '\n';
}

constexpr std::string_view kBegin = "This is a copy of ";

/// The comments of a copy that say what was replaced, but for threads.
std::string replaced_in(const std::string& copy) {
  std::string replaced;
  std::istringstream lines(
      copy.substr(std::min(copy.rfind("# " + std::string(kBegin)), copy.size())));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("# --set ") && !line.starts_with("# --set simulation.threads"))
      replaced += line + '\n';
  return replaced;
}

}  // namespace

std::string copy_of(const Scenario& scenario) {
  std::error_code ignored;
  const fs::path folder = fs::absolute(scenario.file, ignored).parent_path();
  std::string copy = scenario.text;
  if (!copy.empty() && !copy.ends_with('\n')) copy += '\n';
  copy += comment(std::string(kBegin) + scenario.file.string() +
                  " as it was run. Files that it names are relative to " + folder.string() + ".");
  for (const std::string& replaced : scenario.overrides) copy += comment("--set " + replaced);
  return copy;
}

void write_scenario_copy(const fs::path& folder, const Scenario& scenario) {
  const fs::path path = folder / kScenarioCopy;
  if (std::error_code ignored; fs::equivalent(path, scenario.file, ignored)) return;
  dynamics::OutputFile file(path);
  file.write(copy_of(scenario));
  file.commit();
}

void update_scenario_copy(const fs::path& folder, const Scenario& scenario) {
  std::ifstream file(folder / kScenarioCopy, std::ios::binary);
  std::ostringstream there;
  there << file.rdbuf();
  if (!file || replaced_in(there.str()) != replaced_in(copy_of(scenario)))
    write_scenario_copy(folder, scenario);
}

}  // namespace plekton::apps
