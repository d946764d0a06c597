// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/plot_command.hpp"

#include "apps/pictures/draw_plot.hpp"
#include "apps/pictures/other_picture.hpp"
#include "apps/run/other_file.hpp"
#include "apps/scenario/problems.hpp"
#include "dynamics/output/file.hpp"

#include <fmt/format.h>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

PictureKind kind_of(const fs::path& file) {
  if (file.extension() == ".svg") return PictureKind::svg;
  if (file.extension() == ".png") return PictureKind::png;
  throw InputError(
      fmt::format("--out: got \"{}\"; expected a file that ends in .svg or .png", file.string()));
}

}  // namespace

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

}  // namespace plekton::apps
