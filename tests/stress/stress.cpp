// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/stress/stress.hpp"

#include "tests/stress/random_scene.hpp"
#include "tests/stress/shrink.hpp"
#include "tests/support/temporary_folder.hpp"

#include <fmt/format.h>

#include <ostream>
#include <set>
#include <utility>

namespace plekton::stress {
namespace {

namespace fs = std::filesystem;

/// The words after `kind =`, `mode =` and `law =`: what a scene is made of.
std::set<std::string> words_of(const std::string& text) {
  std::set<std::string> words;
  for (const std::string key : {"kind = \"", "mode = \"", "law = \""}) {
    for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
      const std::size_t begin = at + key.size();
      words.insert(text.substr(begin, text.find('"', begin) - begin));
    }
  }
  return words;
}

void count(const std::string& text, const Findings& findings, Tally& tally) {
  constexpr double kPoorClosure = 0.01;  // red in the certificate
  ++tally.scenes;
  tally.refused += findings.is_refused ? 1U : 0U;
  tally.free += findings.knows_momentum ? 1U : 0U;
  tally.failed += findings.all.empty() ? 0U : 1U;
  tally.steps += findings.steps;
  tally.contacts += findings.contacts;
  tally.broken += findings.broken;
  tally.poor_closure += findings.closure > kPoorClosure ? 1U : 0U;
  std::set<Fault> faults;
  for (const Finding& finding : findings.all) faults.insert(finding.fault);
  for (const Fault fault : faults) ++tally.faults[static_cast<std::size_t>(fault)];
  for (const std::string& word : words_of(text)) ++tally.words[word];
}

/// A file with a comment that says what fails and how to see it.
void write_scene(const fs::path& file, const SceneText& scene, const Findings& findings) {
  std::string note = "SPDX-License-Identifier: GPL-3.0-or-later\n";
  for (const Finding& finding : findings.all)
    note += fmt::format("{}: {}\n", name_of(finding.fault), finding.text);
  note += fmt::format("plekton-stress --scene {}", file.filename().string());
  fs::create_directories(file.parent_path());
  test::write_bytes(file, scene.text(note));
}

/// Writes a scene that fails, and as little of it as fails in the same way.
void keep_failure(const std::string& name, const SceneText& scene, const Findings& findings,
                  const ExaminationOptions& examination, const StressOptions& options,
                  std::ostream& log) {
  const Fault fault = findings.all.front().fault;
  ExaminationOptions narrow = examination;
  narrow.only = fault;
  const auto fails = [&](const SceneText& smaller) {
    return examine(smaller.text(), narrow).has(fault);
  };
  write_scene(options.out / (name + ".toml"), scene, findings);
  const SceneText small = shrunk(scene, fails, options.shrinking);
  const fs::path file = options.out / (name + "_small.toml");
  write_scene(file, small, examine(small.text(), examination));
  for (const Finding& finding : findings.all)
    log << fmt::format("{}: {}: {}\n", name, name_of(finding.fault), finding.text);
  log << fmt::format("  {} of {} bytes in {}\n", small.text().size(), scene.text().size(),
                     file.string())
      << std::flush;
}

ExaminationOptions examination_of(const StressOptions& options) {
  ExaminationOptions examination;
  examination.disturb = options.disturb;
  return examination;
}

}  // namespace

Tally stress(const StressOptions& options, std::ostream& log) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + options.time;
  const ExaminationOptions examination = examination_of(options);
  Tally tally;
  for (std::uint64_t i = 0; options.scenes > 0 ? i < options.scenes : Clock::now() < end; ++i) {
    const std::uint64_t number = options.first + i;
    SceneText scene = random_scene(options.seed, number);
    if (const auto shorter = shorter_duration(scene.text(), options.steps, examination))
      *find_value(scene, "[simulation]", "duration") = fmt::format("{:.4g}", *shorter);
    const std::string text = scene.text();
    const Findings findings = examine(text, examination);
    count(text, findings, tally);
    if (!findings.all.empty())
      keep_failure(fmt::format("seed{}_{}", options.seed, number), scene, findings, examination,
                   options, log);
  }
  return tally;
}

Tally stress_file(const fs::path& file, const StressOptions& options, std::ostream& log) {
  ExaminationOptions examination = examination_of(options);
  examination.file = file;
  const std::string text = test::bytes_of(file);
  const Findings findings = examine(text, examination);
  Tally tally;
  count(text, findings, tally);
  if (!findings.all.empty())
    keep_failure(file.stem().string(), taken_apart(text), findings, examination, options, log);
  return tally;
}

std::string table_of(const Tally& tally) {
  std::string table;
  const auto add = [&](std::string_view what, auto number) {
    table += fmt::format("{:<46} {:>12}\n", what, number);
  };
  add("scenes", tally.scenes);
  add("  refused by check and run alike", tally.refused);
  add("  of known momentum", tally.free);
  add("  with an energy balance off by more than 1 %", tally.poor_closure);
  add("steps, of all runs", tally.steps);
  add("contacts, the most at a time in each", tally.contacts);
  add("broken bonds and torn facets, at the ends", tally.broken);
  table += "scenes with\n";
  for (const auto& [word, number] : tally.words) add("  " + word, number);
  add("scenes that fail", tally.failed);
  for (std::size_t i = 0; i < kFaultNames.size(); ++i)
    add("  " + std::string(kFaultNames[i]), tally.faults[i]);
  return table;
}

}  // namespace plekton::stress
