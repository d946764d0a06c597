// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/scene_figures.hpp"

#include "dynamics/state/rigid_nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plekton::dynamics {
namespace {

template <class Elements>
double smallest_radius(const Elements& elements, double so_far) {
  for (const auto& element : elements) so_far = std::min(so_far, element.radius);
  return so_far;
}

double smallest_radius(const geometry::Elements& elements) {
  const double spheres = smallest_radius(elements.spheres, std::numeric_limits<double>::infinity());
  return smallest_radius(elements.facets, smallest_radius(elements.cylinders, spheres));
}

}  // namespace

double largest_radius(const geometry::Elements& elements) {
  double radius = 0.0;
  for (const auto& sphere : elements.spheres) radius = std::max(radius, sphere.radius);
  for (const auto& cylinder : elements.cylinders) radius = std::max(radius, cylinder.radius);
  for (const auto& facet : elements.facets) radius = std::max(radius, facet.radius);
  return radius > 0.0 ? radius : std::numeric_limits<double>::infinity();
}

std::vector<double> furthest_in_a_step(const Scene& scene, double largest) {
  std::vector<double> furthest(scene.state.size(), largest);
  for (const auto& sphere : scene.elements.spheres)
    furthest[index_of(sphere.nodes[0])] = sphere.radius;
  return furthest;
}

double thinnest_structure(const geometry::Elements& elements) {
  const double bars = smallest_radius(elements.cylinders, std::numeric_limits<double>::infinity());
  return smallest_radius(elements.facets, bars);
}

double pace_radius(const geometry::Elements& elements) {
  if (elements.spheres.empty()) return smallest_radius(elements);
  return smallest_radius(elements.spheres, std::numeric_limits<double>::infinity());
}

double chosen_skin(const Scene& scene, double asked) {
  if (asked > 0.0) return asked;
  const double radius = pace_radius(scene.elements);
  return std::isfinite(radius) ? 0.2 * radius : 1.0;
}

std::vector<double> node_radii(const Scene& scene, const geometry::Surface& surface) {
  std::vector<double> radii(scene.state.size(), 0.0);
  for (std::size_t n = 0; n < radii.size(); ++n) {
    const auto structure = surface.structure_of(geometry::id_at<NodeId>(n));
    if (structure != geometry::StructureId{-1}) radii[n] = surface.radius(structure);
  }
  for (const geometry::Sphere& sphere : scene.elements.spheres)
    radii[index_of(sphere.nodes[0])] = sphere.radius;
  return radii;
}

std::vector<bool> free_nodes(const Scene& scene) {
  std::vector<bool> is_free(scene.properties.size());
  for (std::size_t i = 0; i < is_free.size(); ++i)
    is_free[i] = !holds_translation(scene.properties.held[i]);
  for (const BodyServo& servo : scene.loads.body_servos)
    is_free[index_of(scene.rigid_bodies[servo.body].node)] = true;
  for (const RigidBody& body : scene.rigid_bodies) {
    for (const NodeId node : body.nodes) is_free[index_of(node)] = is_free[index_of(body.node)];
  }
  return is_free;
}

std::vector<double> contact_masses(const Scene& scene) {
  std::vector<double> masses = scene.properties.mass;
  for (std::size_t i = 0; i < masses.size(); ++i)
    if (holds_translation(scene.properties.held[i]))
      masses[i] = std::numeric_limits<double>::infinity();
  for (const RigidBody& body : scene.rigid_bodies) {
    const std::size_t reference = index_of(body.node);
    const double mass = holds_translation(scene.properties.held[reference])
                            ? std::numeric_limits<double>::infinity()
                            : scene.properties.mass[reference];
    for (const NodeId node : body.nodes) masses[index_of(node)] = mass;
  }
  return masses;
}

geometry::ExclusionGroups rigid_groups(const Scene& scene) {
  if (scene.rigid_bodies.empty()) return {};
  return geometry::ExclusionGroups(
      RigidNodes(scene.rigid_bodies, scene.state, scene.properties).followed());
}

Held driven_axis(const BodyServo& servo) noexcept {
  constexpr std::array kAlong = {Held::along_x, Held::along_y, Held::along_z};
  constexpr std::array kAbout = {Held::about_x, Held::about_y, Held::about_z};
  return (servo.turns() ? kAbout : kAlong)[static_cast<std::size_t>(servo.axis)];
}

std::vector<Held> held_with_loads(const Scene& scene) {
  std::vector<Held> all = held_with_motions(scene.properties.held, scene.loads.motions);
  for (const BodyServo& servo : scene.loads.body_servos) {
    Held& held = all[index_of(scene.rigid_bodies[servo.body].node)];
    held = held | driven_axis(servo);
  }
  return all;
}

Scene held_as_prescribed(Scene scene) {
  scene.properties.held = held_with_loads(scene);
  return scene;
}

Scene to_compute_with(Scene scene) {
  scene = held_as_prescribed(std::move(scene));
  const auto shrink = [](auto&... lists) { (lists.shrink_to_fit(), ...); };
  shrink(scene.state.position, scene.state.velocity, scene.state.angular_velocity,
         scene.state.orientation, scene.properties.mass, scene.properties.inertia,
         scene.properties.held, scene.elements.spheres, scene.elements.cylinders,
         scene.elements.facets, scene.bonds, scene.sheet_facets, scene.sphere_materials,
         scene.cylinder_materials, scene.facet_materials);
  return scene;
}

double kinetic_energy(const NodeState& state, const NodeProperties& properties) {
  double energy = 0.0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Held held = properties.held[i];
    const Vec3 velocity = free_axes(held).cwiseProduct(state.velocity[i]);
    const Vec3 spin = free_turns(held).cwiseProduct(state.angular_velocity[i]);
    energy += 0.5 * properties.mass[i] * velocity.squaredNorm();
    if (!is_reference(held)) energy += 0.5 * properties.inertia[i] * spin.squaredNorm();
  }
  return energy;
}

Vec3 free_moment(const NodeState& state, const NodeProperties& properties, double before) {
  Vec3 moment = Vec3::Zero();
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Vec3 position = state.position[i] - before * state.velocity[i];
    moment += properties.mass[i] * free_axes(properties.held[i]).cwiseProduct(position);
  }
  return moment;
}

}  // namespace plekton::dynamics
