// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target of the whole import: the first byte chooses the reader, the second the repairs,
// the others are the file. Whatever it holds, the outcome is a mesh that fits its report, or a
// refusal.
#include "geometry/mesh/repair/fill_holes.hpp"
#include "geometry/mesh/io/mesh_file.hpp"
#include "geometry/mesh/repair/remesh.hpp"
#include "geometry/mesh/repair/repair.hpp"
#include "tests/fuzz/require.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

namespace {

using namespace plekton::geometry;
using plekton::fuzz::require;

constexpr std::size_t kChoices = 2;     // bytes before the file
constexpr std::size_t kLargest = 2048;  // bytes, so that a run is short

PolygonSoup soup_of(std::uint8_t choice, std::string_view bytes) {
  constexpr std::array kFormats = {MeshFormat::off, MeshFormat::obj,  MeshFormat::stl_binary,
                                   MeshFormat::ply, MeshFormat::gmsh, MeshFormat::vtp};
  const std::size_t reader = choice % (kFormats.size() + 1);
  return parse_mesh(
      bytes, reader < kFormats.size() ? kFormats[reader] : detect_mesh_format(bytes, "fuzzed.stl"),
      "fuzzed");
}

double largest_coordinate(const std::vector<Vec3>& points) {
  double largest = 0.0;
  for (const Vec3& point : points) largest = std::max(largest, point.cwiseAbs().maxCoeff());
  return largest;
}

RepairOptions options_of(std::uint8_t choice, const PolygonSoup& soup) {
  RepairOptions options;
  options.orient = (choice & 1U) != 0;
  options.refuse_intersections = (choice & 4U) != 0;
  // A weld of a hundredth of the largest coordinate is in the range of any of them.
  if ((choice & 8U) != 0) options.weld_distance = 0.01 * largest_coordinate(soup.points);
  return options;
}

void require_sound(const Mesh& mesh) {
  require(!mesh.facets.empty(), "a mesh without facets that is not refused");
  for (const Vec3& point : mesh.points) require(point.allFinite(), "a point that is not finite");
  for (const auto& facet : mesh.facets) {
    for (const NodeId node : facet)
      require(index_of(node) < mesh.points.size(), "a corner that is no point");
  }
}

/// The steps that change the shape. Not by the options: the distance before and after, by many
/// samples, would take all the time; a wrap would too.
void reshape_as_chosen(std::uint8_t choice, Mesh& mesh) {
  if ((choice & 2U) != 0) {
    const std::size_t before = mesh.facets.size();
    const FilledHoles filled = fill_holes(mesh, std::numeric_limits<double>::infinity());
    require(mesh.facets.size() == before + filled.facets, "a filling that is not told");
    require_sound(mesh);
  }
  if ((choice & 16U) != 0) {
    for (const Vec3& point : remesh(mesh, 0.5 * largest_coordinate(mesh.points)).points)
      require(point.allFinite(), "a point that is not finite");
  }
}

void import(std::uint8_t reader, std::uint8_t repairs, std::string_view bytes) {
  const PolygonSoup soup = soup_of(reader, bytes);
  MeshReport report;
  report.source = "fuzzed";
  Mesh mesh = repair(soup, options_of(repairs, soup), report);
  require(!to_text(report).empty() && !to_json(report).empty(), "an empty report");
  if (report.verdict == MeshVerdict::refused) {
    require(!report.reasons.empty(), "a refusal without a reason");
    return;
  }
  require_sound(mesh);
  require(mesh.facets.size() == report.after.facets, "another number of facets than it reports");
  reshape_as_chosen(repairs, mesh);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size <= kChoices || size > kLargest) return 0;
  try {
    import(data[0], data[1], {reinterpret_cast<const char*>(data) + kChoices, size - kChoices});
  } catch (const MeshError&) {
    // Refused, as it should be.
  }
  return 0;
}
