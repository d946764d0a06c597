// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/pictures/render.hpp"

#include "apps/pictures/render_script.hpp"
#include "apps/programs/child_process.hpp"
#include "apps/programs/run_program.hpp"
#include "apps/programs/scratch_folder.hpp"
#include "apps/scenario/problems.hpp"
#include "dynamics/output/file.hpp"
#include "geometry/base/regular_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <vector>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

/// As one word of an argument: a point and the normal of each.
std::string planes_text(const RunFolder& run, double time) {
  std::string text;
  for (const auto& plane : planes_at(run, time)) text += fmt::format("{} ", fmt::join(plane, " "));
  return text;
}

/// Empty where the run has no such frame.
std::string path_of(const FrameFiles& frame, std::size_t series) {
  return frame.of[series].empty() ? "" : fs::absolute(frame.of[series]).string();
}

/// The program, by way of a screen in memory where there is none.
std::vector<std::string> pvbatch_command() {
  const auto pvbatch = find_program("pvbatch");
  if (!pvbatch)
    throw InputError(
        "render: the program pvbatch of ParaView, which draws, is not installed "
        "(Debian: paraview); plekton view shows the run in a browser without it");
  if (std::getenv("DISPLAY") != nullptr) return {pvbatch->string()};
  const auto xvfb = find_program("xvfb-run");
  if (!xvfb)
    throw InputError(
        "render: there is no screen here, and the program xvfb-run, which stands in "
        "for one, is not installed (Debian: xvfb); plekton view needs none");
  return {xvfb->string(), "-a", pvbatch->string()};
}

}  // namespace

const FrameFiles& frame_at(const RunFolder& run, std::optional<double> time) {
  if (run.frames.empty())
    throw InputError(
        fmt::format("{}: the run has no frames; see [output] interval", run.folder.string()));
  const FrameFiles* nearest = &run.frames.back();
  if (!time) return *nearest;
  const double last = run.frames.back().time;
  const double interval = run.frames.size() > 1 ? last - std::prev(run.frames.end(), 2)->time : 0.0;
  if (*time > last + interval)
    throw InputError(
        fmt::format("--at: the run has frames from {:.6g} s to {:.6g} s, none near "
                    "{:.6g} s",
                    run.frames.front().time, last, *time));
  for (const FrameFiles& frame : run.frames)
    if (std::abs(frame.time - *time) < std::abs(nearest->time - *time)) nearest = &frame;
  return *nearest;
}

std::string rendered_frame(const RunFolder& run, const FrameFiles& frame) {
  std::vector<std::string> arguments = pvbatch_command();
  const ScratchFolder scratch("render");
  const fs::path picture = scratch.path() / "picture.png";
  const fs::path script = scratch.path() / "render_frame.py";
  dynamics::OutputFile file(script);
  file.write(render_script());
  file.commit();
  arguments.insert(arguments.end(), {script.string(), picture.string(), path_of(frame, 0),
                                     path_of(frame, 1), planes_text(run, frame.time),
                                     fmt::format("{}, {:.4g} s", run.title, frame.time)});
  run_to_end(arguments, scratch.path() / "log");
  try {
    return geometry::read_regular_file(picture, "a picture");
  } catch (const geometry::UnreadableFile&) {
    throw InputError("render: pvbatch has written no picture; does it run by itself?");
  }
}

}  // namespace plekton::apps
