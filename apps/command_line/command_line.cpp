// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/command_line.hpp"

#include "apps/command_line/check_command.hpp"
#include "apps/command_line/command.hpp"
#include "apps/command_line/error_text.hpp"
#include "apps/command_line/examples_command.hpp"
#include "apps/command_line/export_ondem_command.hpp"
#include "apps/command_line/generate_command.hpp"
#include "apps/command_line/import_command.hpp"
#include "apps/command_line/import_yade_command.hpp"
#include "apps/command_line/inspect_command.hpp"
#include "apps/command_line/list_command.hpp"
#include "apps/command_line/new_command.hpp"
#include "apps/command_line/plot_command.hpp"
#include "apps/command_line/render_command.hpp"
#include "apps/command_line/run_command.hpp"
#include "apps/command_line/schema_command.hpp"
#include "apps/command_line/study_command.hpp"
#include "apps/command_line/usage_error.hpp"
#include "apps/command_line/validate_command.hpp"
#include "apps/command_line/verify_command.hpp"
#include "apps/command_line/view_command.hpp"
#include "apps/scenario/problems.hpp"
#include "geometry/version.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <exception>
#include <string>
#include <vector>

namespace plekton::apps {
namespace {

/// All commands, in the order of the help.
constexpr std::array kCommands = std::to_array<ProgramCommand (*)(CLI::App&)>({
    add_run,
    add_check,
    add_import,
    add_import_yade,
    add_export_ondem,
    add_inspect,
    add_verify,
    add_list,
    add_study,
    add_plot,
    add_render,
    add_validate,
    add_schema,
    add_examples,
    add_new,
    add_generate,
    add_view,
});

/// @throws InputError
void require_no_empty_option(const CLI::App& app) {
  for (const CLI::App* const command : app.get_subcommands()) {
    for (const CLI::Option* const option : command->get_options()) {
      const std::vector<std::string>& given = option->results();
      const bool needs_value = option->nonpositional() && option->get_items_expected_min() > 0;
      if (needs_value && std::find(given.begin(), given.end(), "") != given.end())
        throw InputError(
            fmt::format("{}: got an empty text, as of a variable of the shell that is not set; "
                        "leave the option out, or give it its value",
                        option->get_name()));
    }
  }
}

int dispatch(int argc, const char* const* argv) {
  CLI::App app("Plekton: discrete elements with deformable structures", "plekton");
  app.set_version_flag("--version", std::string(kVersion));
  app.require_subcommand(1);
  std::vector<ProgramCommand> commands;
  for (const auto add : kCommands) commands.push_back(add(app));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // help, version
      app.exit(error);
      flush_output();
      return kDone;
    }
    print_error(usage_error(app, error, argc < 2 ? "" : argv[1]));
    return kUsage;
  }
  require_no_empty_option(app);
  const auto asked =
      std::find_if(commands.begin(), commands.end(),
                   [](const ProgramCommand& command) { return command.options->parsed(); });
  return asked->run();
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  // A write beyond the limit of file sizes (ulimit -f) is to fail with its message, not to end the
  // program within a line.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return dispatch(argc, argv);
  } catch (const std::exception& error) {
    print_error(text_of(error));
  }
  return kFailed;
}

}  // namespace plekton::apps
