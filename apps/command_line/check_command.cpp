// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/check_command.hpp"

#include "apps/command_line/asked_stages.hpp"
#include "apps/command_line/check_report.hpp"
#include "apps/command_line/exit_code.hpp"
#include "apps/command_line/run_estimate.hpp"
#include "apps/command_line/scenario_options.hpp"
#include "apps/command_line/set_up_aloud.hpp"
#include "apps/command_line/start_listing.hpp"
#include "apps/command_line/step_advice.hpp"
#include "apps/command_line/summary.hpp"
#include "apps/scenario/problems.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <iostream>
#include <memory>

namespace plekton::apps {
namespace {

/// What `plekton check` was asked for.
struct CheckArguments {
  ScenarioOptions scenario;
  bool power_iteration = false;  ///< for the critical step
  bool json = false;
};

/// Prints one JSON object, also of a scenario with problems, before these go the way of all errors.
void check_for_programs(const CheckArguments& arguments) {
  const auto print = [](const nlohmann::ordered_json& report) {
    // A path need not be UTF-8; what is not becomes a replacement character.
    std::cout << report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
              << '\n';
    flush_output();
  };
  try {
    const Scenario scenario = scenario_of(arguments.scenario);
    PreparedRun prepared = prepared_aloud(scenario, true);
    require_possible_start(prepared.start, scenario);
    StagesSeen stages;
    if (scenario.stage) stages = look_at_stages(scenario, {});
    auto report = check_report(scenario, prepared);
    for (const std::string& warning : stages.warnings) report["warnings"].push_back(warning);
    for (const auto& [name, limits, grains, planes, loads] : stages.stages)
      report["stages"].push_back({{"name", name},
                                  {"ends", limits},
                                  {"grains", grains},
                                  {"planes", planes},
                                  {"loads", loads}});
    print(report);
  } catch (const InputError& error) {
    print(check_report(error.what()));
    throw;
  }
}

void check_for_people(const CheckArguments& arguments) {
  const Scenario scenario = scenario_of(arguments.scenario);
  PreparedRun prepared = prepared_aloud(scenario, false);
  std::cout << summary_of(scenario, prepared) << listing_of_start(scenario, prepared) << std::flush;
  require_possible_start(prepared.start, scenario);
  std::cout << step_advice(scenario, prepared);
  if (arguments.power_iteration)
    std::cout << summary_of(prepared.simulation->exact_critical_step());
  // Last, since it moves the simulation on.
  std::cout << text_of(estimate_run(scenario, prepared));
  if (scenario.stage) {
    const StagesSeen stages = look_at_stages(scenario, {});
    std::cout << text_of(stages.stages);
    for (const std::string& warning : stages.warnings) std::cout << "warning: " << warning << '\n';
  }
  std::cout << scenario.file.string() << ": no problems\n";
  flush_output();
}

}  // namespace

ProgramCommand add_check(CLI::App& app) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App* check = app.add_subcommand(
      "check", "Read a scenario, build its scene, and say what it is or what is wrong with it");
  add_scenario_options(*check, arguments->scenario)->required();
  check
      ->add_flag("--power-iteration", arguments->power_iteration,
                 "Also find the critical time step of the scene as it is by power iteration on "
                 "its forces; not with --json")
      ->excludes(
          check->add_flag("--json", arguments->json, "Print all of it as JSON, also the problems"));
  return {check, [arguments] {
            arguments->json ? check_for_programs(*arguments) : check_for_people(*arguments);
            return kDone;
          }};
}

}  // namespace plekton::apps
