// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/render_command.hpp"

#include "apps/command_line/exit_code.hpp"
#include "apps/command_line/resumed_run.hpp"
#include "apps/pictures/other_picture.hpp"
#include "apps/pictures/render.hpp"
#include "apps/run/other_file.hpp"
#include "apps/scenario/problems.hpp"
#include "dynamics/output/file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

namespace plekton::apps {
namespace {

/// What `plekton render` was asked for.
struct RenderArguments {
  std::filesystem::path run;  ///< folder of a run
  std::string at;             ///< a time; empty: that of the last frame
  std::filesystem::path out;  ///< .png; empty: frame.png in the folder
};

/// Draws a frame of a run. @throws InputError, ViewError, dynamics::OutputError
void render_run(const RenderArguments& arguments, std::ostream& out) {
  const std::filesystem::path file =
      arguments.out.empty() ? arguments.run / kFramePicture : arguments.out;
  if (file.extension() != ".png")
    throw InputError(
        fmt::format("--out: got \"{}\"; expected a file that ends in .png", file.string()));
  refuse_other_picture(file);
  const RunFolder run = open_run_folder(arguments.run);
  const FrameFiles& frame = frame_at(run, time_option("--at", arguments.at));
  const std::string picture = rendered_frame(run, frame);
  dynamics::OutputFile written(file);
  written.write(picture);
  written.commit();
  out << fmt::format("wrote {}: the frame at {:.6g} s\n", file.string(), frame.time);
}

}  // namespace

ProgramCommand add_render(CLI::App& app) {
  const auto arguments = std::make_shared<RenderArguments>();
  CLI::App* render =
      app.add_subcommand("render", "Draw a frame of a run, with pvbatch of ParaView");
  render->add_option("run", arguments->run, "Folder that plekton run wrote to")->required();
  render->add_option("--at", arguments->at, "Time, as in \"20 ms\"; the last frame if not given");
  render->add_option("--out", arguments->out,
                     "File to write, .png; frame.png in that folder if not given");
  return {render, [arguments] {
            render_run(*arguments, std::cout);
            flush_output();
            return kDone;
          }};
}

}  // namespace plekton::apps
