// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/progress.hpp"
#include "apps/run/run.hpp"
#include "apps/scenario/scenario.hpp"

#include <unistd.h>

#include <iostream>
#include <string>

namespace plekton::apps {

/// How to tell a progress there.
ProgressStyle style_on(int descriptor, bool quiet);

/// Says on standard error what is being set up, so that results stay alone on standard output.
/// @param set_up  (hear), what is done meanwhile
/// @param task    what lines begin with
template <class SetUp>
auto aloud(bool quiet, SetUp&& set_up, const std::string& task = "setting up") {
  SetUpProgress progress(std::cerr, style_on(STDERR_FILENO, quiet), SetUpProgress::Clock::now(),
                         task);
  return set_up([&](const std::string& what, double share) { progress.update(what, share); });
}

/// prepare_run(), aloud.
PreparedRun prepared_aloud(const Scenario& scenario, bool quiet);

}  // namespace plekton::apps
