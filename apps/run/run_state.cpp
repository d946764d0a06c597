// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/run_state.hpp"

#include <algorithm>
#include <cstdint>
#include <system_error>

namespace plekton::apps {
namespace {

using geometry::StateArchive;

void exchange_overlap(const StateArchive& archive, RunReport& report) {
  bool is_there = report.deepest_overlap.has_value();
  archive("is_there", is_there);
  if (!is_there) return;
  if (archive.is_reading()) report.deepest_overlap.emplace();
  DeepestOverlap& overlap = *report.deepest_overlap;
  archive("a", overlap.a);
  archive("b", overlap.b);
  archive("depth", overlap.depth);
  archive("ratio", overlap.ratio);
  archive("place", overlap.place);
  archive("time", overlap.time);
}

}  // namespace

void exchange_texts(const StateArchive& archive, const char* name,
                    std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += text + '\0';
  archive(name, all);
  if (!archive.is_reading()) return;
  texts.clear();
  for (std::size_t begin = 0; begin < all.size();) {
    const std::size_t end = std::min(all.find('\0', begin), all.size());
    texts.push_back(all.substr(begin, end - begin));
    begin = end + 1;
  }
}

/// Their files have names of their own.
void exchange_measures(const StateArchive& archive, WrittenFiles& files) {
  const std::string folder = std::string(kMeasuresFolder) + "/";
  std::vector<std::string> names;
  for (const auto& [name, size] : files.sizes)
    if (name.starts_with(folder)) names.push_back(name);
  exchange_texts(archive, "names", names);
  std::vector<std::uint64_t> sizes;
  for (const std::string& name : names) sizes.push_back(files.sizes[name]);
  archive("sizes", sizes);
  for (std::size_t i = 0; i < std::min(names.size(), sizes.size()); ++i)
    files.sizes[names[i]] = sizes[i];
}

void exchange_files(const StateArchive& archive, WrittenFiles& files) {
  const StateArchive sizes = archive.group("files");
  for (const char* const name : {kHistoryFile, kReactionsFile, kPressuresFile, kRigidBodiesFile,
                                 kTiesFile, kPlanesFile, kContactsFile}) {
    const auto known = files.sizes.find(name);
    std::uint64_t size = known == files.sizes.end() ? 0 : known->second;  // 0: there is none
    sizes(name, size);
    if (size > 0) files.sizes[name] = size;
  }
  exchange_measures(archive.group("measures"), files);
  archive("frames", files.frames);
}

void exchange_so_far(const StateArchive& archive, RunReport& report) {
  exchange_texts(archive, "warnings", report.warnings);
  exchange_overlap(archive.group("deepest_overlap"), report);
  archive("dt_over_critical", report.dt_over_critical);
  archive("largest_motion_ratio", report.largest_motion_ratio);
}

void ScenarioText::exchange(const StateArchive& archive) {
  archive("scenario", text);
  archive("scenario_file", file);
  exchange_texts(archive, "overrides", overrides);
}

ScenarioText text_of(const Scenario& scenario) {
  std::error_code error;
  // Of standard input too: meshes are relative to the folder it was read in.
  const std::filesystem::path file = std::filesystem::absolute(scenario.file, error);
  ScenarioText text{scenario.text, error ? scenario.file.string() : file.string(),
                    scenario.overrides};
  std::erase_if(text.overrides, [](const std::string& replaced) {
    return replaced.starts_with("simulation.threads");
  });
  return text;
}

}  // namespace plekton::apps
