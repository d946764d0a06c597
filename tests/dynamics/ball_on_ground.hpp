// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/simulation.hpp"

/// A ball, node 0, that meets or leaves a ground with its top at z = 0, without gravity.
namespace plekton::dynamics::ball_on_ground {

inline constexpr contact::MaterialId kMaterial{0};
inline constexpr double kRadius = 0.01;     // m
inline constexpr double kDensity = 2000.0;  // kg/m3

/// A ball above z = 0 by a gap (m) that moves up at a speed (m/s).
inline void add_ball(Scene& scene, double gap, double speed) {
  scene.add_sphere(Vec3(0, 0, kRadius + gap), kRadius, kDensity, kMaterial);
  scene.state.velocity.back() = Vec3(0, 0, speed);
}

inline void lay_plane(Scene& scene) {
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), kMaterial});
}
inline void lay_facet(Scene& scene) {
  constexpr double kHalf = 0.001;  // m, half of the thickness
  const auto node = [&](double x, double y) {
    return scene.add_node(Vec3(x, y, -kHalf), Held::everything);
  };
  scene.add_facet(node(-1, -1), node(1, -1), node(0, 1), kHalf, kMaterial);
}
/// Another ball, which moves against the first.
inline void lay_ball(Scene& scene) {
  scene.add_sphere(Vec3(0, 0, -kRadius), kRadius, kDensity, kMaterial);
  scene.state.velocity.back() = -scene.state.velocity.front();
}

}  // namespace plekton::dynamics::ball_on_ground
