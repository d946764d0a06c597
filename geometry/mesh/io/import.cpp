// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/import.hpp"

#include "geometry/mesh/io/mesh_file.hpp"

#include <cmath>
#include <string>
#include <utility>

namespace plekton::geometry {
namespace {

PolygonSoup scaled(PolygonSoup soup, double scale, const std::string& source) {
  if (!(scale > 0.0) || !std::isfinite(scale))
    throw MeshError(source + ": a scale of " + std::to_string(scale) +
                    "; expected a positive number");
  if (scale == 1.0) return soup;
  for (Vec3& point : soup.points) point *= scale;
  return soup;
}

}  // namespace

ImportedMesh import_mesh(const std::filesystem::path& path, const ImportOptions& options) {
  options.repair.tell("reading");
  return import_soup(read_mesh_file(path), path.filename().string(), options);
}

ImportedMesh import_soup(PolygonSoup soup, const std::string& source,
                         const ImportOptions& options) {
  ImportedMesh imported;
  imported.report.source = source;
  imported.mesh =
      repair(scaled(std::move(soup), options.scale, source), options.repair, imported.report);
  const MeshReport& report = imported.report;
  if (report.verdict != MeshVerdict::refused) return imported;

  if (report.reasons.size() == 1)
    throw RefusedMesh(report.source + ": " + report.reasons.front(), report.failed_step);
  std::string message = report.source + ": refused";
  for (const std::string& reason : report.reasons) message += "\n  " + reason;
  throw RefusedMesh(message, report.failed_step);
}

ImportedMembrane import_membrane(const std::filesystem::path& path, const MembraneOptions& membrane,
                                 const ImportOptions& options) {
  ImportedMesh imported = import_mesh(path, options);
  ImportedMembrane result{std::move(imported.mesh), {}, std::move(imported.report)};
  result.membrane = make_membrane(result.mesh, membrane);
  const auto& warnings = result.membrane.warnings;
  result.report.reasons.insert(result.report.reasons.end(), warnings.begin(), warnings.end());
  if (!warnings.empty()) result.report.verdict = MeshVerdict::usable_with_warnings;
  return result;
}

}  // namespace plekton::geometry
