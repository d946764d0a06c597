// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/view_command.hpp"

#include "apps/command_line/exit_code.hpp"
#include "apps/command_line/interrupt.hpp"
#include "apps/run/other_file.hpp"
#include "apps/scenario/problems.hpp"
#include "apps/viewer/page.hpp"
#include "apps/viewer/server.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

void write(const ViewArguments& arguments, std::size_t limit, std::ostream& out) {
  const RunFolder run = open_run_folder(arguments.run);
  const PageData data = pack_run(run, limit);
  const fs::path file = arguments.out.value_or(arguments.run / kViewPage);
  const std::size_t size = write_page(file, run, data);
  for (const std::string& note : data.notes) out << "note: " << note << '\n';
  out << fmt::format("wrote {}: {} frames, {:.1f} MB; open it in a browser, no network is needed\n",
                     file.string(), data.packed.frames(), 1e-6 * static_cast<double>(size));
}

void serve(const ViewArguments& arguments, std::size_t limit, std::ostream& out) {
  const InterruptGuard guard;
  serve_run({arguments.run, *arguments.port, limit, [&] { return guard.interrupted(); },
             [&](const std::string& address) {
               out << "open " << address << " in a browser of this machine; Ctrl-C ends\n"
                   << std::flush;
             }});
}

/// What `plekton view` was asked for, as it is given.
struct ViewOptions {
  fs::path run;
  fs::path out;  ///< empty: not given
  double limit = ViewArguments{}.limit;
  std::string port;  ///< empty: not given
};

/// The port of --serve: kPort if only that is said. @throws InputError
int port_option(const std::string& text) {
  constexpr int kPort = 8317;
  if (text.empty()) return kPort;
  int port = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc() || end != text.data() + text.size() || port < 0 || port > 65535)
    throw InputError(fmt::format(
        "--serve: got \"{}\"; expected a port from 1 to 65535, or 0 for any that is free", text));
  return port;
}

/// @param is_served  whether --serve is given, with a port or without
ViewArguments arguments_of(const ViewOptions& options, bool is_served) {
  ViewArguments arguments;
  arguments.run = options.run;
  if (!options.out.empty()) arguments.out = options.out;
  arguments.limit = options.limit;
  if (is_served) arguments.port = port_option(options.port);
  return arguments;
}

}  // namespace

void view_run(const ViewArguments& arguments, std::ostream& out) {
  // The command line has checked the range, which a number that is none passes.
  if (std::isnan(arguments.limit))
    throw InputError("--limit: got nan; expected a number from 0.1 to 4000, MB");
  const auto limit = static_cast<std::size_t>(1e6 * arguments.limit);
  arguments.port ? serve(arguments, limit, out) : write(arguments, limit, out);
}

ProgramCommand add_view(CLI::App& app) {
  const auto options = std::make_shared<ViewOptions>();
  CLI::App* view = app.add_subcommand("view", "Write a page that shows a run in a browser");
  view->add_option("run", options->run, "Folder that plekton run wrote to")->required();
  CLI::Option* const out = view->add_option("--out", options->out,
                                            "File to write; view.html in that folder if not given");
  view->add_option("--limit", options->limit,
                   "Most data in MB; of more, every second frame is left out, and so on")
      ->check(CLI::Range(0.1, 4000.0))
      ->capture_default_str();
  const CLI::Option* const serve =
      view->add_option("--serve", options->port,
                       "Show it at http://127.0.0.1:PORT instead, to this machine only, "
                       "and follow it while it runs; port 8317 if not given")
          ->expected(0, 1)
          ->type_name("[PORT]")
          ->excludes(out);
  return {view, [options, serve] {
            view_run(arguments_of(*options, serve->count() > 0), std::cout);
            flush_output();
            return kDone;
          }};
}

}  // namespace plekton::apps
