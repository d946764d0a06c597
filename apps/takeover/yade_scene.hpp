// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

/// What a script of YADE has made, as apps/takeover/export_scene.py tells it. SI units.
namespace plekton::apps::yade {

using geometry::Vec3;

/// Attributes that a type of YADE's materials does not have keep what is here.
struct Material {
  std::string type{};   ///< YADE's class
  std::string label{};  ///< may be empty
  double young = 0.0;
  double poisson = 0.0;  ///< of the laws after Cundall the ratio of stiffnesses
  double friction_angle = 0.0;
  bool is_cohesive = false;
  double normal_cohesion = 0.0;
  double shear_cohesion = 0.0;
  bool rolls = false;
  double rolling_stiffness = 0.0;
  double twisting_stiffness = 0.0;
  double rolling_limit = -1.0;   ///< below 0: none
  double twisting_limit = -1.0;  ///< likewise
};

/// What all bodies have.
struct Body {
  int id = 0;
  int material = -1;  ///< among the materials; -1: none
  Vec3 position = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  Vec3 angular_velocity = Vec3::Zero();
  std::string blocked;  ///< of "xyzXYZ": axes along and about which nothing moves it
  double mass = 0.0;
};

struct Sphere : Body {
  double radius = 0.0;
};

struct GridNode : Body {
  double radius = 0.0;
  double inertia = 0.0;
};

struct GridConnection : Body {
  double radius = 0.0;
  std::array<int, 2> nodes{};  ///< ids
};

struct PFacet : Body {
  double radius = 0.0;
  std::array<int, 3> nodes{};  ///< ids
};

struct Wall : Body {
  int axis = 0;   ///< of its normal
  int sense = 0;  ///< side on which it acts: 1, -1, or 0 for both
};

/// A Facet or a Box.
struct RigidFacets : Body {
  std::vector<Vec3> points;
  std::vector<std::array<std::size_t, 3>> facets;
  bool is_box = false;  ///< closed
};

/// Of spheres.
struct Clump : Body {
  std::vector<Vec3> centres;
  std::vector<double> radii;
  Vec3 inertia = Vec3::Zero();  ///< principal
  std::array<Vec3, 3> axes;     ///< their directions
};

/// A beam between grid nodes.
struct Bond {
  std::array<int, 2> nodes{};  ///< ids
  double normal_stiffness = 0.0;
  double bending_stiffness = 0.0;   ///< N m
  double twisting_stiffness = 0.0;  ///< N m
  double rest_length = 0.0;
  double force = 0.0;  ///< along it
  bool is_broken = false;
  bool is_fragile = true;
  double adhesion = 0.0;  ///< N, at which it breaks or yields
};

struct PermanentForce {
  int id = 0;
  Vec3 force = Vec3::Zero();
  Vec3 torque = Vec3::Zero();
};

struct Scene {
  long iteration = 0;
  double time = 0.0;
  double time_step = 0.0;
  std::string stepper;  ///< class of what chooses the step, or empty
  bool is_periodic = false;
  Vec3 gravity = Vec3::Zero();
  double damping = 0.0;
  bool damps_gravity = true;
  std::vector<std::string> engines;
  std::vector<std::string> functors;  ///< of interactions, and flags that are set of these
  std::map<std::string, std::vector<std::string>>
      functor_settings;  ///< by functor, attributes that are set of it and have no counterpart
  std::vector<Material> materials;
  std::vector<Sphere> spheres;
  std::vector<GridNode> nodes;
  std::vector<GridConnection> connections;
  std::vector<PFacet> pfacets;
  std::vector<Wall> walls;
  std::vector<RigidFacets> facets;
  std::vector<Clump> clumps;
  std::vector<Bond> bonds;
  std::vector<PermanentForce> forces;
  std::map<std::string, int> others;  ///< bodies of other shapes, by YADE's class
  int contacts = 0;                   ///< that are real, beside the bonds
};

/// Whether the interaction loop has a functor, or one has this flag set.
bool has_functor(const Scene& scene, std::string_view name);

/// @throws InputError if it is not what the exporter writes
Scene parse_scene(std::string_view json);

}  // namespace plekton::apps::yade
