// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/ondem/ondem_scene.hpp"

#include <limits>

namespace plekton::test {

/// A scene with something of everything, with numbers that only all bits tell apart.
inline dynamics::OndemScene ondem_scene() {
  using geometry::Quat;
  using geometry::Vec3;
  dynamics::OndemScene scene;
  scene.time = 0.1 + 0.2;
  scene.time_step = 1.0 / 3.0;
  scene.iteration = 1'000'000'007;
  scene.gravity = {0.0, -0.0, -9.81};
  scene.blocks = {"sand", "empty", "pairs"};
  for (std::int64_t id = 0; id < 11; ++id)
    scene.materials.push_back(
        {id, "material " + std::to_string(id), 2650.0, 1e7 / 3.0, 3e6, 0.7, 0.2});
  dynamics::OndemBody sphere;
  sphere.id = 7;
  sphere.material = 10;
  sphere.blocked_dofs = 63;
  sphere.radius = 0.01 / 3.0;
  sphere.mass = 1e-3 / 7.0;
  sphere.volume = 1e-7 / 7.0;
  sphere.position = {1.0 / 3.0, 5e-324, -0.0};
  sphere.velocity = {1e300, -1e-300, 0.1};
  sphere.angular_velocity = {0.1, 0.2, 0.3};
  sphere.orientation = Quat(0.5, -0.5, 0.5, -0.5);
  sphere.moments = Vec3::Constant(1e-9);
  scene.bodies.push_back(sphere);
  dynamics::OndemBody member = sphere;
  member.id = 8;
  member.block = 2;
  member.clump = 9;
  member.mass = dynamics::kNoNumber;
  member.moments = Vec3::Constant(dynamics::kNoNumber);
  member.place_in_clump = {0.1, 0.0, 0.0};
  member.turn_in_clump = {1.0, 0.0, 0.0, 0.0};
  scene.bodies.push_back(member);
  dynamics::OndemBody clump;
  clump.id = 9;
  clump.block = 2;
  clump.shape = dynamics::OndemShape::clump;
  clump.mass = 2.0;
  clump.moments = {1.0, 2.0, 3.0};
  scene.bodies.push_back(clump);
  scene.contacts.push_back(
      {7, 8, Vec3::UnitX(), -0.1, {0.0, 0.3, 0.0}, {0.5, 0.5, 0.5}, 1e-6, 1e5});
  scene.has_additions = true;
  scene.writer = "Plekton of a test";
  scene.velocity_time = 0.3 - 1e-5;
  dynamics::OndemMembrane net;
  net.name = "net";
  net.material = 0;
  net.first_node = 3;
  net.position = {Vec3::Zero(), Vec3::UnitX() / 3.0, Vec3::UnitY(), Vec3(1.0, 1.0, 0.1)};
  net.velocity = net.angular_velocity = net.position;
  net.orientation.assign(4, Quat::Identity());
  net.mass = {0.1, 0.2, 0.3, 0.4};
  net.blocked_dofs = {63, 0, 0, 7};
  net.facets = {{0, 1, 2}};
  net.facet_radius = {0.001};
  net.cylinders = {{0, 1}, {2, 3}};
  net.cylinder_radius = {0.001, 0.002};
  scene.membranes.push_back(net);
  scene.planes.push_back(
      {"drum", {0.0, 0.0, -1.0}, Vec3::UnitZ(), Vec3::UnitX(), 1, 0.25, {0.0, 0.0, 3.0}});
  scene.contact_lines.push_back({Vec3::Zero(), Vec3::UnitX()});
  scene.contact_fields.push_back({"gap", "m", {std::vector<double>{-1e-6}, 1}});
  scene.contact_fields.push_back({"normal", "", {std::vector<double>{1.0, 0.0, 0.0}, 3}});
  scene.contact_fields.push_back({"id", "", {std::vector<std::int64_t>{5}, 1}});
  scene.state.arrays["time"] = {std::vector<double>{0.1 + 0.2}, 1};
  scene.state.arrays["contacts/spheres/slip"] = {
      std::vector<double>{0.1, std::numeric_limits<double>::quiet_NaN(), -0.0}, 3};
  scene.state.arrays["contacts/spheres/keys/pair"] = {std::vector<std::int32_t>{0, 1}, 2};
  scene.state.arrays["run/text"] = {std::vector<std::uint8_t>{0, 255}, 1};
  return scene;
}

}  // namespace plekton::test
