// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>

namespace plekton::apps {

/// Prints what a scenario can name, with parameters, units and defaults.
void list_choices(std::ostream& out);

}  // namespace plekton::apps
