// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/reshape.hpp"

#include "geometry/mesh/repair/fill_holes.hpp"
#include "geometry/mesh/repair/orientation.hpp"
#include "geometry/mesh/repair/remesh.hpp"
#include "geometry/mesh/repair/surface_distance.hpp"
#include "geometry/mesh/repair/wrap.hpp"

#include <exception>
#include <new>
#include <utility>

namespace plekton::geometry {
namespace {

/// A part that was open may be closed now, and then its outside is known.
void turn_outward(Mesh& mesh, MeshReport& report) {
  const Orientation orientation = find_orientation(mesh, EdgeTable(mesh));
  report.changed.flipped_facets += orientation.flipped;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    if (orientation.flip[f]) std::swap(mesh.facets[f][1], mesh.facets[f][2]);
}

void fill(Mesh& mesh, const RepairOptions& options, MeshReport& report) {
  const FilledHoles holes = fill_holes(mesh, options.longest_hole);
  report.reshaped->holes_filled = holes.filled;
  report.reshaped->hole_facets = holes.facets;
  report.reshaped->holes_left = holes.left;
  if (holes.filled > 0 && options.orient) turn_outward(mesh, report);
}

/// What fails leaves report.failed_step behind.
void run_steps(Mesh& mesh, const RepairOptions& options, MeshReport& report) {
  MeshReport::Reshaped& done = *report.reshaped;
  if (options.fill_holes) {
    report.failed_step = RepairStep::fill_holes;
    options.tell("filling holes");
    fill(mesh, options, report);
  }
  if (options.wrap) {
    report.failed_step = RepairStep::wrap;
    options.tell("wrapping");
    const MeshMeasures now = measure(mesh, false);
    constexpr double kUsualDetail = 1.0 / 30.0;  // of the diagonal of the bounds
    const double diagonal = (now.bounds.upper - now.bounds.lower).norm();
    done.wrap_detail = options.wrap_detail > 0.0 ? options.wrap_detail : kUsualDetail * diagonal;
    mesh = wrap(mesh, done.wrap_detail);
  }
  if (options.target_edge != 0.0) {
    report.failed_step = RepairStep::remesh;
    options.tell("remeshing");
    mesh = remesh(mesh, options.target_edge);
    done.target_edge = options.target_edge;
  }
  if (!mesh.facets.empty()) report.failed_step.reset();
}

}  // namespace

std::vector<std::string> reshape(Mesh& mesh, const RepairOptions& options, MeshReport& report) {
  if (!options.fill_holes && !options.wrap && options.target_edge == 0.0) return {};
  const Mesh before = mesh;
  const MeshMeasures measures = measure(before, false);
  report.reshaped = MeshReport::Reshaped{};
  report.reshaped->area_before = measures.area;
  report.reshaped->volume_before = measures.volume;
  try {
    run_steps(mesh, options, report);
  } catch (const MeshError& error) {
    return {error.what()};
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    // CGAL checks what it computes and gives up with an exception.
    return {std::string("the geometry library gave up on this mesh: ") + error.what() +
            "; repair it in the program that made it"};
  }
  if (mesh.facets.empty()) return {"nothing is left of the surface; use a finer length"};
  options.tell("measuring how far the surface has moved");
  const SurfaceDistance distance = surface_distance(before, mesh);
  report.reshaped->distance = distance.sampled;
  report.reshaped->distance_bound = distance.bound;
  return {};
}

}  // namespace plekton::geometry
