// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/takeover/yade_scene.hpp"

#include <numbers>

namespace plekton::apps::yade {

constexpr double kGridRadius = 0.01;
constexpr double kGridModulus = 1e8;

/// The stiffnesses that YADE gives a beam between grid nodes: those of a round bar.
inline Bond bond_between(const Scene& scene, std::size_t a, std::size_t b) {
  const double r = kGridRadius, area = std::numbers::pi * r * r, moment = 0.25 * area * r * r;
  const double length = (scene.nodes[b].position - scene.nodes[a].position).norm();
  Bond bond;
  bond.nodes = {scene.nodes[a].id, scene.nodes[b].id};
  bond.rest_length = length;
  bond.normal_stiffness = kGridModulus * area / length;
  bond.bending_stiffness = kGridModulus * moment / length;
  bond.twisting_stiffness = kGridModulus / 2.6 * 2.0 * moment / length;  // Poisson's ratio 0.3
  bond.adhesion = 1e100;
  return bond;
}

/// A connection with its beam, whose halves weigh down its ends (1000 kg/m³).
inline void connect(Scene& scene, std::size_t a, std::size_t b) {
  GridConnection connection;
  connection.id = static_cast<int>(100 + scene.connections.size());
  connection.material = 0;
  connection.radius = kGridRadius;
  connection.nodes = {scene.nodes[a].id, scene.nodes[b].id};
  scene.connections.push_back(connection);
  scene.bonds.push_back(bond_between(scene, a, b));
  for (const std::size_t node : {a, b}) {
    GridNode& told = scene.nodes[node];
    told.mass +=
        500.0 * std::numbers::pi * kGridRadius * kGridRadius * scene.bonds.back().rest_length;
    told.inertia = 0.4 * told.mass * kGridRadius * kGridRadius;
  }
}

/// A square with one PFacet, one open corner and a tail, and beside it a bar of its own: ids begin at 10.
inline Scene grid_scene() {
  Scene scene;
  scene.time_step = 1e-6;
  scene.gravity = {0.0, 0.0, -9.81};
  scene.functors = {"Ig2_GridNode_GridNode_GridNodeGeom6D",
                    "Law2_ScGeom6D_CohFrictPhys_CohesionMoment"};
  scene.materials.push_back(
      {.type = "FrictMat", .label = "cloth", .young = 1e7, .poisson = 0.4, .friction_angle = 0.5});
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(2, 1, 0),
                        Vec3(5, 0, 0), Vec3(6, 0, 0)}) {
    GridNode node;
    node.id = static_cast<int>(10 + scene.nodes.size());
    node.position = x;
    node.radius = kGridRadius;
    scene.nodes.push_back(node);
  }
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 0}, {2, 4}, {5, 6}})
    connect(scene, static_cast<std::size_t>(a), static_cast<std::size_t>(b));
  PFacet facet;
  facet.id = 200;
  facet.material = 0;
  facet.radius = kGridRadius;
  facet.nodes = {10, 11, 12};
  scene.pfacets.push_back(facet);
  return scene;
}

}  // namespace plekton::apps::yade
