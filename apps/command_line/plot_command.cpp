// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/plot_command.hpp"

#include "apps/command_line/exit_code.hpp"
#include "apps/pictures/draw_plot.hpp"
#include "apps/pictures/other_picture.hpp"
#include "apps/run/other_file.hpp"
#include "apps/scenario/problems.hpp"
#include "dynamics/output/file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

/// What `plekton plot` was asked for.
struct PlotArguments {
  fs::path run;                      ///< folder of a run
  std::vector<std::string> columns;  ///< none: all that say something
  std::string x;                     ///< column on the horizontal axis; empty: the time
  fs::path out;                      ///< .svg or .png; empty: plot.svg and plot.png in the folder
};

PictureKind kind_of(const fs::path& file) {
  if (file.extension() == ".svg") return PictureKind::svg;
  if (file.extension() == ".png") return PictureKind::png;
  throw InputError(
      fmt::format("--out: got \"{}\"; expected a file that ends in .svg or .png", file.string()));
}

/// Draws the histories of a run. @throws InputError, ViewError, dynamics::OutputError
void plot_run(const PlotArguments& arguments, std::ostream& out) {
  std::vector<fs::path> files = {arguments.out};
  if (arguments.out.empty()) files = {arguments.run / kPlotDrawing, arguments.run / kPlotPicture};
  for (const fs::path& file : files) kind_of(file);
  for (const fs::path& file : files) refuse_other_picture(file);
  const RunFolder run = open_run_folder(arguments.run);
  const std::vector<RecordedHistory> histories = read_histories(arguments.run);
  const std::vector<std::string> columns = column_names_in(arguments.columns, histories);
  const std::vector<PlotPanel> panels = panels_of(histories, columns, arguments.x);
  for (const fs::path& file : files) {
    const std::string picture = drawn_plot(panels, run.title, kind_of(file));
    dynamics::OutputFile written(file);
    written.write(picture);
    written.commit();
    out << "wrote " << file.string() << '\n';
  }
}

}  // namespace

ProgramCommand add_plot(CLI::App& app) {
  const auto arguments = std::make_shared<PlotArguments>();
  CLI::App* plot = app.add_subcommand("plot", "Draw the histories of a run, with gnuplot");
  plot->add_option("run", arguments->run, "Folder that plekton run wrote to")->required();
  plot->add_option("--columns", arguments->columns,
                   "Columns of energy.csv, reactions.csv, pressures.csv, rigid_bodies.csv, "
                   "ties.csv, planes.csv and measures/NAME.csv, without their units, with commas "
                   "between them; all that are not 0, and of planes.csv those that change, but "
                   "time_step, if not given");
  plot->add_option(
      "--x", arguments->x,
      "Column on the horizontal axis, as in --x \"front edge.position_y\", for columns "
      "of the same file; the time if not given");
  plot->add_option(
      "--out", arguments->out,
      "File to write, .svg or .png; plot.svg and plot.png in that folder if not given");
  return {plot, [arguments] {
            plot_run(*arguments, std::cout);
            flush_output();
            return kDone;
          }};
}

}  // namespace plekton::apps
