// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/cylinder.hpp"
#include "geometry/primitives/facet.hpp"
#include "geometry/primitives/feature.hpp"
#include "geometry/primitives/sphere.hpp"

#include <array>
#include <span>
#include <vector>

namespace plekton::geometry {

/// The primitives of a scene, over shared nodes. The position in its table is an element's id.
struct Elements {
  std::vector<Sphere> spheres = {};
  std::vector<Cylinder> cylinders = {};
  std::vector<Facet> facets = {};
};

/// How facets and cylinders hang together: every node, edge and face once, and who touches whom.
///
/// Nodes and edges are shared, never copied: any number of facets may meet at an edge, and facets
/// and free cylinders at a node. A cylinder along a side of a facet is the facet's own rim and adds
/// no edge. The maximal cells are the facets, then the free cylinders; a feature is owned by its
/// lowest cell.
class Surface {
 public:
  Surface() = default;

  /// Time and memory grow linearly with the number of elements, times log for sorting the edges.
  /// @throws std::invalid_argument listing every problem: more nodes than a NodeId counts (and
  ///         nothing else then), a node id out of range, an element that
  ///         repeats a node, two facets on the same three nodes, a radius that is negative or not
  ///         below 1e75 m, connected elements with different radii.
  Surface(std::span<const Cylinder> cylinders, std::span<const Facet> facets,
          std::size_t node_count);

  /// The surface of those elements that are left when others have broken away: as if built anew,
  /// but structures keep their numbers, radii and what they were. So a structure is what was
  /// connected at first; it may fall apart, and one without elements is left as a number.
  ///
  /// A side of a facet that is gone stays only as the side of another facet or with a cylinder
  /// along it. Linear in the number of elements, times log for sorting the edges.
  /// @param cylinders  along edges of this surface; radii, also of facets, are not looked at
  /// @param facets     of this surface, in their order
  /// @throws std::invalid_argument if an element is none of this surface, or the order is another
  Surface left_with(std::span<const Cylinder> cylinders, std::span<const Facet> facets) const;

  std::size_t face_count() const noexcept { return face_nodes_.size(); }
  std::size_t edge_count() const noexcept { return edge_nodes_.size(); }
  std::size_t cell_count() const noexcept { return face_nodes_.size() + free_edges_.size(); }
  std::size_t structure_count() const noexcept { return structure_radius_.size(); }
  /// Nodes of the scene, also those that no facet or cylinder uses.
  std::size_t node_count() const noexcept { return node_structure_.size(); }

  const std::array<NodeId, 3>& nodes_of(FaceId face) const noexcept {
    return face_nodes_[index_of(face)];
  }
  /// Lower node first.
  const std::array<NodeId, 2>& nodes_of(EdgeId edge) const noexcept {
    return edge_nodes_[index_of(edge)];
  }
  /// Side k joins corners k and k + 1 (mod 3).
  const std::array<EdgeId, 3>& edges_of(FaceId face) const noexcept {
    return face_edges_[index_of(face)];
  }
  /// Ascending.
  std::span<const EdgeId> edges_of(NodeId node) const noexcept {
    return node_edges_[index_of(node)];
  }
  /// Ascending.
  std::span<const FaceId> faces_of(NodeId node) const noexcept {
    return node_faces_[index_of(node)];
  }
  /// Ascending.
  std::span<const FaceId> faces_of(EdgeId edge) const noexcept {
    return edge_faces_[index_of(edge)];
  }

  /// A cell as a feature: its face, or its free edge.
  Feature feature_of(CellId cell) const noexcept;
  /// Nodes of a cell: 3 of a facet, 2 of a free cylinder.
  std::span<const NodeId> nodes_of(CellId cell) const noexcept;
  /// Place in its table of the facet or the cylinder that a cell is: the first of the cylinders if
  /// several are along one edge. Of left_with() the tables are those of what is left.
  std::size_t place_of(CellId cell) const noexcept {
    const std::size_t i = index_of(cell);
    return i < face_count() ? i : free_cylinders_[i - face_count()];
  }
  CellId owner_of(EdgeId edge) const noexcept { return edge_owner_[index_of(edge)]; }
  /// Of a node that belongs to some cell.
  CellId owner_of(NodeId node) const noexcept { return node_owner_[index_of(node)]; }

  /// The structure of a node: what is connected, or was before elements broke away; -1 for a node
  /// that no cell uses.
  StructureId structure_of(NodeId node) const noexcept { return node_structure_[index_of(node)]; }
  StructureId structure_of(CellId cell) const noexcept {
    return structure_of(nodes_of(cell).front());
  }
  /// Radius (m) of every cell of a structure.
  double radius(StructureId structure) const noexcept {
    return structure_radius_[index_of(structure)];
  }
  /// Whether a structure has facets, or had some before they broke away.
  bool is_sheet(StructureId structure) const noexcept {
    return structure_is_sheet_[index_of(structure)];
  }

  /// Nodes in use - edges + faces.
  int euler_characteristic() const noexcept;

 private:
  /// Lists of different lengths in one array.
  template <class Id>
  struct Lists {
    std::vector<std::uint32_t> start;
    std::vector<Id> items;
    std::span<const Id> operator[](std::size_t i) const noexcept {
      return {items.data() + start[i], items.data() + start[i + 1]};
    }
  };

  void build_edges(std::span<const Cylinder> cylinders, std::span<const Facet> facets);
  template <class Element>
  void require_nodes(std::span<const Element> elements) const;
  void require_part(const Surface& part) const;
  void build_incidence();
  void place_cylinders(std::span<const Cylinder> cylinders);
  void build_structures(std::span<const Cylinder> cylinders, std::span<const Facet> facets);

  std::vector<std::array<NodeId, 3>> face_nodes_;
  std::vector<std::array<EdgeId, 3>> face_edges_;
  std::vector<std::array<NodeId, 2>> edge_nodes_;
  std::vector<EdgeId> free_edges_;
  std::vector<std::uint32_t> free_cylinders_;  ///< places, by free edge
  Lists<EdgeId> node_edges_;
  Lists<FaceId> node_faces_;
  Lists<FaceId> edge_faces_;
  std::vector<CellId> edge_owner_;
  std::vector<CellId> node_owner_;
  std::vector<StructureId> node_structure_;
  std::vector<double> structure_radius_;
  std::vector<bool> structure_is_sheet_;
};

}  // namespace plekton::geometry
