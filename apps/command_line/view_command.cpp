// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/view_command.hpp"

#include "apps/command_line/interrupt.hpp"
#include "apps/run/other_file.hpp"
#include "apps/scenario/problems.hpp"
#include "apps/viewer/page.hpp"
#include "apps/viewer/server.hpp"

#include <fmt/format.h>

#include <cmath>

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

}  // namespace

void view_run(const ViewArguments& arguments, std::ostream& out) {
  // The command line has checked the range, which a number that is none passes.
  if (std::isnan(arguments.limit))
    throw InputError("--limit: got nan; expected a number from 0.1 to 4000, MB");
  const auto limit = static_cast<std::size_t>(1e6 * arguments.limit);
  arguments.port ? serve(arguments, limit, out) : write(arguments, limit, out);
}

}  // namespace plekton::apps
