// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/repair/measures.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::geometry {

enum class MeshVerdict : std::uint8_t {
  ok,        ///< nothing was changed but equal points merged and flat polygons cut
  repaired,  ///< facets dropped or turned, points welded or removed, holes filled, remeshed
  usable_with_warnings,  ///< something remains that the user should know
  refused                ///< there is no mesh to use
};
std::string_view name_of(MeshVerdict verdict) noexcept;

/// Steps of a repair that change the shape, and only if asked for.
enum class RepairStep : std::uint8_t { fill_holes, wrap, remesh };

/// What an import found, what it changed, and what remains.
struct MeshReport {
  std::string source;  ///< what messages call the mesh

  /// As it came.
  struct Found {
    std::size_t points = 0;
    std::size_t polygons = 0;
    std::size_t skipped_elements = 0;       ///< points, lines and solids of the file, left out
    std::size_t non_triangles = 0;          ///< polygons with any other number of corners than 3
    std::size_t warped_polygons = 0;        ///< more than 5 % of their size out of plane
    std::size_t duplicate_points = 0;       ///< equal to an earlier one
    std::size_t near_duplicate_points = 0;  ///< distinct, but within near_distance of another one
    double near_distance = 0.0;             ///< m, 1e-6 of the diagonal of the bounds
    std::size_t inconsistent_edges =
        0;  ///< ordinary edges along which both facets run the same way
  } found;

  /// What repair did.
  struct Changed {
    std::size_t points_merged = 0;         ///< equal ones
    std::size_t points_welded = 0;         ///< distinct ones, within the weld distance
    double weld_distance = 0.0;            ///< m
    double largest_weld_move = 0.0;        ///< m
    std::size_t polygons_cut = 0;          ///< into triangles
    std::size_t repeated_node_facets = 0;  ///< dropped: less than three different nodes
    std::size_t zero_area_facets = 0;      ///< dropped: exactly collinear
    std::size_t duplicate_facets = 0;      ///< dropped: the nodes of an earlier one, in any order
    std::size_t slits = 0;                 ///< edges that a dropped zero-area facet leaves open
    std::size_t flipped_facets = 0;        ///< turned over
    std::size_t unused_points = 0;         ///< removed: no facet uses them
  } changed;

  /// Filling of holes, wrapping and remeshing, from the cleaned mesh to the final one.
  struct Reshaped {
    std::size_t holes_filled = 0;
    std::size_t hole_facets = 0;          ///< that fill them
    std::size_t holes_left = 0;           ///< that could not be filled
    double wrap_detail = 0.0;             ///< m, 0 if not wrapped
    double target_edge = 0.0;             ///< m, 0 if not remeshed
    double area_before = 0.0;             ///< m²
    std::optional<double> volume_before;  ///< m³, as MeshMeasures::volume
    double distance = 0.0;  ///< m, largest sampled distance between the old and the new surface
    double distance_bound = 0.0;  ///< m, the Hausdorff distance is not above this
  };
  std::optional<Reshaped> reshaped;  ///< only if any of it was asked for

  MeshMeasures after;
  MeshVerdict verdict = MeshVerdict::ok;
  std::vector<std::string> reasons;       ///< a sentence for every warning or refusal
  std::optional<RepairStep> failed_step;  ///< could not be done; the mesh is refused for it
};

/// A table to read.
std::string to_text(const MeshReport& report);

/// The same as one JSON object; values that do not exist are null.
std::string to_json(const MeshReport& report);

}  // namespace plekton::geometry
