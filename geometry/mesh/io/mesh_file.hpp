// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace plekton::geometry {

/// File formats. Reading tells the kinds of STL, PLY, gmsh and VTP apart by content; writing makes
/// gmsh files of version 2.2 and VTP files with numbers as text.
enum class MeshFormat { off, obj, stl_ascii, stl_binary, ply, gmsh, vtp };

/// Polygons of an OFF, OBJ, STL (ASCII or binary), PLY (ASCII or binary), gmsh (.msh 2.2 or 4.1,
/// ASCII) or VTK XML PolyData (.vtp) file, as they are in it: nothing is merged, dropped or cut
/// into triangles, except triangle strips. A file that holds no polygon is read without complaint.
/// The format is that of detect_mesh_format.
/// @throws MeshError for a file that is missing, empty, of another kind, cut off or malformed, and
///         for coordinates that are not finite or not below kLargestCoordinate and corners that
///         name no point, all of them in one message.
PolygonSoup read_mesh_file(const std::filesystem::path& path);

/// The same from memory. Time and memory are linear in the size of the text, whatever counts it
/// claims (a .vtp file that unpacks to more than 16 numbers a byte is refused).
/// @param name  What messages call it.
/// @throws MeshError as read_mesh_file()
PolygonSoup parse_mesh(std::string_view bytes, MeshFormat format, const std::string& name);

/// Format by content where it starts with words that only one format has ("ply", "$MeshFormat",
/// "<VTKFile", "OFF", "solid", "v", "o", "mtllib" and others of OBJ) or has the size that the header
/// of a binary STL asks for, whatever the ending; by the ending otherwise.
/// @throws MeshError if neither tells.
MeshFormat detect_mesh_format(std::string_view bytes, const std::filesystem::path& path);

/// Format by the ending of a file name, in upper or lower case; .stl means binary STL.
/// @throws MeshError for any other ending.
MeshFormat mesh_format_of(const std::filesystem::path& path);

/// A mesh that could not be written, for a reason that is not its own.
struct UnwrittenMesh : MeshError {
  using MeshError::MeshError;
};

/// Writes a mesh such that reading it gives the same coordinates; binary STL rounds them to 24
/// bits. Either the whole file appears or none: a temporary file beside it is renamed when it is
/// complete.
/// @throws UnwrittenMesh if the folder does not exist or cannot be written, or the disk is full;
///         MeshError for a mesh that no file can hold, see format_mesh, and for any other ending.
void write_mesh_file(const std::filesystem::path& path, const Mesh& mesh, MeshFormat format);
void write_mesh_file(const std::filesystem::path& path, const Mesh& mesh);

/// The bytes that write_mesh_file writes.
/// @throws MeshError for facets that name a point which is not there, for coordinates that are not
///         finite or not below kLargestCoordinate, which no file is read with, and in binary STL for
///         those that a float does not hold.
std::string format_mesh(const Mesh& mesh, MeshFormat format);

}  // namespace plekton::geometry
