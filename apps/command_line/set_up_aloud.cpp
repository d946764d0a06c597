// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/set_up_aloud.hpp"

namespace plekton::apps {

ProgressStyle style_on(int descriptor, bool quiet) {
  if (quiet) return ProgressStyle::none;
  return ::isatty(descriptor) != 0 ? ProgressStyle::one_line : ProgressStyle::lines;
}

PreparedRun prepared_aloud(const Scenario& scenario, bool quiet) {
  return aloud(quiet, [&](const HearSetUp& hear) { return prepare_run(scenario, hear); });
}

}  // namespace plekton::apps
