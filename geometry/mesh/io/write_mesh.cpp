// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/new_file.hpp"
#include "geometry/mesh/io/byte_order.hpp"
#include "geometry/mesh/io/mesh_file.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <iomanip>
#include <limits>
#include <sstream>
#include <system_error>

namespace plekton::geometry {
namespace {

namespace fs = std::filesystem;

void append_number(std::string& text, double value) {
  std::array<char, 32>
      digits;  // The shortest text that reads back as the same double needs at most 24.
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), end);
}

void append_point(std::string& text, const Vec3& point) {
  append_number(text, point[0]);
  for (const int axis : {1, 2}) append_number(text += ' ', point[axis]);
}

/// The corners of facets as numbers from an offset on, each line behind a prefix.
void append_facets(std::string& text, const Mesh& mesh, const char* prefix, std::size_t first) {
  for (const auto& facet : mesh.facets) {
    text += prefix;
    for (const NodeId node : facet) text += ' ' + std::to_string(index_of(node) + first);
    text += '\n';
  }
}

void append_points(std::string& text, const Mesh& mesh, const char* prefix) {
  for (const Vec3& point : mesh.points) {
    append_point(text += prefix, point);
    text += '\n';
  }
}

std::string format_off(const Mesh& mesh) {
  std::string text = "OFF\n" + std::to_string(mesh.points.size()) + ' ' +
                     std::to_string(mesh.facets.size()) + " 0\n";
  append_points(text, mesh, "");
  append_facets(text, mesh, "3", 0);
  return text;
}

std::string format_obj(const Mesh& mesh) {
  std::string text;
  append_points(text, mesh, "v ");
  append_facets(text, mesh, "f", 1);
  return text;
}

std::string format_ply(const Mesh& mesh) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(mesh.points.size()) +
                     "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                     std::to_string(mesh.facets.size()) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  append_points(text, mesh, "");
  append_facets(text, mesh, "3", 0);
  return text;
}

/// Version 2.2, ASCII; every facet an element of type 2 without tags.
std::string format_gmsh(const Mesh& mesh) {
  std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(mesh.points.size()) + '\n';
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    append_point(text += std::to_string(i + 1) + ' ', mesh.points[i]);
    text += '\n';
  }
  text += "$EndNodes\n$Elements\n" + std::to_string(mesh.facets.size()) + '\n';
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    text += std::to_string(f + 1) + " 2 0";
    for (const NodeId node : mesh.facets[f]) text += ' ' + std::to_string(index_of(node) + 1);
    text += '\n';
  }
  return text += "$EndElements\n";
}

/// XML PolyData with all numbers as text.
std::string format_vtp(const Mesh& mesh) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\">\n<PolyData>\n"
      "<Piece NumberOfPoints=\"" +
      std::to_string(mesh.points.size()) + "\" NumberOfPolys=\"" +
      std::to_string(mesh.facets.size()) +
      "\">\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n";
  append_points(text, mesh, "");
  text +=
      "</DataArray>\n</Points>\n<Polys>\n"
      "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
  append_facets(text, mesh, "", 0);
  text += "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  for (std::size_t f = 1; f <= mesh.facets.size(); ++f) text += std::to_string(3 * f) + '\n';
  return text += "</DataArray>\n</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

/// Unit normal; zero for a facet without area, as STL readers expect.
Vec3 unit_normal(const std::array<Vec3, 3>& x) {
  const Vec3 normal = (x[1] - x[0]).cross(x[2] - x[0]);
  const double length = normal.stableNorm();
  return length > 0.0 && length < std::numeric_limits<double>::infinity() ? Vec3(normal / length)
                                                                          : Vec3(Vec3::Zero());
}

std::array<Vec3, 3> corners(const Mesh& mesh, const std::array<NodeId, 3>& facet) {
  return {mesh.points[index_of(facet[0])], mesh.points[index_of(facet[1])],
          mesh.points[index_of(facet[2])]};
}

std::string format_stl_ascii(const Mesh& mesh) {
  std::string text = "solid plekton\n";
  for (const auto& facet : mesh.facets) {
    const auto x = corners(mesh, facet);
    append_point(text += "facet normal ", unit_normal(x));
    text += "\n  outer loop\n";
    for (const Vec3& point : x) {
      append_point(text += "    vertex ", point);
      text += '\n';
    }
    text += "  endloop\nendfacet\n";
  }
  return text += "endsolid plekton\n";
}

std::string format_stl_binary(const Mesh& mesh) {
  std::string bytes("binary STL");  // Not starting with "solid", which some readers take for ASCII.
  bytes.resize(80, ' ');
  append_little(bytes, static_cast<std::uint32_t>(mesh.facets.size()));
  const auto append = [&](const Vec3& v) {
    for (const double coordinate : v) append_little(bytes, static_cast<float>(coordinate));
  };
  for (const auto& facet : mesh.facets) {
    const auto x = corners(mesh, facet);
    append(unit_normal(x));
    for (const Vec3& point : x) append(point);
    append_little(bytes, std::uint16_t{0});
  }
  return bytes;
}

/// @returns whether all bytes are in the file
bool write_and_close(int descriptor, const std::string& bytes) {
  std::FILE* file = ::fdopen(descriptor, "w");
  if (file == nullptr) {
    ::close(descriptor);
    return false;
  }
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  return std::fclose(file) == 0 && written;
}

/// @throws MeshError naming the first point that is elsewhere
void require_coordinates(const Mesh& mesh, MeshFormat format) {
  const bool is_float = format == MeshFormat::stl_binary;
  const double largest = is_float ? double{std::numeric_limits<float>::max()} : kLargestCoordinate;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vec3& p = mesh.points[i];
    if (p.allFinite() && p.cwiseAbs().maxCoeff() < largest) continue;
    std::ostringstream text;
    text << "point " << i << " is at (" << p[0] << ", " << p[1] << ", " << p[2]
         << "), but every coordinate must be a finite number below " << std::setprecision(3)
         << largest << " in size" << (is_float ? " in binary STL" : "");
    throw MeshError(text.str());
  }
}

}  // namespace

std::string format_mesh(const Mesh& mesh, MeshFormat format) {
  require_corners(mesh);
  require_coordinates(mesh, format);
  switch (format) {
    case MeshFormat::off:
      return format_off(mesh);
    case MeshFormat::obj:
      return format_obj(mesh);
    case MeshFormat::stl_ascii:
      return format_stl_ascii(mesh);
    case MeshFormat::stl_binary:
      return format_stl_binary(mesh);
    case MeshFormat::ply:
      return format_ply(mesh);
    case MeshFormat::gmsh:
      return format_gmsh(mesh);
    case MeshFormat::vtp:
      return format_vtp(mesh);
  }
  throw MeshError("unknown mesh format");
}

void write_mesh_file(const fs::path& path, const Mesh& mesh, MeshFormat format) {
  if (is_no_file(path))
    throw UnwrittenMesh(path.string() +
                        ": is a device, pipe or socket, no file; choose another name");
  const std::string bytes = format_mesh(mesh, format);
  const fs::path part = part_of(path);
  const int descriptor = create_new_file(part);
  if (descriptor < 0)
    throw UnwrittenMesh(
        part.string() + ": cannot be created: " + std::generic_category().message(errno) +
        "; check that the folder exists and is writable, and remove what has this name");
  const bool complete = write_and_close(descriptor, bytes);
  std::error_code error;
  if (complete) fs::rename(part, path, error);
  if (!complete || error) {
    std::error_code ignored;
    fs::remove(part, ignored);
    throw UnwrittenMesh(path.string() + ": cannot be written (" + std::to_string(bytes.size()) +
                        " bytes); check that the disk has room and that no folder has this name");
  }
}

void write_mesh_file(const fs::path& path, const Mesh& mesh) {
  write_mesh_file(path, mesh, mesh_format_of(path));
}

}  // namespace plekton::geometry
