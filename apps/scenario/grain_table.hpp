// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps {

/// Grains from a file.
struct GrainTable {
  std::vector<geometry::Vec3> centres;  ///< m
  std::vector<double> radii;            ///< m, of each
};

/// The grains of a CSV text: a row x,y,z,r for each, in m. A head row names the columns, in any
/// order: x, y, z and r or radius, each with its unit if that is another, as in "x (mm)"; columns
/// of other names are skipped. Empty rows, and rows that begin with #, are skipped.
/// @param source  what messages call it
/// @throws InputError that names source, row, what was got and what was expected
GrainTable parse_grain_table(std::string_view text, const std::string& source);

/// The same of a file. @throws InputError also where it cannot be read
GrainTable read_grain_table(const std::filesystem::path& file);

}  // namespace plekton::apps
