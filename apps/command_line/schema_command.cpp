// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/schema_command.hpp"

#include "apps/command_line/exit_code.hpp"
#include "apps/scenario/json_schema.hpp"

#include <CLI/CLI.hpp>

#include <iostream>

namespace plekton::apps {

ProgramCommand add_schema(CLI::App& app) {
  CLI::App* schema = app.add_subcommand(
      "schema", "Print a JSON Schema of scenarios, for completion and checks in editors");
  return {schema, [] {
            std::cout << scenario_schema().dump(2) << '\n';
            flush_output();
            return kDone;
          }};
}

}  // namespace plekton::apps
