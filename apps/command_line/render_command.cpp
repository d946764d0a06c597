// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/render_command.hpp"

#include "apps/command_line/resume_command.hpp"
#include "apps/pictures/other_picture.hpp"
#include "apps/pictures/render.hpp"
#include "apps/run/other_file.hpp"
#include "apps/scenario/problems.hpp"
#include "dynamics/output/file.hpp"

#include <fmt/format.h>

namespace plekton::apps {

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

}  // namespace plekton::apps
