// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_membrane_source.hpp"

#include "apps/scenario/read_ondem_source.hpp"

#include <fmt/format.h>

#include <array>
#include <system_error>
#include <utility>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

fs::path read_mesh_path(Section& section, const Known& known) {
  const std::string name = section.text("mesh");
  if (name.empty()) return {};
  fs::path path = known.folder / name;
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) {
    const std::string_view what = fs::exists(path, ignored) ? "is not a file" : "does not exist";
    section.complain(
        "mesh", fmt::format("\"{}\" {}; expected a mesh (.off, .obj, .stl, .ply, .msh, .vtp), its "
                            "path relative to the scenario",
                            path.string(), what));
  }
  return path;
}

/// A step of the repair and the length that says more about it. The length alone asks for the step
/// too, as an option of `plekton import` does.
bool read_step(Section& section, std::string_view step, std::string_view length) {
  const bool has_length = section.has(length);
  const bool wanted = section.truth(step, has_length);
  section.tell_default(step, "false");
  if (has_length && !wanted)
    section.complain(length, fmt::format("goes with {0}, which is false; leave {1} out, or {0} "
                                         "(then {1} alone asks for it)",
                                         step, length));
  return wanted;
}

geometry::RepairOptions read_repair(Section& section) {
  constexpr Quantity kPositiveLength{kLength, kPositive};
  geometry::RepairOptions repair;
  repair.weld_distance = section.quantity("weld", {kLength, kNotNegative}, repair.weld_distance);
  repair.fill_holes = read_step(section, "fill_holes", "longest_hole");
  repair.longest_hole = section.quantity("longest_hole", kPositiveLength, repair.longest_hole);
  repair.wrap = read_step(section, "wrap", "wrap_detail");
  section.tell_default("wrap_detail", "1/30 of the mesh's size");
  repair.wrap_detail = section.quantity("wrap_detail", kPositiveLength, repair.wrap_detail);
  section.tell_default("target_edge", "none");
  repair.target_edge = section.quantity("target_edge", kPositiveLength, repair.target_edge);
  repair.refuse_intersections = section.truth("refuse_intersections", repair.refuse_intersections);
  return repair;
}

/// Where messages about a step point to: the length that was given, else the key of the step.
std::map<geometry::RepairStep, RepairKey> repair_keys(Section& section) {
  using geometry::RepairStep;
  constexpr std::array<std::pair<RepairStep, std::string_view>, 5> kKeys = {
      {{RepairStep::fill_holes, "longest_hole"},
       {RepairStep::fill_holes, "fill_holes"},
       {RepairStep::wrap, "wrap_detail"},
       {RepairStep::wrap, "wrap"},
       {RepairStep::remesh, "target_edge"}}};
  std::map<RepairStep, RepairKey> keys;
  for (const auto& [step, key] : kKeys)
    if (section.has(key))
      keys.try_emplace(step, RepairKey{std::string(key), section.place_of(key)});
  return keys;
}

void refuse_repair(Section& section) {
  for (const std::string_view key : {"weld", "fill_holes", "longest_hole", "wrap", "wrap_detail",
                                     "target_edge", "refuse_intersections"}) {
    if (section.has(key))
      section.complain(key, "repairs a mesh, and a shape has nothing to repair; leave it out");
  }
}

}  // namespace

void read_membrane_source(Section& section, const Known& known, MembraneSettings& membrane) {
  const bool has_mesh = section.has("mesh");
  const bool has_shape = section.has("shape");
  const bool has_ondem = section.has("ondem");
  membrane.source_place = section.place_of(has_ondem ? "ondem" : has_shape ? "shape" : "mesh");
  if (has_ondem && (has_mesh || has_shape)) {
    section.complain("ondem", "has the shape already; leave it, or mesh and shape, out");
  } else if (has_mesh == has_shape && !has_ondem) {
    section.complain(has_mesh ? "shape" : "mesh",
                     fmt::format("got {} of mesh and shape; expected exactly one of them: a mesh "
                                 "file, or shape = {{ kind = \"sheet\", ... }}",
                                 has_mesh ? "both" : "none"));
  }
  if (has_mesh) membrane.mesh = read_mesh_path(section, known);
  if ((has_shape || has_ondem) && !has_mesh) {
    refuse_repair(section);
  } else {
    membrane.repair = read_repair(section);
    membrane.repair_keys = repair_keys(section);
  }
  if (has_shape || !has_ondem)
    if (const auto shape = section.table("shape")) membrane.shape = read_shape(*shape);
  if (has_ondem) read_ondem_membrane(section, known, membrane);
}

}  // namespace plekton::apps
