// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/mesh_file.hpp"

#include "geometry/mesh/readers.hpp"

#include <fstream>
#include <sstream>
#include <system_error>

namespace plekton::geometry {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& path) {
  const std::string name = path.filename().string();
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    throw MeshError(path.string() +
                    ": no such file; check the path (it counts from the current folder)");
  if (!fs::is_regular_file(path, ignored))
    throw MeshError(path.string() + ": not a file; expected a mesh (.off, .obj, .stl, .ply)");

  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  if (file.peek() != std::ifstream::traits_type::eof()) bytes << file.rdbuf();
  if (!file.is_open() || file.bad() || bytes.bad())
    throw MeshError(path.string() + ": cannot be read; check its permissions");
  if (bytes.view().empty())
    throw MeshError(name +
                    ": the file is empty; expected points and facets; export the mesh again");
  return std::move(bytes).str();
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

}  // namespace

MeshFormat mesh_format_of(const fs::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (ending == ".off") return MeshFormat::off;
  if (ending == ".obj") return MeshFormat::obj;
  if (ending == ".stl") return MeshFormat::stl_binary;
  if (ending == ".ply") return MeshFormat::ply;
  throw MeshError(
      path.filename().string() + ": the ending '" + ending +
      "' is no mesh format; expected .off, .obj, .stl or .ply; convert the file or rename it");
}

PolygonSoup parse_mesh(std::string_view bytes, MeshFormat format, const std::string& name) {
  switch (format) {
    case MeshFormat::off:
      return read_off(without_byte_order_mark(bytes), name);
    case MeshFormat::obj:
      return read_obj(without_byte_order_mark(bytes), name);
    case MeshFormat::stl_ascii:
    case MeshFormat::stl_binary:
      return read_stl(without_byte_order_mark(bytes), name);
    case MeshFormat::ply:
      return read_ply(bytes, name);
  }
  throw MeshError(name + ": unknown mesh format");
}

PolygonSoup read_mesh_file(const fs::path& path) {
  const std::string bytes = contents(path);
  return parse_mesh(bytes, mesh_format_of(path), path.filename().string());
}

}  // namespace plekton::geometry
