// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

#include <string>
#include <string_view>

/// One reader for each format, behind parse_mesh.
///
/// They are our own because the readers of CGAL 5.5 do not suit files of unknown origin: OBJ and
/// PLY corners that name no point pass, "f 1 2 x" becomes a polygon of two corners, a continued OBJ
/// line fails, counts claimed by a header are allocated unseen, a binary STL of 60 bytes is an
/// empty mesh, STL points are merged unasked (so that no report can count them), and a refused file
/// gets neither a line nor a reason. Where CGAL reads a file, the tests demand the same polygons.
namespace plekton::geometry {

/// OFF text with coordinates in three dimensions; the colours, normals and texture coordinates of
/// COFF, NOFF and STOFF are passed over.
PolygonSoup read_off(std::string_view text, const std::string& name);

/// Points and polygons of Wavefront OBJ: corners from 1 on, negative ones counted from the last
/// point back, in any of the forms p, p/t, p//n, p/t/n. Everything else (curves, groups, materials)
/// is passed over.
PolygonSoup read_obj(std::string_view text, const std::string& name);

/// STL. Binary if the size is what the facet count in the header asks for, or if the bytes are no
/// text; never by the word "solid", which binary files start with too.
PolygonSoup read_stl(std::string_view bytes, const std::string& name);

/// Whether the size is what the facet count in the header of a binary STL asks for.
bool is_binary_stl(std::string_view bytes) noexcept;

/// PLY 1.0, ASCII or binary of either byte order, with the elements "vertex" and "face"; others are
/// passed over.
PolygonSoup read_ply(std::string_view bytes, const std::string& name);

/// Triangles and quadrangles of a gmsh .msh file, version 2.2 or 4.1, ASCII. Points, lines and
/// solids are counted as skipped; groups, partitions and results are passed over. Curved surface
/// elements (of second order and more) are refused, because their corners alone are another
/// surface. Source: Gmsh reference manual, "File formats".
PolygonSoup read_gmsh(std::string_view text, const std::string& name);

/// Polygons and triangle strips of a VTK XML PolyData file: arrays as text, as base64 in place, or
/// appended as base64 or raw, plain or compressed by zlib, of either byte order; pieces one after
/// the other. Vertices and lines are counted as skipped, results passed over. Source: VTK User's
/// Guide, "VTK File Formats" (docs.vtk.org).
PolygonSoup read_vtp(std::string_view bytes, const std::string& name);

}  // namespace plekton::geometry
