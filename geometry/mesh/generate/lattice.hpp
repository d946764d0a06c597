// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"
#include "geometry/primitives/cylinder.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

/// Nets, grids and chains: bars over shared nodes, with nothing between them. Nets and grids lie in
/// the plane z = 0, centred on the origin; lengths in m. Each generator throws MeshError for a
/// length that is not positive and below 1e75 m, for a count below its least, and before anything
/// is made for more nodes than their numbers count.
namespace plekton::geometry {

/// What a bar of a lattice is, because its parts differ in section and stiffness.
enum class LatticePart : std::uint8_t {
  rib,    ///< of a geogrid, along y (machine direction)
  bar,    ///< of a geogrid, along x (cross-machine direction)
  wire,   ///< of a net: a single wire
  twist,  ///< of a net: two wires wound around each other
  ring,   ///< of a ring net
  link    ///< of a chain
};

struct LatticeEdge {
  std::array<NodeId, 2> nodes;  ///< lower node first
  LatticePart part;
  friend bool operator==(const LatticeEdge&, const LatticeEdge&) = default;
};

struct Lattice {
  std::vector<Vec3> points;        ///< m, indexed by NodeId
  std::vector<LatticeEdge> edges;  ///< every edge once, ascending by nodes
};

struct BiaxialGeogrid {
  double pitch_x;         ///< m, from rib to rib, between their axes
  double pitch_y;         ///< m, from bar to bar, between their axes
  int apertures_x;        ///< at least 1
  int apertures_y;        ///< at least 1
  int rib_divisions = 1;  ///< elements of each rib and bar between two junctions, at least 1
};

/// Grid drawn in both directions: ribs and bars cross in junctions and share their nodes.
Lattice biaxial_geogrid(const BiaxialGeogrid& grid);

struct UniaxialGeogrid {
  double rib_pitch;       ///< m, along x between the axes of neighbouring ribs
  double bar_pitch;       ///< m, along y between the axes of neighbouring bars; above rib_pitch
  int apertures_x;        ///< at least 1
  int apertures_y;        ///< at least 1
  int rib_divisions = 4;  ///< elements of a rib between two bars, at least 1
};

/// Grid drawn in one direction (y): long slender ribs between bars across, which stay stiff and
/// are not divided between ribs.
Lattice uniaxial_geogrid(const UniaxialGeogrid& grid);

struct HexagonalNet {
  double mesh_size;     ///< m, D: distance of two neighbouring twists of a row, between their axes
  double twist_length;  ///< m, of the part where two wires are wound around each other
  double wire_height;   ///< m, of a single wire between two rows of twists, measured along y
  int meshes_across;    ///< in a row, at least 2
  int rows;             ///< of twists, at least 1
};

/// Double-twisted hexagonal net with its twists along y. A mesh has a twist on either side and four
/// single wires, and is twist_length + 2 wire_height long. Rows are offset by half a mesh: the
/// first and every second row after it has meshes_across meshes, the others one less. No wire ends
/// free.
/// Source: the mesh size D is that of makers' data sheets after EN 10223-3:2013, the distance
/// between the axes of two consecutive twists (+16 %, -4 %); nets are named by D and length in cm
/// (6x8, 8x10, 10x12); the twist has to be measured or taken from the maker. Nodes at the ends of
/// the twists, joined by single wires and twists, as in Bertrand et al., Discrete element method
/// (DEM) numerical modeling of double-twisted hexagonal mesh, Canadian Geotechnical Journal (2008),
/// and in Thoeni et al. (2013).
Lattice hexagonal_net(const HexagonalNet& net);

struct RingNet {
  double ring_diameter;   ///< m, between the axes of the wire
  int rings_x;            ///< at least 1
  int rings_y;            ///< at least 1
  int arc_divisions = 3;  ///< straight elements of a quarter of a ring, at least 1
};

/// Net of rings, each of which hangs together with the four next to it in one point each: rings in
/// rows and columns that share their nodes there, cut into polygons with corners on the circle.
/// Real rings are wound of several wires and may slide through each other; here they do not.
/// Source: Nicot, Cambou & Mazzoleni, Design of rockfall restraining nets from a discrete element
/// modelling, Rock Mech. Rock Eng. 34 (2001) 99-118: rings with four neighbours.
Lattice ring_net(const RingNet& net);

struct Chain {
  std::vector<Vec3> points;  ///< m, at least 2; one that is equal to the first at the end closes it
  int divisions = 1;         ///< links of equal length between two points, at least 1
};

/// Links one after the other through points: ropes, cables, roots, beams, rings. It is numbered
/// along itself.
/// @throws MeshError also for points that are not finite, two equal ones in a row, and a closed
///         chain of fewer than 3 links
Lattice chain(const Chain& chain);

/// The bars of a lattice as cylinders, in the order of its edges.
/// @param radius      m, of all, because what is joined needs one radius.
/// @param first_node  Number that the first point of the lattice gets among the nodes of the scene.
/// @throws MeshError if the radius is not positive and finite, or the numbers of the nodes do not
///         fit a NodeId.
std::vector<Cylinder> cylinders_of(const Lattice& lattice, double radius,
                                   std::size_t first_node = 0);

}  // namespace plekton::geometry
