// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/asked_stages.hpp"
#include "apps/command_line/resumed_run.hpp"
#include "apps/python/attendant.hpp"
#include "apps/python/bindings.hpp"
#include "apps/python/from_python.hpp"
#include "apps/python/interpreter_lock.hpp"
#include "apps/run/output_folder.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

namespace plekton::python {
namespace {

namespace fs = std::filesystem;

/// Where stages go on from: the name of one, and the folder of its run.
using After = std::pair<std::string, fs::path>;

/// @returns what run.json says
py::object run(const apps::Scenario& scenario, apps::StagesAsked asked, const fs::path& out,
               bool overwrite) {
  Attendant attendant({}, py::none());
  const dynamics::Simulation* simulation = nullptr;  // of the stage that is run
  asked.begins = [&](const dynamics::Simulation& of) {
    simulation = &of;
    attendant.start(of);
  };
  std::ostringstream unseen;
  apps::RunSettings settings{out, unseen, apps::ProgressStyle::none, {}};
  settings.is_interrupted = [&] { return attendant.wants_end(*simulation); };
  settings.overwrite = overwrite;
  std::optional<apps::RunReport> report;
  {
    const WithoutLock free;
    const auto hear = [](const std::string&, double) { check_signals(); };
    report = apps::run_stages_asked(scenario, asked, settings, hear, nullptr);
  }
  attendant.throw_if_any();
  return py::module_::import("json").attr("loads")(apps::to_json(*report));
}

py::object run_stages(const py::object& scenario, const fs::path& out,
                      const py::iterable& overrides, const std::optional<fs::path>& folder,
                      const std::optional<After>& after, const std::string& until, bool overwrite) {
  const apps::Scenario read = scenario_of(scenario, overrides, folder);
  if (read.stages.empty())
    throw apps::InputError("the scenario has no [[stages]]; load() makes a simulation of it");
  std::error_code ignored;
  if (after && fs::equivalent(after->second, out, ignored))
    throw apps::InputError(
        fmt::format("after: {} is to be kept; give another folder for the results with out",
                    after->second.string()));
  apps::check_output_folder(out, overwrite);  // before the scene is built, which may take long
  apps::StagesAsked asked;
  if (after) asked.from = {after->first, after->second.string()};
  asked.until = until;
  return run(read, std::move(asked), out, overwrite);
}

py::object resume_stages(const fs::path& out, const py::iterable& overrides) {
  const std::vector<std::string> all = overrides_of(overrides);
  const apps::ResumedRun resumed =
      resumed_run({.folder = out, .overrides = all, .same_folder = true});
  if (!resumed.scenario.stage)
    throw apps::InputError(fmt::format(
        "{}: is of a scenario without [[stages]]; resume() goes on with it", out.string()));
  apps::StagesAsked asked;
  asked.resume = &resumed.checkpoint.state;
  return run(resumed.scenario, std::move(asked), out, false);
}

}  // namespace

void bind_stages(py::module_& module) {
  module.def(
      "run_stages", &run_stages, py::arg("scenario"), py::arg("out"),
      py::arg("overrides") = py::tuple(), py::kw_only(), py::arg("folder") = py::none(),
      py::arg("after") = py::none(), py::arg("until") = "", py::arg("overwrite") = false,
      "Runs the [[stages]] of a scenario, a TOML file or a dict, one after the other as plekton "
      "run "
      "does, with results in the folder out. after = (name of a stage, folder of its run) begins "
      "with the stage after that one, as --from; until names the last one to be run. Returns what "
      "run.json says.");
  module.def("resume_stages", &resume_stages, py::arg("out"), py::arg("overrides") = py::tuple(),
             "Goes on with a run of stages from its last checkpoint, in its folder. Returns what "
             "run.json says.");
}

}  // namespace plekton::python
