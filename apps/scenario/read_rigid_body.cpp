// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_rigid_body.hpp"

#include "apps/scenario/read_membrane_source.hpp"
#include "apps/scenario/read_placement.hpp"
#include "geometry/base/rotation_about.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace plekton::apps {
namespace {

using dynamics::Held;

constexpr Dimension kInertia{"a moment of inertia", {1, 2, 0, 0}, "kg m2", "kg m2, g cm2, t m2"};

/// Along or about which axes of the world the body is held.
Held read_axes(Section& section, std::string_view key, const std::array<Held, 3>& axes) {
  constexpr std::array<std::string_view, 8> kWords = {"none", "x",  "y",  "z",
                                                      "xy",   "xz", "yz", "xyz"};
  const std::string_view word = kWords[section.choice(key, kWords, 0)];
  Held held = Held::nothing;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (word.find("xyz"[axis]) != std::string_view::npos) held = held | axes[axis];
  }
  return held;
}

/// The spheres, before they are put in place: centre and radius of each.
struct Spheres {
  std::vector<Vec3> centres;  ///< m
  std::vector<double> radii;  ///< m
};

Spheres read_spheres(Section& section) {
  Spheres spheres;
  for (Section& row : section.tables("spheres")) {
    spheres.centres.push_back(row.vector("centre", {kLength}));
    spheres.radii.push_back(row.quantity("radius", {kLength, kPositive}));
    row.finish();
  }
  if (spheres.centres.empty())
    section.complain(
        "spheres",
        "got none; expected one or more, as [{ centre = [0, 0, 0], radius = \"1 cm\" }]");
  return spheres;
}

GrainSettings grains_of(const RigidBodySettings& body, Spheres spheres, const Placement& placement,
                        std::size_t material) {
  GrainSettings grains;
  grains.name = body.name;
  grains.place = body.place;
  grains.material = material;
  const geometry::Mat3 turn = geometry::rotation_about(placement.axis, placement.angle);
  for (Vec3& centre : spheres.centres)
    centre = turn * (placement.scale * centre) + placement.translation;
  for (double& radius : spheres.radii) radius *= placement.scale;
  grains.centres = std::move(spheres.centres);
  grains.radii = std::move(spheres.radii);
  return grains;
}

/// Complains about keys of a surface, where there are spheres.
void refuse_keys_of_surfaces(Section& section) {
  for (const std::string_view key : {"thickness", "filling"}) {
    if (section.has(key))
      section.complain(key, "goes with a mesh or shape; spheres have their radii, and are solid");
  }
}

void read_surface(Section& section, const Known& known, MembraneSettings& surface,
                  RigidBodySettings& body) {
  constexpr std::array<std::string_view, 2> kFillings = {"solid", "shell"};
  read_membrane_source(section, known, surface);
  section.tell_default("thickness", "required of a mesh or shape");
  surface.thickness = section.quantity("thickness", {kLength, kPositive});
  section.tell_default("filling", "solid where it is closed");
  if (section.has("filling") && surface.shape && is_net(*surface.shape))
    section.complain("filling", "goes with facets; bars are solid");
  if (section.has("filling"))
    body.filling =
        section.choice("filling", kFillings) == 0 ? RigidFilling::solid : RigidFilling::shell;
}

/// Of every body each principal moment is at most the sum of the other two: I_x + I_y - I_z is twice
/// the integral of z² over the mass.
bool is_possible(const Vec3& inertia) {
  constexpr double kDigits = 0.01;  // of a flat body, whose moments are equal to that sum, as typed
  return !(2.0 * inertia.maxCoeff() > (1.0 + kDigits) * inertia.sum());
}

void read_inertia(Section& section, RigidBodySettings& body) {
  const Vec3 inertia = section.vector("inertia", {kInertia, kPositive});
  body.inertia = inertia;
  if (is_possible(inertia)) return;
  const double largest = inertia.maxCoeff();
  section.complain(
      "inertia", fmt::format("got [{:.6g}, {:.6g}, {:.6g}] kg m2; expected none above the sum of "
                             "the other two, as of every body, and {:.6g} is above {:.6g}; check "
                             "units and order",
                             inertia[0], inertia[1], inertia[2], largest, inertia.sum() - largest));
}

void read_mass(Section& section, RigidBodySettings& body) {
  const bool has_density = section.has("density");
  const bool has_mass = section.has("mass");
  section.tell_default("density", "none where nothing of the body is free");
  section.tell_default("mass", "none");
  if (has_density && has_mass)
    section.complain("density", "got density and mass too; expected one of them");
  if (has_density) body.density = section.quantity("density", {kDensity, kPositive});
  if (has_mass) body.mass = section.quantity("mass", {kMass, kPositive});
  if (section.has("inertia")) {
    read_inertia(section, body);
    if (!has_mass) section.complain("inertia", "goes with mass; a density gives both");
  }
  if (section.has("centre")) body.centre = section.vector("centre", {kLength});
}

}  // namespace

void read_rigid_body(Section section, const Known& known, Scenario& scenario) {
  RigidBodySettings body;
  body.name = section.name("name");
  body.path = section.path();
  body.place = section.place();
  const bool has_spheres = section.has("spheres");
  MembraneSettings surface;
  Spheres spheres;
  if (has_spheres) {
    for (const std::string_view key : {"mesh", "shape"}) {
      if (section.has(key))
        section.complain(key, "the body is made of spheres already; leave one of them out");
    }
    refuse_keys_of_surfaces(section);
    spheres = read_spheres(section);
  } else {
    read_surface(section, known, surface, body);
  }
  const Placement placement = read_placement(section);
  const std::size_t material = read_material_of(section, known).value_or(0);
  body.held = read_axes(section, "hold", {Held::along_x, Held::along_y, Held::along_z}) |
              read_axes(section, "hold_rotation", {Held::about_x, Held::about_y, Held::about_z});
  read_mass(section, body);
  body.velocity = section.vector("velocity", {kVelocity}, body.velocity);
  body.angular_velocity =
      section.vector("angular_velocity", {kAngularVelocity}, body.angular_velocity);
  section.finish();

  if (has_spheres) {
    body.grains = scenario.grains.size();
    scenario.grains.push_back(grains_of(body, std::move(spheres), placement, material));
    scenario.grains.back().rigid_body = scenario.rigid_bodies.size();
  } else {
    body.membrane = scenario.membranes.size();
    surface.name = body.name;
    surface.placement = placement;
    surface.material = material;
    surface.rigid_body = scenario.rigid_bodies.size();
    scenario.membranes.push_back(std::move(surface));
  }
  scenario.rigid_bodies.push_back(std::move(body));
}

void require_own_names(Section& root, const Scenario& scenario) {
  for (const RigidBodySettings& body : scenario.rigid_bodies) {
    const auto takes_name = [&](const auto& other) {
      return other.name == body.name && !other.rigid_body;
    };
    const bool is_taken =
        std::any_of(scenario.membranes.begin(), scenario.membranes.end(), takes_name) ||
        std::any_of(scenario.grains.begin(), scenario.grains.end(), takes_name);
    if (is_taken)
      root.complain("rigid_bodies", fmt::format("\"{}\" is the name of a membrane or of grains "
                                                "too; give each body a name of its own",
                                                body.name));
  }
}

}  // namespace plekton::apps
