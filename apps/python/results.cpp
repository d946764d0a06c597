// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/view_command.hpp"
#include "apps/python/arrays.hpp"
#include "apps/viewer/read_results.hpp"
#include "apps/viewer/run_folder.hpp"

#include <pybind11/stl/filesystem.h>

#include <sstream>

namespace plekton::python {
namespace {

namespace fs = std::filesystem;

/// Rows of so many numbers; a column alone is no table.
py::array_t<double> table_of(const std::vector<double>& values, std::size_t columns) {
  auto array = array_of(values);
  if (columns == 1) return array;
  return array.reshape({py::ssize_t{-1}, static_cast<py::ssize_t>(columns)});
}

py::dict dict_of(const std::vector<apps::ResultArray>& arrays) {
  py::dict dict;
  for (const apps::ResultArray& array : arrays)
    dict[py::str(array.name)] = table_of(array.values, array.components);
  return dict;
}

py::dict read_frame(const fs::path& file) {
  const apps::Results results = apps::read_results(file);
  py::dict frame;
  frame["positions"] = table_of(results.positions, 3);
  frame["lines"] = table_of(results.line_ends, 2).attr("astype")("int64");
  frame["facets"] = table_of(results.corners, 3).attr("astype")("int64");
  frame["of_points"] = dict_of(results.of_points);
  frame["of_cells"] = dict_of(results.of_cells);
  return frame;
}

/// Columns and units by name.
py::tuple read_history(const fs::path& file) {
  py::dict columns, units;
  for (const apps::RecordedHistory::Column& column : apps::read_history(file).columns) {
    columns[py::str(column.name)] = array_of(column.values);
    units[py::str(column.name)] = column.unit;
  }
  return py::make_tuple(columns, units);
}

/// Report as text or None, times, and the files of each frame by series.
py::tuple open_run(const fs::path& folder) {
  const apps::RunFolder run = apps::open_run_folder(folder);
  py::object report = py::none();
  if (run.report) report = py::module_::import("json").attr("loads")(run.report->dump());
  std::vector<double> times;
  py::list frames;
  for (const apps::FrameFiles& frame : run.frames) {
    times.push_back(frame.time);
    py::dict files;
    for (std::size_t series = 0; series < apps::kSeries.size(); ++series)
      if (!frame.of[series].empty()) files[py::str(apps::kSeries[series])] = frame.of[series];
    frames.append(files);
  }
  return py::make_tuple(report, array_of(times), frames);
}

fs::path view_run(const fs::path& folder, const fs::path& out) {
  std::ostringstream unseen;
  apps::view_run({folder, out, apps::ViewArguments{}.limit, {}}, unseen);
  return out;
}

}  // namespace

void bind_results(py::module_& module) {
  module.def("_open_run", &open_run);
  module.def("_read_frame", &read_frame);
  module.def("_read_history", &read_history);
  module.def("_view_run", &view_run);
}

}  // namespace plekton::python
