// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Tables as text, after RFC 4180: commas between cells, quotes around cells that hold a comma, a
/// quote (doubled) or a line break.
namespace plekton::apps {

struct CsvRow {
  int line = 1;  ///< where it begins, from 1
  std::vector<std::string> cells;
  std::string problem = {};  ///< with its quotes, of which the cells show nothing; empty: none
};

/// Rows of a table; lines with nothing but blanks on them are left out, while "" is a row with an
/// empty cell. Blanks around a cell without quotes do not belong to it, nor does the byte order mark
/// of UTF-8 at the beginning. A quote that is not closed ends with the text, and what stands behind
/// a closing quote is left out: the row has a problem then.
std::vector<CsvRow> parse_csv(std::string_view text);

/// A cell as it is written.
std::string csv_cell(std::string_view text);

}  // namespace plekton::apps
