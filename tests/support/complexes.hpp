// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/elements.hpp"
#include "tests/support/seeded_random.hpp"

#include <array>
#include <map>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

/// Small surfaces for tests: closed, open, non-manifold, mixed, random. Radius 0.1 m everywhere.
namespace plekton::test {

using namespace plekton::geometry;

struct Complex {
  std::vector<Cylinder> cylinders;
  std::vector<Facet> facets;
  std::vector<Vec3> x;

  int node(const Vec3& position) {
    x.push_back(position);
    return static_cast<int>(x.size()) - 1;
  }
  void facet(int a, int b, int c) { facets.push_back({{NodeId{a}, NodeId{b}, NodeId{c}}, 0.1}); }
  void cylinder(int a, int b) { cylinders.push_back({{NodeId{a}, NodeId{b}}, 0.1}); }
  Surface surface() const { return Surface(cylinders, facets, x.size()); }
};

/// Every node, edge and face.
inline std::vector<Feature> features_of(const Surface& surface) {
  std::vector<Feature> all;
  for (std::size_t n = 0; n < surface.node_count(); ++n) {
    if (!surface.edges_of(id_at<NodeId>(n)).empty()) all.push_back(Feature(id_at<NodeId>(n)));
  }
  for (std::size_t e = 0; e < surface.edge_count(); ++e) all.push_back(Feature(id_at<EdgeId>(e)));
  for (std::size_t f = 0; f < surface.face_count(); ++f) all.push_back(Feature(id_at<FaceId>(f)));
  return all;
}

/// Nodes of a feature, in the order of the surface.
inline std::vector<NodeId> nodes_of(const Surface& surface, Feature feature) {
  if (feature.kind == FeatureKind::node) return {NodeId{feature.id}};
  if (feature.kind == FeatureKind::edge) {
    const auto& n = surface.nodes_of(EdgeId{feature.id});
    return {n.begin(), n.end()};
  }
  const auto& n = surface.nodes_of(FaceId{feature.id});
  return {n.begin(), n.end()};
}

inline Complex rotated(Complex complex, const Mat3& turn) {
  for (Vec3& x : complex.x) x = turn * x;
  return complex;
}

/// Surface of the cube [0, n]³, each unit square in two facets.
inline Complex cube(int n) {
  Complex result;
  std::map<std::tuple<int, int, int>, int> ids;
  const auto at = [&](std::array<int, 3> p) {
    const auto [entry, is_new] =
        ids.try_emplace({p[0], p[1], p[2]}, static_cast<int>(result.x.size()));
    if (is_new) result.node(Vec3(p[0], p[1], p[2]));
    return entry->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int level : {0, n}) {
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> p{};
            p[axis] = level;
            p[(axis + 1) % 3] = i + di;
            p[(axis + 2) % 3] = j + dj;
            return at(p);
          };
          result.facet(corner(0, 0), corner(1, 0), corner(1, 1));
          result.facet(corner(0, 0), corner(1, 1), corner(0, 1));
        }
      }
    }
  }
  return result;
}

/// Octahedron, its facets split into four this many times, all nodes at distance 1 from the origin.
inline Complex ball(int splits) {
  Complex result;
  for (const Vec3& x : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1),
                        Vec3(0, 0, -1)}) {
    result.node(x);
  }
  for (int k = 0; k < 4; ++k) {
    result.facet(k, (k + 1) % 4, 4);
    result.facet((k + 1) % 4, k, 5);
  }
  for (int split = 0; split < splits; ++split) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](NodeId a, NodeId b) {
      const int low = static_cast<int>(std::min(a, b));
      const int high = static_cast<int>(std::max(a, b));
      const auto [entry, is_new] =
          middles.try_emplace({low, high}, static_cast<int>(result.x.size()));
      if (is_new) result.node((result.x[index_of(a)] + result.x[index_of(b)]).normalized());
      return entry->second;
    };
    for (const Facet& old : std::exchange(result.facets, {})) {
      const auto [a, b, c] = old.nodes;
      const int ab = middle(a, b);
      const int bc = middle(b, c);
      const int ca = middle(c, a);
      result.facet(static_cast<int>(a), ab, ca);
      result.facet(static_cast<int>(b), bc, ab);
      result.facet(static_cast<int>(c), ca, bc);
      result.facet(ab, bc, ca);
    }
  }
  return result;
}

/// Flat sheet [0, n]² in z = 0, each unit square in two facets.
inline Complex sheet(int n) {
  Complex result;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) result.node(Vec3(i, j, 0));
  }
  const auto at = [n](int i, int j) { return i * (n + 1) + j; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      result.facet(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      result.facet(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return result;
}

/// Square net of cylinders over [0, n]² in z = 0.
inline Complex net(int n) {
  Complex result;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) result.node(Vec3(i, j, 0));
  }
  const auto at = [n](int i, int j) { return i * (n + 1) + j; };
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j < n; ++j) {
      result.cylinder(at(i, j), at(i, j + 1));
      result.cylinder(at(j, i), at(j + 1, i));
    }
  }
  return result;
}

/// Facets on one common edge along z (nodes 0 and 1), their other corners at these angles (degrees)
/// about it.
inline Complex book(const std::vector<double>& angles) {
  Complex result;
  result.node(Vec3(0, 0, -1));
  result.node(Vec3(0, 0, 1));
  for (const double angle : angles) {
    const double radians = angle * std::numbers::pi / 180.0;
    result.facet(0, 1, result.node(Vec3(std::cos(radians), std::sin(radians), 0)));
  }
  return result;
}

/// Two facets that share one node only, and a cylinder on that node.
inline Complex bow_tie() {
  Complex result;
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(2, 1, 0), Vec3(2, -1, 0), Vec3(-2, 1, 1),
                        Vec3(-2, -1, 1), Vec3(0, 1, 2)}) {
    result.node(x);
  }
  result.facet(0, 1, 2);
  result.facet(0, 3, 4);
  result.cylinder(0, 5);
  return result;
}

/// A few distinct nodes, on an integer lattice or anywhere, with random facets that have an area
/// and random cylinders: any number of facets on an edge, loose parts, nodes that nobody uses.
inline Complex random_complex(Random& random, bool on_lattice) {
  Complex result;
  const int node_count = random.integer(3, 9);
  std::set<std::tuple<double, double, double>> taken;
  while (static_cast<int>(result.x.size()) < node_count) {
    const Vec3 x = on_lattice ? random.on_lattice(0, 3) : Vec3(random.in_cube(2.0));
    if (taken.insert({x[0], x[1], x[2]}).second) result.node(x);
  }
  std::set<std::set<int>> used;
  for (int trial = random.integer(0, 2 * node_count); trial > 0; --trial) {
    const std::array<int, 3> n{random.integer(0, node_count - 1), random.integer(0, node_count - 1),
                               random.integer(0, node_count - 1)};
    const Vec3& x0 = result.x[static_cast<std::size_t>(n[0])];
    const Vec3 u = result.x[static_cast<std::size_t>(n[1])] - x0;
    const Vec3 v = result.x[static_cast<std::size_t>(n[2])] - x0;
    if (u.cross(v).isZero(0.0))
      continue;  // exact on the lattice; elsewhere only equal nodes come here
    if (used.insert({n[0], n[1], n[2]}).second) result.facet(n[0], n[1], n[2]);
  }
  for (int trial = random.integer(0, node_count); trial > 0; --trial) {
    const int a = random.integer(0, node_count - 1);
    const int b = random.integer(0, node_count - 1);
    if (a != b && used.insert({a, b}).second) result.cylinder(a, b);
  }
  return result;
}

/// As random_complex() on a small lattice, but with repeated positions and facets without area.
inline Complex random_degenerate_complex(Random& random) {
  Complex result;
  const int node_count = random.integer(3, 9);
  for (int n = 0; n < node_count; ++n) result.node(random.on_lattice(0, 2));
  std::set<std::set<int>> used;
  for (int trial = 2 * node_count; trial > 0; --trial) {
    const int a = random.integer(0, node_count - 1);
    const int b = random.integer(0, node_count - 1);
    const int c = random.integer(0, node_count - 1);
    const std::set<int> nodes{a, b, c};
    if (nodes.size() < 2 || !used.insert(nodes).second) continue;
    if (nodes.size() == 3) result.facet(a, b, c);
    if (nodes.size() == 2) result.cylinder(*nodes.begin(), *nodes.rbegin());
  }
  return result;
}

/// A point that is likely to be hard: on or over a feature, on the lattice, or anywhere near.
inline Vec3 random_point(Random& random, const Complex& complex) {
  const auto any_node = [&]() -> const Vec3& { return complex.x[random.index(complex.x.size())]; };
  switch (random.integer(0, 5)) {
    case 0:
      return random.on_lattice(-1, 5);
    case 1:
      return 0.5 * random.on_lattice(-2, 10);
    case 2:
      return any_node();
    case 3:
      return 0.5 * (any_node() + any_node());
    case 4: {
      const double t = random.unit();
      return (1.0 - t) * any_node() + t * any_node() +
             random.signed_power(-17.0, 0.0) * random.direction();
    }
    default:
      return any_node() + random.in_cube(2.0);
  }
}

}  // namespace plekton::test
