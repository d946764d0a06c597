// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/manual_page.hpp"

#include "geometry/version.hpp"

#include <fmt/format.h>

namespace plekton::apps {
namespace {

/// A text as man(7) takes it: signs that mean something there are written in its way.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  const bool is_request = result.starts_with('.') || result.starts_with('\'');
  return is_request ? "\\&" + result : result;
}

/// A tagged paragraph.
std::string item(std::string_view tag, std::string_view text) {
  return fmt::format(".TP\n.B {}\n{}.\n", escaped(tag), escaped(text));
}

std::string text_of(const CommandEntry& command) {
  std::string text = fmt::format(".SS {}\n.B {}\n.PP\n{}.\n", escaped(command.name),
                                 escaped(usage_of(command)), escaped(command.what));
  for (const CommandOption& option : command.options) {
    if (option.name != "--help") text += item(usage_of(option), option.what);
  }
  return text;
}

constexpr std::string_view kDescription =
    "Plekton simulates grains together with deformable structures \\(em membranes, nets, tubes, "
    "chains \\(em by the discrete element method.\n"
    "A scenario is a TOML file with units in its values;\n"
    ".B plekton list\n"
    "prints every key of it, and\n"
    ".B plekton new\n"
    "writes one to start from.\n";

std::string exit_codes() {
  return item("0", "Done") + item("1", "A problem of the input or the run") +
         item("2", "A command line that cannot be understood") +
         item("3", "With --strict: a run with something red in its certificate") +
         item("130", "Interrupted; the files are complete");
}

std::string examples() {
  constexpr std::string_view kCommands =
      "plekton new first.toml\n"
      "plekton check first.toml\n"
      "plekton run first.toml --out out/first --threads 2\n"
      "plekton view out/first\n"
      "plekton run --resume out/first --set simulation.duration=2\n";
  return fmt::format(".nf\n{}.fi\n", escaped(kCommands));
}

}  // namespace

std::string manual_page(std::span<const CommandEntry> commands, std::string_view date) {
  std::string page =
      fmt::format(".TH PLEKTON 1 {} \"Plekton {}\" \"User Commands\"\n", date, escaped(kVersion));
  page += ".SH NAME\nplekton \\- discrete element method with deformable structures\n";
  page +=
      ".SH SYNOPSIS\n.B plekton\n.I COMMAND\n.RI [ ARGUMENTS ]\n.br\n"
      ".B plekton \\-\\-version\n.br\n.B plekton\n.RI [ COMMAND ]\n.B \\-\\-help\n";
  page += fmt::format(".SH DESCRIPTION\n{}", kDescription);
  page += ".SH COMMANDS\n";
  for (const CommandEntry& command : commands) page += text_of(command);
  page += ".SH EXIT STATUS\n" + exit_codes();
  page += ".SH ENVIRONMENT\n" +
          item("PLEKTON_VECTOR_WIDTH",
               "Numbers in a vector of the kernels, 2, 4 or 8, instead of as many as the processor "
               "has; the results are the same bits, the speed is not");
  page += ".SH FILES\n" +
          item("out/SCENARIO", "Results of a run, where --out does not name another folder") +
          item("PREFIX/share/plekton/examples", "What plekton examples copies");
  page += ".SH EXAMPLES\n" + examples();
  page += ".SH SEE ALSO\n.BR paraview (1)\n";
  return page;
}

}  // namespace plekton::apps
