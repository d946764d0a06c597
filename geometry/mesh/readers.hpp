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

/// PLY 1.0, ASCII or binary of either byte order, with the elements "vertex" and "face"; others are
/// passed over.
PolygonSoup read_ply(std::string_view bytes, const std::string& name);

}  // namespace plekton::geometry
