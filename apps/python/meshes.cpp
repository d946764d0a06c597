// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/python/arrays.hpp"
#include "apps/python/from_python.hpp"
#include "apps/python/interpreter_lock.hpp"
#include "geometry/mesh/io/import.hpp"
#include "geometry/mesh/io/mesh_file.hpp"

#include <fmt/format.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <limits>

namespace plekton::python {
namespace {

using geometry::ImportOptions;
using geometry::NodeId;
using geometry::RepairOptions;

/// Points, facets, and the report as Python has it.
py::tuple tuple_of(const geometry::ImportedMesh& imported) {
  const py::object report =
      py::module_::import("json").attr("loads")(geometry::to_json(imported.report));
  return py::make_tuple(array_of(imported.mesh.points), array_of(imported.mesh.facets), report);
}

py::tuple import_mesh(const std::filesystem::path& path, double scale,
                      const RepairOptions& repair) {
  geometry::ImportedMesh imported;
  {
    const WithoutLock free;
    imported = geometry::import_mesh(path, {repair, scale});
  }
  return tuple_of(imported);
}

/// Polygons of the same number of corners. @throws geometry::MeshError
geometry::PolygonSoup soup_of(const Numbers& points, const Whole& polygons) {
  geometry::PolygonSoup soup;
  soup.points = vectors_of(points, "points");
  if (polygons.ndim() != 2) require_rows(polygons, 3, "facets");
  for (py::ssize_t i = 0; i < polygons.shape(0); ++i) {
    std::vector<std::size_t> corners;
    for (py::ssize_t k = 0; k < polygons.shape(1); ++k) {
      const std::int64_t corner = polygons.at(i, k);
      if (corner < 0)
        throw geometry::MeshError(fmt::format("facets[{}]: there is no point {}", i, corner));
      corners.push_back(static_cast<std::size_t>(corner));
    }
    soup.polygons.push_back(std::move(corners));
  }
  return soup;
}

py::tuple repair_mesh(const Numbers& points, const py::object& facets,
                      const RepairOptions& repair) {
  geometry::PolygonSoup soup = soup_of(points, whole_numbers(facets, "facets"));
  geometry::ImportedMesh imported;
  {
    const WithoutLock free;
    imported = geometry::import_soup(std::move(soup), "mesh", {repair, 1.0});
  }
  return tuple_of(imported);
}

void write_mesh(const std::filesystem::path& path, const Numbers& points, const py::object& given) {
  const Whole facets = whole_numbers(given, "facets");
  require_rows(facets, 3, "facets");
  geometry::Mesh mesh;
  mesh.points = vectors_of(points, "points");
  for (const auto& corners : soup_of(points, facets).polygons) {
    std::array<NodeId, 3> facet{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (corners[k] >= mesh.points.size())
        throw geometry::MeshError(fmt::format("facets[{}]: there is no point {}; there are {}",
                                              mesh.facets.size(), corners[k], mesh.points.size()));
      facet[k] = geometry::id_at<NodeId>(corners[k]);
    }
    mesh.facets.push_back(facet);
  }
  geometry::write_mesh_file(path, mesh);
}

}  // namespace

void bind_meshes(py::module_& module) {
  py::class_<RepairOptions>(module, "_RepairOptions")
      .def(py::init<>())
      .def_readwrite("weld", &RepairOptions::weld_distance)
      .def_readwrite("orient", &RepairOptions::orient)
      .def_readwrite("fill_holes", &RepairOptions::fill_holes)
      .def_readwrite("longest_hole", &RepairOptions::longest_hole)
      .def_readwrite("wrap", &RepairOptions::wrap)
      .def_readwrite("wrap_detail", &RepairOptions::wrap_detail)
      .def_readwrite("target_edge", &RepairOptions::target_edge)
      .def_readwrite("refuse_intersections", &RepairOptions::refuse_intersections);
  module.def("_length", [](const py::handle& value, const char* name) {
    return quantity_of(value, apps::kLength, name);
  });
  module.def("_number", [](const py::handle& value, const char* name) {
    return quantity_of(value, apps::kNumber, name);
  });
  module.def("_import_mesh", &import_mesh);
  module.def("_repair_mesh", &repair_mesh);
  module.def("write_mesh", &write_mesh, py::arg("path"), py::arg("points"), py::arg("facets"),
             "Writes a mesh (points in m) as .off, .obj, .stl, .ply, .msh or .vtp, by the ending "
             "of the name.");
}

}  // namespace plekton::python
