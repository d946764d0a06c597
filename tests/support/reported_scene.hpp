// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/models.hpp"
#include "tests/support/loaded_scene.hpp"
#include "tests/support/named_laws.hpp"
#include "tests/support/seeded_random.hpp"

#include <array>

/// A scene with contacts of every kind, to be read out under any law.
namespace plekton::test {

/// A sheet whose rim is held; a patch of another sheet on it; spheres on both, on each other and
/// against a wall; a plate that presses on the sheet from below. All touch at the start.
struct ReportedScene {
  static constexpr double kRadius = 0.02;      ///< m, of the spheres
  static constexpr double kOverlap = 1e-4;     ///< m
  static constexpr double kThickness = 0.004;  ///< m, of the sheets

  Scene scene;
  std::vector<NodeId> rim;

  ReportedScene() {
    scene.materials = {contact::Material{1e7, 0.5, 0.3}};
    add_membrane(scene, geometry::plane_sheet({0.4, 0.4, 8, 8}));
    hold_rim();
    geometry::Mesh patch = geometry::plane_sheet({0.11, 0.13, 2, 3});
    for (Vec3& point : patch.points) point += Vec3(-0.061, 0.052, kThickness - kOverlap);
    add_membrane(scene, patch);
    scene.planes = {{Vec3(0.19, 0, 0), Vec3(-1, 0, 0), Vec3::Zero(), contact::MaterialId{0}},
                    {Vec3(0, 0, -0.5 * kThickness + 0.2 * kOverlap), Vec3(0, 0, 1), Vec3(0, 0, 0.1),
                     contact::MaterialId{0}}};
    add_spheres();
  }

  dynamics::Simulation simulation(const NamedLaw& law, int threads = 1) const {
    dynamics::SimulationOptions options;
    options.time_step = 2e-6;
    options.motion.gravity = Vec3(0, 0, -9.81);
    options.threads = threads;
    return {scene, options,
            contact::any_law({{{contact::MaterialId{0}, contact::MaterialId{0}}, law.properties}})};
  }

 private:
  void hold_rim() {
    for (std::size_t i = 0; i < scene.state.size(); ++i) {
      const Vec3& x = scene.state.position[i];
      if (std::max(std::abs(x[0]), std::abs(x[1])) < 0.1999) continue;
      scene.properties.held[i] = dynamics::Held::translation;
      rim.push_back(geometry::id_at<NodeId>(i));
    }
  }

  void add_spheres() {
    const double on_sheet = kRadius + 0.5 * kThickness - kOverlap;
    const double on_patch = on_sheet + kThickness - kOverlap;
    const double beside = 2.0 * kRadius - kOverlap;
    const std::array<Vec3, 6> centres = {Vec3(0.19 - kRadius + kOverlap, 0.013, on_sheet),
                                         Vec3(0.19 - kRadius + kOverlap - beside, 0.013, on_sheet),
                                         Vec3(0.05, -0.1, on_sheet),
                                         Vec3(0.05, -0.1 + beside, on_sheet),
                                         Vec3(-0.07, 0.05, on_patch),
                                         Vec3(-0.07, 0.05 + beside, on_patch)};
    Random random(3);
    for (const Vec3& centre : centres) {
      scene.add_sphere(centre, kRadius, 2650.0, contact::MaterialId{0});
      scene.state.velocity.back() = random.in_cube(0.3);
      scene.state.angular_velocity.back() = random.in_cube(10.0);
    }
  }
};

}  // namespace plekton::test
