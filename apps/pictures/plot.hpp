// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/viewer/run_folder.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps {

/// Curves over the time, or over another column, that share an axis.
struct PlotPanel {
  std::string quantity;                                 ///< with unit, at the axis
  std::string file;                                     ///< of the run, where they are from
  std::string x_head;                                   ///< with unit
  std::vector<double> x;                                ///< by row: the time, or another column
  std::vector<const RecordedHistory::Column*> columns;  ///< of a history that outlives this
};

/// Names of columns in texts with commas between them. Names may have commas themselves: each is the
/// longest one of a column that the rest of the text begins with; what is none ends with the next comma.
std::vector<std::string> column_names_in(std::span<const std::string> texts,
                                         const std::vector<RecordedHistory>& histories);

/// What is drawn of the histories of a run, one panel for each file and unit. Of columns without a
/// unit, whole numbers have one panel and each other quantity has its own.
/// @param names  Columns, as their heads are without unit; none: all that are not 0 throughout, of
///        planes.csv those that change, but the time step.
/// @param x  Column over which the others of its file, or of each file that has one, are drawn; empty:
///        the time, of all files.
/// @throws InputError for a name that no history has or whose values are not finite, for columns of
///         another file than that of x, and if there is nothing to draw
std::vector<PlotPanel> panels_of(const std::vector<RecordedHistory>& histories,
                                 std::span<const std::string> names, const std::string& x = "");

/// The kinds of pictures.
enum class PictureKind { svg, png };

/// Commands for gnuplot that draw panels into a file of that kind. No text of a user can become a
/// command: texts stand in single quotes, where gnuplot reads them as they are.
std::string gnuplot_script(const std::vector<PlotPanel>& panels, const std::string& title,
                           PictureKind kind, const std::string& output);

}  // namespace plekton::apps
