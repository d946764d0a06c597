// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/mesh_file.hpp"

#include "geometry/base/regular_file.hpp"
#include "geometry/mesh/io/readers.hpp"

#include <algorithm>

namespace plekton::geometry {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& path) {
  std::string bytes;
  try {
    bytes = read_regular_file(path, "a mesh (.off, .obj, .stl, .ply, .msh, .vtp)");
  } catch (const UnreadableFile& error) {
    throw MeshError(error.what());
  }
  if (bytes.empty())
    throw MeshError(path.filename().string() +
                    ": the file is empty; expected points and facets; export the mesh again");
  return bytes;
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

/// The first word of a text, passing over lines of comment as OFF has them.
std::string_view first_word(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\v\f\r\n";
  while (true) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return {};
    text.remove_prefix(begin);
    if (text.front() != '#') return text.substr(0, text.find_first_of(kBlanks));
    text.remove_prefix(std::min(text.find_first_of("\r\n"), text.size()));
  }
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
  if (ending == ".msh") return MeshFormat::gmsh;
  if (ending == ".vtp") return MeshFormat::vtp;
  throw MeshError(path.filename().string() + ": the ending '" + ending +
                  "' is no mesh format; expected .off, .obj, .stl, .ply, .msh or .vtp; convert the "
                  "file or rename it");
}

MeshFormat detect_mesh_format(std::string_view bytes, const fs::path& path) {
  const std::string_view text = without_byte_order_mark(bytes);
  // Before the words: its header may begin with any. No text has that size, which in letters would
  // be above 7 GB.
  if (is_binary_stl(text)) return MeshFormat::stl_binary;
  const std::string_view first = first_word(text);
  if (first == "ply") return MeshFormat::ply;
  if (first == "$MeshFormat") return MeshFormat::gmsh;
  if (first == "<VTKFile") return MeshFormat::vtp;
  if (first == "solid") return MeshFormat::stl_ascii;
  for (const std::string_view word : {"OFF", "COFF", "NOFF", "CNOFF", "STOFF"})
    if (first == word) return MeshFormat::off;
  for (const std::string_view word : {"v", "vt", "vn", "o", "g", "mtllib", "usemtl"})
    if (first == word) return MeshFormat::obj;
  // What comes before the root of an XML file (declaration, comments) is short.
  constexpr std::size_t kProlog = 4096;
  const bool is_xml = first.starts_with("<?xml") || first.starts_with("<!--");
  if (is_xml && bytes.substr(0, kProlog).find("<VTKFile") != std::string_view::npos)
    return MeshFormat::vtp;
  return mesh_format_of(path);
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
      return read_ply(without_byte_order_mark(bytes), name);
    case MeshFormat::gmsh:
      return read_gmsh(without_byte_order_mark(bytes), name);
    case MeshFormat::vtp:
      return read_vtp(without_byte_order_mark(bytes), name);
  }
  throw MeshError(name + ": unknown mesh format");
}

PolygonSoup read_mesh_file(const fs::path& path) {
  const std::string bytes = contents(path);
  return parse_mesh(bytes, detect_mesh_format(bytes, path), path.filename().string());
}

}  // namespace plekton::geometry
