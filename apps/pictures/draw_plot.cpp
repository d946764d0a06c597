// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/pictures/draw_plot.hpp"

#include "apps/programs/child_process.hpp"
#include "apps/programs/run_program.hpp"
#include "apps/programs/scratch_folder.hpp"
#include "apps/scenario/problems.hpp"
#include "dynamics/output/file.hpp"
#include "geometry/base/regular_file.hpp"

namespace plekton::apps {

std::string drawn_plot(const std::vector<PlotPanel>& panels, const std::string& title,
                       PictureKind kind) {
  const auto gnuplot = find_program("gnuplot");
  if (!gnuplot)
    throw InputError(
        "plot: the program gnuplot, which draws, is not installed (Debian: "
        "gnuplot-nox); the histories themselves are the .csv files of the run");
  // Names of ours alone: a name for output that begins with | would be a command.
  const ScratchFolder scratch("plot");
  const std::filesystem::path picture = scratch.path() / "picture";
  dynamics::OutputFile script(scratch.path() / "script");
  script.write(gnuplot_script(panels, title, kind, picture.string()));
  script.commit();
  run_to_end({gnuplot->string(), "-d", (scratch.path() / "script").string()},
             scratch.path() / "log");
  return geometry::read_regular_file(picture, "a picture");
}

}  // namespace plekton::apps
