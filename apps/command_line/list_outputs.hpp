// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/output/output_field.hpp"

#include <iosfwd>
#include <string_view>
#include <vector>

namespace plekton::apps {

/// What one file holds, or one part of it.
struct OutputTable {
  std::string_view title;
  std::vector<dynamics::OutputField> fields;
};

/// All files that a run writes, from the tables by which they are written.
std::vector<OutputTable> output_tables();

/// Prints what a run can write, with units: from the tables by which the files are written.
void list_outputs(std::ostream& out);

}  // namespace plekton::apps
