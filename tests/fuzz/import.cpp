// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target of the whole import: the first byte chooses the repairs, the others are an OFF
// file. Whatever it holds, the outcome is a mesh that fits its report, or a refusal.
#include "geometry/mesh/fill_holes.hpp"
#include "geometry/mesh/mesh_file.hpp"
#include "geometry/mesh/repair.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string_view>

namespace {

using namespace plekton::geometry;

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "the import gave %s\n", what);
  std::abort();
}

RepairOptions options_of(std::uint8_t choice, const PolygonSoup& soup) {
  RepairOptions options;
  options.orient = (choice & 1U) != 0;
  options.refuse_intersections = (choice & 4U) != 0;
  if ((choice & 8U) != 0 && !soup.points.empty()) {
    // A weld of a hundredth of the largest coordinate is in the range of any of them.
    double size = 0.0;
    for (const Vec3& point : soup.points) size = std::max(size, point.cwiseAbs().maxCoeff());
    options.weld_distance = 0.01 * size;
  }
  return options;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2 || size > 2048) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    const PolygonSoup soup = parse_mesh(bytes, MeshFormat::off, "fuzzed");
    MeshReport report;
    report.source = "fuzzed";
    Mesh mesh = repair(soup, options_of(data[0], soup), report);
    if (report.verdict == MeshVerdict::refused) {
      require(!report.reasons.empty(), "a refusal without a reason");
      return 0;
    }
    require(!mesh.facets.empty(), "a mesh without facets that is not refused");
    require(mesh.facets.size() == report.after.facets, "another number of facets than it reports");
    for (const Vec3& point : mesh.points) require(point.allFinite(), "a point that is not finite");
    for (const auto& facet : mesh.facets) {
      for (const NodeId node : facet)
        require(index_of(node) < mesh.points.size(), "a corner that is no point");
    }
    // Not by the options: the distance before and after, by many samples, would take all the time.
    if ((data[0] & 2U) != 0) {
      const FilledHoles filled = fill_holes(mesh, std::numeric_limits<double>::infinity());
      require(mesh.facets.size() == report.after.facets + filled.facets,
              "a filling that is not told");
    }
  } catch (const MeshError&) {
    // Refused, as it should be.
  }
  return 0;
}
