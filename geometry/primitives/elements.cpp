// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/primitives/elements.hpp"

#include "geometry/base/largest_coordinate.hpp"
#include "geometry/base/problems.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>

namespace plekton::geometry {
namespace {

/// Disjoint sets of nodes.
class Components {
 public:
  explicit Components(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) {
    const auto [low, high] =
        std::minmax({root(i), root(j)});  // by value: the roots are temporaries
    parent_[high] = low;
  }

 private:
  std::vector<std::size_t> parent_;
};

std::array<NodeId, 2> sorted(NodeId a, NodeId b) {
  return a < b ? std::array{a, b} : std::array{b, a};
}

/// Collects the problems of the elements one by one.
class ElementProblems {
 public:
  template <std::size_t N>
  void check(const char* kind, std::size_t id, const std::array<NodeId, N>& nodes, double radius,
             std::size_t node_count) {
    for (const NodeId node : nodes) {
      if (static_cast<std::int64_t>(node) < 0 || index_of(node) >= node_count) {
        line(kind, id) << " names node " << static_cast<std::int32_t>(node) << ", but there are "
                       << node_count << " nodes\n";
      }
    }
    for (std::size_t i = 0; i < N; ++i) {
      if (std::find(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(i), nodes[i]) !=
          nodes.begin() + static_cast<std::ptrdiff_t>(i)) {
        line(kind, id) << " repeats node " << static_cast<std::int32_t>(nodes[i])
                       << "; merge duplicate nodes or delete the element\n";
      }
    }
    if (!(radius >= 0.0 && radius < kLargestCoordinate)) {
      line(kind, id) << " has radius " << radius << " m; it must be at least 0 and below "
                     << kLargestCoordinate << " m\n";
    }
  }

  void count_nodes(std::size_t count, std::int32_t most) {
    text_ << "surface: " << count << " nodes; their numbers end at " << most << '\n';
  }

  std::ostream& line(const char* kind, std::size_t id) {
    return text_ << "surface: " << kind << ' ' << id;
  }

  void throw_if_any() const { geometry::throw_if_any(text_); }

 private:
  std::ostringstream text_;
};

/// Lists connected elements of different radii. An element with a problem of its own connects
/// nothing.
class RadiusCheck {
 public:
  RadiusCheck(std::size_t node_count, ElementProblems& problems)
      : components_(node_count), radius_(node_count, -1.0), problems_(&problems) {}

  template <class Element>
  void connect(std::span<const Element> elements) {
    for (const Element& element : elements) {
      if (!is_usable(element)) continue;
      for (const NodeId node : element.nodes)
        components_.join(index_of(element.nodes[0]), index_of(node));
    }
  }

  /// After all elements are connected.
  template <class Element>
  void compare(const char* kind, std::span<const Element> elements) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (!is_usable(elements[i])) continue;
      const double radius = elements[i].radius;
      double& common = radius_[components_.root(index_of(elements[i].nodes[0]))];
      if (common < 0.0) common = radius;
      if (common == radius) continue;
      problems_->line(kind, i) << " has radius " << radius
                               << " m, but it is connected to elements of radius " << common
                               << " m; all connected facets and cylinders need the same radius\n";
    }
  }

 private:
  template <class Element>
  bool is_usable(const Element& element) const {
    return element.radius >= 0.0 && std::isfinite(element.radius) &&
           std::all_of(element.nodes.begin(), element.nodes.end(), [this](NodeId node) {
             return static_cast<std::int64_t>(node) >= 0 && index_of(node) < radius_.size();
           });
  }

  Components components_;
  std::vector<double> radius_;  // m, of the structure with this root; negative until an element
                                // sets it
  ElementProblems* problems_;
};

/// Of each facet the first one with the same nodes, itself if there is none before it.
std::vector<std::size_t> first_with_same_nodes(std::span<const Facet> facets) {
  struct Entry {
    std::array<NodeId, 3> nodes;
    std::uint32_t facet;
    auto operator<=>(const Entry&) const = default;
  };
  std::vector<Entry> entries(facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    auto [a, b, c] = facets[f].nodes;
    if (b < a) std::swap(a, b);
    if (c < b) std::swap(b, c);
    if (b < a) std::swap(a, b);
    entries[f] = {{a, b, c}, static_cast<std::uint32_t>(f)};
  }
  std::sort(entries.begin(), entries.end());
  std::vector<std::size_t> first(facets.size());
  std::size_t of_run = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].nodes != entries[of_run].nodes) of_run = i;
    first[entries[i].facet] = entries[of_run].facet;
  }
  return first;
}

void check_elements(std::span<const Cylinder> cylinders, std::span<const Facet> facets,
                    std::size_t node_count) {
  ElementProblems problems;
  constexpr auto kMostNodes = std::numeric_limits<std::int32_t>::max();
  if (node_count > static_cast<std::size_t>(kMostNodes)) {
    problems.count_nodes(node_count, kMostNodes);
    problems.throw_if_any();
  }
  const auto first = first_with_same_nodes(facets);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    problems.check("facet", f, facets[f].nodes, facets[f].radius, node_count);
    if (first[f] != f) {
      problems.line("facet", f) << " has the same nodes as facet " << first[f]
                                << "; delete one of them\n";
    }
  }
  for (std::size_t c = 0; c < cylinders.size(); ++c) {
    problems.check("cylinder", c, cylinders[c].nodes, cylinders[c].radius, node_count);
  }
  RadiusCheck radii(node_count, problems);
  radii.connect(facets);
  radii.connect(cylinders);
  radii.compare("facet", facets);
  radii.compare("cylinder", cylinders);
  problems.throw_if_any();
}

}  // namespace

Surface::Surface(std::span<const Cylinder> cylinders, std::span<const Facet> facets,
                 std::size_t node_count) {
  check_elements(cylinders, facets, node_count);
  node_structure_.assign(node_count, StructureId{-1});
  build_edges(cylinders, facets);
  build_incidence();
  place_cylinders(cylinders);
  build_structures(cylinders, facets);
}

Surface Surface::left_with(std::span<const Cylinder> cylinders,
                           std::span<const Facet> facets) const {
  require_nodes(cylinders);
  require_nodes(facets);
  Surface left;
  left.build_edges(cylinders, facets);
  require_part(left);
  left.node_structure_ = node_structure_;
  left.structure_radius_ = structure_radius_;
  left.structure_is_sheet_ = structure_is_sheet_;
  left.build_incidence();
  left.place_cylinders(cylinders);
  for (std::size_t n = 0; n < node_count(); ++n) {
    if (left.node_edges_[n].empty()) left.node_structure_[n] = StructureId{-1};
  }
  return left;
}

/// @throws std::invalid_argument if an element names a node that does not exist
template <class Element>
void Surface::require_nodes(std::span<const Element> elements) const {
  for (const Element& element : elements) {
    for (const NodeId node : element.nodes) {
      if (static_cast<std::int64_t>(node) >= 0 && index_of(node) < node_count()) continue;
      throw std::invalid_argument("surface: an element of those left names node " +
                                  std::to_string(static_cast<std::int32_t>(node)) +
                                  ", but there are " + std::to_string(node_count()) + " nodes");
    }
  }
}

/// @throws std::invalid_argument if facets or edges are none of this surface
void Surface::require_part(const Surface& part) const {
  auto face = face_nodes_.begin();
  for (std::size_t f = 0; f < part.face_nodes_.size(); ++f) {
    face = std::find(face, face_nodes_.end(), part.face_nodes_[f]);
    if (face == face_nodes_.end()) {
      throw std::invalid_argument("surface: facet " + std::to_string(f) +
                                  " of those left is none of the facets there were, or not in "
                                  "their order; only take elements away");
    }
    ++face;
  }
  if (!std::includes(edge_nodes_.begin(), edge_nodes_.end(), part.edge_nodes_.begin(),
                     part.edge_nodes_.end())) {
    throw std::invalid_argument(
        "surface: a cylinder of those left is along none of the edges there were; only take "
        "elements away");
  }
}

/// Edges are collected under their lower nodes: the time is linear, but for sorting those of each
/// node.
void Surface::build_edges(std::span<const Cylinder> cylinders, std::span<const Facet> facets) {
  face_nodes_.reserve(facets.size());
  for (const Facet& facet : facets) face_nodes_.push_back(facet.nodes);
  const auto for_each_side = [&](const auto& visit) {
    for (const auto& n : face_nodes_) {
      for (std::size_t k = 0; k < 3; ++k) visit(sorted(n[k], n[(k + 1) % 3]));
    }
    for (const Cylinder& cylinder : cylinders) visit(sorted(cylinder.nodes[0], cylinder.nodes[1]));
  };
  std::vector<std::size_t> start(1, 0);
  for_each_side([&](const std::array<NodeId, 2>& side) {
    if (start.size() < index_of(side[0]) + 2) start.resize(index_of(side[0]) + 2, 0);
    ++start[index_of(side[0]) + 1];
  });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<NodeId> upper(start.back());
  std::vector<std::size_t> end(start.begin(), start.end());
  for_each_side(
      [&](const std::array<NodeId, 2>& side) { upper[end[index_of(side[0])]++] = side[1]; });

  std::vector<std::size_t> first_edge(start.size(), 0);
  edge_nodes_.reserve(upper.size() / 2 + 1);
  for (std::size_t low = 0; low + 1 < start.size(); ++low) {
    const auto begin = upper.begin() + static_cast<std::ptrdiff_t>(start[low]);
    const auto last = upper.begin() + static_cast<std::ptrdiff_t>(start[low + 1]);
    std::sort(begin, last);
    std::for_each(begin, std::unique(begin, last), [&](NodeId high) {
      edge_nodes_.push_back({id_at<NodeId>(low), high});
    });
    first_edge[low + 1] = edge_nodes_.size();
  }

  face_edges_.resize(face_nodes_.size());
  for (std::size_t f = 0; f < face_nodes_.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto key = sorted(face_nodes_[f][k], face_nodes_[f][(k + 1) % 3]);
      const auto of_node = [&](std::size_t node) {
        return edge_nodes_.begin() + static_cast<std::ptrdiff_t>(first_edge[node]);
      };
      const std::size_t low = index_of(key[0]);
      const auto found = std::lower_bound(of_node(low), of_node(low + 1), key);
      face_edges_[f][k] = id_at<EdgeId>(static_cast<std::size_t>(found - edge_nodes_.begin()));
    }
  }
}

void Surface::build_incidence() {
  // Lists are filled in ascending order of the items, so each comes out sorted.
  const auto fill = [](auto& lists, std::size_t list_count, std::size_t item_count,
                       auto owners_of) {
    using Item = typename std::remove_reference_t<decltype(lists.items)>::value_type;
    lists.start.assign(list_count + 1, 0);
    for (std::size_t i = 0; i < item_count; ++i) {
      for (const auto owner : owners_of(i)) ++lists.start[index_of(owner) + 1];
    }
    std::partial_sum(lists.start.begin(), lists.start.end(), lists.start.begin());
    lists.items.resize(lists.start.back());
    auto next = lists.start;
    for (std::size_t i = 0; i < item_count; ++i) {
      for (const auto owner : owners_of(i)) lists.items[next[index_of(owner)]++] = id_at<Item>(i);
    }
  };
  fill(node_edges_, node_count(), edge_count(), [this](std::size_t e) { return edge_nodes_[e]; });
  fill(node_faces_, node_count(), face_count(), [this](std::size_t f) { return face_nodes_[f]; });
  fill(edge_faces_, edge_count(), face_count(), [this](std::size_t f) { return face_edges_[f]; });

  edge_owner_.resize(edge_count());
  for (std::size_t e = 0; e < edge_count(); ++e) {
    const auto faces = edge_faces_[e];
    if (faces.empty()) {
      edge_owner_[e] = id_at<CellId>(face_count() + free_edges_.size());
      free_edges_.push_back(id_at<EdgeId>(e));
    } else {
      edge_owner_[e] = id_at<CellId>(index_of(faces.front()));
    }
  }
  node_owner_.assign(node_count(), CellId{-1});
  for (std::size_t n = 0; n < node_count(); ++n) {
    for (const EdgeId edge : node_edges_[n]) {
      CellId& owner = node_owner_[n];
      const CellId candidate = edge_owner_[index_of(edge)];
      if (owner == CellId{-1} || candidate < owner) owner = candidate;
    }
  }
}

void Surface::place_cylinders(std::span<const Cylinder> cylinders) {
  free_cylinders_.resize(free_edges_.size());
  for (std::size_t c = cylinders.size(); c-- > 0;) {
    const auto ends = sorted(cylinders[c].nodes[0], cylinders[c].nodes[1]);
    const auto edges = edges_of(ends[0]);
    const auto edge =
        std::find_if(edges.begin(), edges.end(), [&](EdgeId e) { return nodes_of(e) == ends; });
    const std::size_t cell = index_of(owner_of(*edge));
    if (cell >= face_count()) free_cylinders_[cell - face_count()] = static_cast<std::uint32_t>(c);
  }
}

void Surface::build_structures(std::span<const Cylinder> cylinders, std::span<const Facet> facets) {
  Components components(node_count());
  for (const auto& [a, b] : edge_nodes_) components.join(index_of(a), index_of(b));
  for (std::size_t n = 0; n < node_count(); ++n) {
    if (node_edges_[n].empty()) continue;
    const std::size_t root = components.root(n);  // the lowest node of the structure
    if (root == n) {
      node_structure_[n] = id_at<StructureId>(structure_radius_.size());
      structure_radius_.push_back(0.0);
    } else {
      node_structure_[n] = node_structure_[root];
    }
  }

  // Of any of its elements: check_elements found them equal.
  structure_is_sheet_.assign(structure_radius_.size(), false);
  for (const Facet& facet : facets) {
    const std::size_t structure = index_of(structure_of(facet.nodes[0]));
    structure_radius_[structure] = facet.radius;
    structure_is_sheet_[structure] = true;
  }
  for (const Cylinder& cylinder : cylinders) {
    structure_radius_[index_of(structure_of(cylinder.nodes[0]))] = cylinder.radius;
  }
}

Feature Surface::feature_of(CellId cell) const noexcept {
  const std::size_t i = index_of(cell);
  return i < face_count() ? Feature(id_at<FaceId>(i)) : Feature(free_edges_[i - face_count()]);
}

std::span<const NodeId> Surface::nodes_of(CellId cell) const noexcept {
  const std::size_t i = index_of(cell);
  if (i < face_count()) return face_nodes_[i];
  return edge_nodes_[index_of(free_edges_[i - face_count()])];
}

int Surface::euler_characteristic() const noexcept {
  const auto used = std::count_if(node_structure_.begin(), node_structure_.end(),
                                  [](StructureId s) { return s != StructureId{-1}; });
  return static_cast<int>(used) - static_cast<int>(edge_count()) + static_cast<int>(face_count());
}

}  // namespace plekton::geometry
