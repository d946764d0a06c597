// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/validate_command.hpp"

#include "apps/command_line/exit_code.hpp"
#include "apps/run/build_info.hpp"
#include "apps/run/other_file.hpp"
#include "apps/run/output_folder.hpp"
#include "apps/run/run_origin.hpp"
#include "apps/scenario/closest_word.hpp"
#include "apps/validation/validation_report.hpp"
#include "dynamics/output/file.hpp"
#include "geometry/version.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps {
namespace {

/// What `plekton validate` was asked for.
struct ValidateArguments {
  std::vector<std::string> names;  ///< of cases; none: all
  bool list = false;               ///< only say which there are
  bool full = false;
  std::filesystem::path out = "out/validation";
};

constexpr const char* kPage = "validation.html";

DoneCase done_case(const ValidationCase& known, bool full) {
  using Clock = std::chrono::steady_clock;
  const auto began = Clock::now();
  DoneCase done{&known, {}, 0.0, ""};
  try {
    done.report = known.run(full);
  } catch (const std::exception& error) {
    done.error = error.what();
  }
  done.seconds = std::chrono::duration<double>(Clock::now() - began).count();
  return done;
}

std::string text_of(const DoneCase& done) {
  std::string text = fmt::format("{} ({:.1f} s): {}\n", done.of->name, done.seconds,
                                 done.passes() ? "pass" : "FAIL");
  if (!done.error.empty()) text += "  " + done.error + '\n';
  for (const Finding& finding : done.report.findings) {
    const std::string unit = finding.unit.empty() ? "" : ' ' + finding.unit;
    text += fmt::format("  {}  {}: {:.6g}{}, should be {:.6g}{} within {:.2g}{} ({})\n",
                        finding.passes() ? "pass" : "FAIL", finding.what, finding.value, unit,
                        finding.reference, unit, finding.tolerance, unit, finding.source);
  }
  return text;
}

/// @returns whether all names are known
bool require_known(const std::vector<std::string>& names, std::ostream& problems) {
  std::vector<std::string_view> known;
  for (const ValidationCase& one : validation_cases()) known.push_back(one.name);
  bool all = true;
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    all = false;
    const std::string hint = did_you_mean(name, known);
    problems << fmt::format("plekton: validate: there is no case \"{}\"{}\n", name,
                            hint.empty() ? "; plekton validate --list names them" : hint);
  }
  return all;
}

/// All of them without names.
std::vector<const ValidationCase*> cases_of(const std::vector<std::string>& names) {
  std::vector<const ValidationCase*> asked;
  for (const ValidationCase& one : validation_cases())
    if (names.empty() || std::find(names.begin(), names.end(), one.name) != names.end())
      asked.push_back(&one);
  return asked;
}

/// Before the cases, which take their time. @returns whether a page can be written
/// @throws InputError for somebody's file of its name
bool make_page_folder(const std::filesystem::path& folder, std::ostream& problems) {
  refuse_other_file(folder / kPage, "page of plekton validate", is_validation_page);
  try {
    make_output_folder(folder);
  } catch (const dynamics::OutputError& error) {
    problems << "plekton: " << error.what() << "; the cases run, but no page is written\n"
             << std::flush;
    return false;
  }
  return true;
}

bool write_page(const std::filesystem::path& folder, const std::vector<DoneCase>& cases,
                std::ostream& out, std::ostream& problems) {
  const BuildInfo build = build_info();
  const std::string origin =
      fmt::format("plekton {}, revision {}, {}, on {}, {}", kVersion, build.revision,
                  build.compiler, name_of_host(), date_of_now());
  try {
    dynamics::OutputFile file(folder / kPage);
    file.write(validation_page(cases, origin));
    file.commit();
  } catch (const dynamics::OutputError& error) {
    problems << "plekton: " << error.what() << '\n';
    return false;
  }
  out << "wrote " << (folder / kPage).string() << '\n';
  return true;
}

/// Runs cases, prints what each comes to, and writes validation.html. A name that is no case, or a
/// folder that cannot be written, is said at the end; the rest goes on.
/// @returns whether all is well
bool validate(const ValidateArguments& arguments, std::ostream& out, std::ostream& problems) {
  bool is_well = require_known(arguments.names, problems);
  const std::vector<const ValidationCase*> asked = cases_of(arguments.names);
  if (arguments.list) {
    for (const ValidationCase* one : asked) out << fmt::format("{:<20} {}\n", one->name, one->what);
    return is_well;
  }
  if (asked.empty()) return false;
  const bool has_folder = make_page_folder(arguments.out, problems);
  std::vector<DoneCase> cases;
  for (const ValidationCase* one : asked) {
    out << fmt::format("{} of {}: {}\n", cases.size() + 1, asked.size(), one->what) << std::flush;
    cases.push_back(done_case(*one, arguments.full));
    out << text_of(cases.back()) << std::flush;
    is_well = is_well && cases.back().passes();
  }
  return has_folder && write_page(arguments.out, cases, out, problems) && is_well;
}

}  // namespace

ProgramCommand add_validate(CLI::App& app) {
  const auto arguments = std::make_shared<ValidateArguments>();
  CLI::App* command = app.add_subcommand(
      "validate", "Compare with theory what this program comes to, and write a page about it");
  command->add_option("names", arguments->names, "Cases; all if not given");
  command->add_flag("--list", arguments->list, "Only say which cases there are");
  command->add_flag("--full", arguments->full, "With more elements and steps");
  command->add_option("--out", arguments->out, "Folder for validation.html")->capture_default_str();
  return {command, [arguments] {
            const bool is_well = validate(*arguments, std::cout, std::cerr);
            flush_output();
            return is_well ? kDone : kFailed;
          }};
}

}  // namespace plekton::apps
