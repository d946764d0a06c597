// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"

#include <Eigen/Geometry>

#include <array>
#include <vector>

/// Bodies that fly freely: a ball, a chain of cylinders, a sheet, a tetrahedron, a closed shell.
namespace plekton::test::free_bodies {

using dynamics::Scene;
using geometry::NodeId;
using geometry::Vec3;

inline constexpr double kRadius = 0.02;
inline constexpr contact::MaterialId kMaterial{0};

struct Body {
  std::vector<Vec3> x;
  bool is_ball = false;  ///< of three radii, without beams and facets
  std::vector<std::array<std::size_t, 2>> beams;
  std::vector<std::array<std::size_t, 3>> facets;
};

inline Body chain() {
  Body body;
  for (int i = 0; i <= 4; ++i) body.x.emplace_back(0.15 * i - 0.3, 0.0, 0.0);
  for (std::size_t i = 0; i < 4; ++i) body.beams.push_back({i, i + 1});
  return body;
}

inline Body sheet() {
  Body body;
  constexpr std::size_t kSquares = 3;
  const auto node = [](std::size_t i, std::size_t j) { return j * (kSquares + 1) + i; };
  for (std::size_t j = 0; j <= kSquares; ++j) {
    for (std::size_t i = 0; i <= kSquares; ++i)
      body.x.emplace_back(0.15 * static_cast<double>(i) - 0.225,
                          0.15 * static_cast<double>(j) - 0.225, 0.0);
  }
  for (std::size_t j = 0; j < kSquares; ++j) {
    for (std::size_t i = 0; i < kSquares; ++i) {
      body.facets.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      body.facets.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
      body.beams.push_back({node(i, j), node(i + 1, j + 1)});
    }
  }
  for (std::size_t j = 0; j <= kSquares; ++j) {
    for (std::size_t i = 0; i < kSquares; ++i) {
      body.beams.push_back({node(i, j), node(i + 1, j)});
      body.beams.push_back({node(j, i), node(j, i + 1)});
    }
  }
  return body;
}

inline Body ball() {
  Body body;
  body.x = {Vec3::Zero()};
  body.is_ball = true;
  return body;
}

inline Body tetrahedron() {
  Body body;
  body.x = {Vec3(0, 0, 0), Vec3(0.3, 0, 0), Vec3(0.1, 0.3, 0), Vec3(0.12, 0.1, 0.25)};
  body.facets = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  body.beams = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  return body;
}

/// A closed shell: an octahedron.
inline Body shell() {
  Body body;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-0.2, 0.2}) body.x.push_back(side * Vec3::Unit(axis));
  }
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 2; j < 4; ++j) {
      for (std::size_t k = 4; k < 6; ++k) {
        const bool keeps = (i + j + k) % 2 == 1;
        body.facets.push_back(keeps ? std::array{i, j, k} : std::array{i, k, j});
      }
    }
  }
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = i + 1; j < 6; ++j) {
      if (i / 2 != j / 2) body.beams.push_back({i, j});
    }
  }
  return body;
}

/// Adds a body whose first node is at a place, turned, with a velocity.
inline void add(Scene& scene, const Body& body, const Vec3& turns, const Vec3& place,
                const Vec3& velocity) {
  const geometry::Mat3 rotation =
      (Eigen::AngleAxisd(turns.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(turns.y(), Vec3::UnitY()) *
       Eigen::AngleAxisd(turns.x(), Vec3::UnitX()))
          .toRotationMatrix();
  if (body.is_ball) {
    scene.add_sphere(place, 3.0 * kRadius, 1000.0, kMaterial);
    scene.state.velocity.back() = velocity;
    return;
  }
  std::vector<NodeId> nodes;
  for (const Vec3& x : body.x) {
    nodes.push_back(scene.add_node(rotation * x + place));
    scene.state.velocity.back() = velocity;
  }
  for (const auto& f : body.facets)
    scene.add_facet(nodes[f[0]], nodes[f[1]], nodes[f[2]], kRadius, kMaterial);
  for (const auto& b : body.beams) {
    scene.add_beam(nodes[b[0]], nodes[b[1]], dynamics::circular_section(kRadius, 1e7, 0.3), 1000.0);
    scene.add_cylinder(nodes[b[0]], nodes[b[1]], kRadius, kMaterial);
  }
}

}  // namespace plekton::test::free_bodies
