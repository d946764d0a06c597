// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/takeover/yade_scene.hpp"

#include "apps/scenario/problems.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace plekton::apps::yade {
namespace {

using nlohmann::json;

Vec3 vector_of(const json& value) {
  const auto numbers = value.get<std::array<double, 3>>();
  return {numbers[0], numbers[1], numbers[2]};
}

Material material_of(const json& row) {
  Material material;
  material.type = row.at("type").get<std::string>();
  material.label = row.at("label").get<std::string>();
  for (const auto& [key, number] : {std::pair{"young", &material.young},
                                    {"poisson", &material.poisson},
                                    {"friction_angle", &material.friction_angle},
                                    {"normal_cohesion", &material.normal_cohesion},
                                    {"shear_cohesion", &material.shear_cohesion},
                                    {"rolling_stiffness", &material.rolling_stiffness},
                                    {"twisting_stiffness", &material.twisting_stiffness},
                                    {"rolling_limit", &material.rolling_limit},
                                    {"twisting_limit", &material.twisting_limit}})
    *number = row.value(key, *number);
  material.is_cohesive = row.value("is_cohesive", false);
  material.rolls = row.value("rolls", false);
  return material;
}

/// A body of any kind, with what all have.
template <class Kind>
Kind body_of(const json& row) {
  Kind body;
  body.id = row.at("id").get<int>();
  body.material = row.at("material").get<int>();
  body.position = vector_of(row.at("x"));
  body.velocity = vector_of(row.at("v"));
  body.angular_velocity = vector_of(row.at("w"));
  body.blocked = row.at("blocked").get<std::string>();
  body.mass = row.at("mass").get<double>();
  if constexpr (requires { body.radius; }) body.radius = row.at("r").get<double>();
  if constexpr (requires { body.nodes; }) row.at("nodes").get_to(body.nodes);
  return body;
}

template <class Kind>
std::vector<Kind> bodies_of(const json& rows) {
  std::vector<Kind> bodies;
  for (const json& row : rows) bodies.push_back(body_of<Kind>(row));
  return bodies;
}

RigidFacets facets_of(const json& row) {
  auto body = body_of<RigidFacets>(row);
  for (const json& point : row.at("points")) body.points.push_back(vector_of(point));
  row.at("facets").get_to(body.facets);
  body.is_box = row.contains("half");
  return body;
}

Clump clump_of(const json& row) {
  auto clump = body_of<Clump>(row);
  for (const json& sphere : row.at("spheres")) {
    clump.centres.push_back(vector_of(sphere.at("x")));
    clump.radii.push_back(sphere.at("r").get<double>());
  }
  clump.inertia = vector_of(row.at("inertia"));
  for (std::size_t i = 0; i < 3; ++i) clump.axes[i] = vector_of(row.at("axes").at(i));
  return clump;
}

Bond bond_of(const json& row) {
  Bond bond;
  row.at("nodes").get_to(bond.nodes);
  row.at("kn").get_to(bond.normal_stiffness);
  row.at("kr").get_to(bond.bending_stiffness);
  row.at("ktw").get_to(bond.twisting_stiffness);
  row.at("rest_length").get_to(bond.rest_length);
  row.at("force").get_to(bond.force);
  row.at("broken").get_to(bond.is_broken);
  row.at("fragile").get_to(bond.is_fragile);
  row.at("normal_adhesion").get_to(bond.adhesion);
  return bond;
}

Scene scene_of(const json& told) {
  Scene scene;
  told.at("iteration").get_to(scene.iteration);
  told.at("time").get_to(scene.time);
  told.at("dt").get_to(scene.time_step);
  told.at("stepper").get_to(scene.stepper);
  told.at("periodic").get_to(scene.is_periodic);
  scene.gravity = vector_of(told.at("gravity"));
  told.at("damping").get_to(scene.damping);
  told.at("damp_gravity").get_to(scene.damps_gravity);
  told.at("engines").get_to(scene.engines);
  told.at("functors").get_to(scene.functors);
  // Scenes that were recorded before have none.
  scene.functor_settings = told.value("functor_settings", scene.functor_settings);
  for (const json& row : told.at("materials")) scene.materials.push_back(material_of(row));
  scene.spheres = bodies_of<Sphere>(told.at("spheres"));
  scene.nodes = bodies_of<GridNode>(told.at("nodes"));
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    told.at("nodes")[i].at("inertia").get_to(scene.nodes[i].inertia);
  scene.connections = bodies_of<GridConnection>(told.at("connections"));
  scene.pfacets = bodies_of<PFacet>(told.at("pfacets"));
  scene.walls = bodies_of<Wall>(told.at("walls"));
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    told.at("walls")[i].at("axis").get_to(scene.walls[i].axis);
    told.at("walls")[i].at("sense").get_to(scene.walls[i].sense);
  }
  for (const json& row : told.at("facets")) scene.facets.push_back(facets_of(row));
  for (const json& row : told.at("clumps")) scene.clumps.push_back(clump_of(row));
  for (const json& row : told.at("bonds")) scene.bonds.push_back(bond_of(row));
  for (const json& row : told.at("forces"))
    scene.forces.push_back(
        {row.at("id").get<int>(), vector_of(row.at("force")), vector_of(row.at("torque"))});
  told.at("others").get_to(scene.others);
  told.at("contacts").get_to(scene.contacts);
  return scene;
}

}  // namespace

bool has_functor(const Scene& scene, std::string_view name) {
  return std::ranges::find(scene.functors, name) != scene.functors.end();
}

Scene parse_scene(std::string_view text) {
  try {
    return scene_of(json::parse(text));
  } catch (const json::exception& error) {
    throw InputError(
        fmt::format("import-yade: what YADE has written of the scene cannot be read "
                    "({}); is it YADE 2023 or later?",
                    error.what()));
  }
}

}  // namespace plekton::apps::yade
