// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/shape_check.hpp"

#include "geometry/base/predicates.hpp"

#include <algorithm>
#include <array>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::dynamics {
namespace {

/// Whether all nodes exist.
template <std::size_t N>
bool exist(const std::array<NodeId, N>& nodes, const Scene& scene) {
  return std::all_of(nodes.begin(), nodes.end(), [&](NodeId node) {
    return static_cast<std::int32_t>(node) >= 0 && index_of(node) < scene.state.size();
  });
}

/// Whether all nodes are where exact signs are defined.
template <std::size_t N>
bool have_places(const std::array<NodeId, N>& nodes, const Scene& scene) {
  constexpr double kLargestCoordinate = 1e75;  // of geometry/base/predicates.hpp
  return std::all_of(nodes.begin(), nodes.end(), [&](NodeId node) {
    const Vec3& x = scene.state.position[index_of(node)];
    return x.allFinite() && x.cwiseAbs().maxCoeff() < kLargestCoordinate;
  });
}

/// "cylinder 3 (nodes 4, 5)"
template <std::size_t N>
void write_place(std::string_view kind, std::size_t id, const std::array<NodeId, N>& nodes,
                 std::ostream& problems) {
  problems << kind << ' ' << id << " (nodes ";
  for (std::size_t k = 0; k < N; ++k) {
    problems << (k == 0 ? "" : ", ") << static_cast<std::int32_t>(nodes[k]);
  }
  problems << ')';
}

void list_cylinders_without_length(const Scene& scene, std::ostream& problems) {
  const auto& x = scene.state.position;
  for (std::size_t i = 0; i < scene.elements.cylinders.size(); ++i) {
    const auto& nodes = scene.elements.cylinders[i].nodes;
    const auto [a, b] = nodes;
    if (!exist(nodes, scene) || !have_places(nodes, scene) || a == b) continue;
    if (x[index_of(a)] != x[index_of(b)]) continue;
    write_place("cylinder", i, nodes, problems);
    problems << ": it has no length: both ends are at (" << x[index_of(a)].transpose()
             << "); merge the nodes and delete the cylinder, or move one of them\n";
  }
}

void list_facets_without_area(const Scene& scene, std::ostream& problems) {
  const auto& x = scene.state.position;
  for (std::size_t i = 0; i < scene.elements.facets.size(); ++i) {
    const auto& nodes = scene.elements.facets[i].nodes;
    const auto [a, b, c] = nodes;
    if (!exist(nodes, scene) || !have_places(nodes, scene)) continue;
    if (a == b || b == c || c == a) continue;
    const Vec3& opposite = x[index_of(c)];
    // The sign of |(b - a) x (c - a)|².
    if (geometry::sign_inside_edge(x[index_of(a)], x[index_of(b)], opposite, opposite) > 0)
      continue;
    write_place("facet", i, nodes, problems);
    problems << ": it has no area: its corners (" << x[index_of(a)].transpose() << "), ("
             << x[index_of(b)].transpose() << "), (" << opposite.transpose()
             << ") are on one line; move one of them or delete the facet\n";
  }
}

/// Writes down who holds a node first.
template <class Element>
void claim(std::string_view kind, const std::vector<Element>& elements, const Scene& scene,
           std::vector<std::string>& holders) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!exist(elements[i].nodes, scene)) continue;
    for (const NodeId node : elements[i].nodes) {
      std::string& holder = holders[index_of(node)];
      if (holder.empty()) holder = std::string(kind) + ' ' + std::to_string(i);
    }
  }
}

void list_shared_spheres(const Scene& scene, std::ostream& problems) {
  std::vector<std::string> holders(scene.state.size());
  claim("facet", scene.elements.facets, scene, holders);
  claim("cylinder", scene.elements.cylinders, scene, holders);
  for (std::size_t i = 0; i < scene.elements.spheres.size(); ++i) {
    const auto& nodes = scene.elements.spheres[i].nodes;
    if (!exist(nodes, scene)) continue;
    std::string& holder = holders[index_of(nodes[0])];
    if (holder.empty()) {
      holder = "sphere " + std::to_string(i);
      continue;
    }
    problems
        << "sphere " << i << ": its node " << static_cast<std::int32_t>(nodes[0]) << " belongs to "
        << holder
        << " as well, and the two would push on each other for ever; give the sphere a node of "
           "its own\n";
  }
}

}  // namespace

void list_shape_problems(const Scene& scene, std::ostream& problems) {
  list_cylinders_without_length(scene, problems);
  list_facets_without_area(scene, problems);
  list_shared_spheres(scene, problems);
}

}  // namespace plekton::dynamics
