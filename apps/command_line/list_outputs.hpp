// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>

namespace plekton::apps {

/// Prints what a run can write, with units: from the tables by which the files are written.
void list_outputs(std::ostream& out);

}  // namespace plekton::apps
