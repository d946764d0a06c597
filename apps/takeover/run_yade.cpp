// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/takeover/run_yade.hpp"

#include "apps/programs/child_process.hpp"
#include "apps/programs/run_program.hpp"
#include "apps/programs/scratch_folder.hpp"
#include "apps/scenario/problems.hpp"
#include "apps/takeover/export_script.hpp"
#include "dynamics/output/file.hpp"
#include "geometry/base/regular_file.hpp"

#include <fmt/format.h>

namespace plekton::apps::yade {

namespace fs = std::filesystem;

Scene run_to(const fs::path& script, std::optional<long> iteration) {
  if (std::error_code ignored; !fs::is_regular_file(script, ignored))
    throw InputError(
        fmt::format("{}: there is no such file; expected a script of YADE (.py)", script.string()));
  const auto yade = find_program("yade");
  if (!yade)
    throw InputError(
        "import-yade: the program yade, which runs the script, is not installed (Debian: yade)");
  const ScratchFolder scratch("yade");
  const fs::path exporter = scratch.path() / "export_scene.py",
                 told = scratch.path() / "scene.json";
  dynamics::OutputFile file(exporter);
  file.write(export_script());
  file.commit();
  // -j1: the same input gives the same scene each time.
  run_to_end({yade->string(), "-n", "-x", "-j1", exporter.string(), fs::absolute(script).string(),
              iteration ? fmt::format("{}", *iteration) : "end", told.string()},
             scratch.path() / "log");
  try {
    return parse_scene(geometry::read_regular_file(told, "a scene"));
  } catch (const geometry::UnreadableFile&) {
    throw InputError("import-yade: yade has written no scene; does it run by itself?");
  }
}

}  // namespace plekton::apps::yade
