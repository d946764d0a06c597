// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/state_tree.hpp"
#include "geometry/base/types.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

/// A scene at one moment as the draft of the ON-DEM network tells it in a VTKHDF file, with what
/// Plekton adds. docs/reference/ondem.md has the layout of the file.
namespace plekton::dynamics {

/// Of the draft as it stood in October 2026, and of what Plekton adds; the latter grows whenever an
/// array changes its name or meaning.
constexpr std::string_view kOndemDraft = "2026-10-02";
constexpr std::int64_t kOndemAdditions = 1;

/// Does not apply.
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kNone = -1;

enum class OndemShape : std::uint8_t { sphere, clump, other };

struct OndemMaterial {
  std::int64_t id = 0;
  std::string label;
  double density = kNoNumber;           ///< kg/m³
  double normal_stiffness = kNoNumber;  ///< Pa, Young's modulus
  double shear_stiffness = kNoNumber;   ///< Pa
  double shear_friction = kNoNumber;    ///< tangent of the friction angle
  double poisson_ratio = kNoNumber;     ///< of the solid; ours
};

/// A sphere, or a rigid body that some spheres make up (a clump).
struct OndemBody {
  std::int64_t id = 0;
  std::size_t block = 0;  ///< among OndemScene::blocks
  OndemShape shape = OndemShape::sphere;
  std::int64_t material = kNone;                     ///< id
  std::int64_t clump = kNone;                        ///< of a member: id of the clump
  std::int64_t blocked_dofs = 0;                     ///< bits 0 to 2 translations, 3 to 5 rotations
  double radius = kNoNumber;                         ///< m
  double mass = kNoNumber;                           ///< kg
  double volume = kNoNumber;                         ///< m³
  geometry::Vec3 position = geometry::Vec3::Zero();  ///< m
  geometry::Vec3 velocity = geometry::Vec3::Zero();  ///< m/s
  geometry::Vec3 angular_velocity = geometry::Vec3::Zero();  ///< rad/s, axes of the world
  geometry::Quat orientation = geometry::Quat::Identity();   ///< from the body's frame to the world
  geometry::Vec3 moments = geometry::Vec3::Constant(kNoNumber);  ///< kg m², in the body's frame
  geometry::Vec3 place_in_clump = geometry::Vec3::Constant(kNoNumber);  ///< m, in its frame
  std::array<double, 4> turn_in_clump{kNoNumber, kNoNumber, kNoNumber, kNoNumber};  ///< w, x, y, z
};

/// A contact of two bodies that are in the file.
struct OndemContact {
  std::int64_t id1 = 0, id2 = 0;
  geometry::Vec3 normal = geometry::Vec3::Zero();       ///< unit, from 1 to 2
  double normal_force = 0.0;                            ///< N, positive in traction
  geometry::Vec3 shear_force = geometry::Vec3::Zero();  ///< N, on 2
  geometry::Vec3 point = geometry::Vec3::Zero();        ///< m
  double overlap = 0.0;                                 ///< m, negative: a gap
  double normal_stiffness = kNoNumber;                  ///< N/m, at this overlap
  double shear_stiffness = kNoNumber;                   ///< N/m
};

/// A deformable structure, or the surface of a rigid body: ours.
struct OndemMembrane {
  std::string name;
  std::int64_t material = kNone;  ///< id
  std::int64_t first_node = 0;    ///< of the run
  bool is_rigid = false;
  std::vector<geometry::Vec3> position;          ///< m, of its nodes
  std::vector<geometry::Vec3> velocity;          ///< m/s
  std::vector<geometry::Vec3> angular_velocity;  ///< rad/s
  std::vector<geometry::Quat> orientation;
  std::vector<double> mass;  ///< kg; 0 where the mass is that of a rigid body
  std::vector<std::int64_t> blocked_dofs;
  std::vector<std::array<std::int64_t, 3>> facets;     ///< nodes of it, of those that are left
  std::vector<double> facet_radius;                    ///< m, half the thickness
  std::vector<std::array<std::int64_t, 2>> cylinders;  ///< likewise, also along sides of facets
  std::vector<double> cylinder_radius;                 ///< m
};

/// A rigid plane: ours.
struct OndemPlane {
  std::string name;
  geometry::Vec3 point = geometry::Vec3::Zero();     ///< m
  geometry::Vec3 normal = geometry::Vec3::UnitZ();   ///< contact::Plane::direction()
  geometry::Vec3 velocity = geometry::Vec3::Zero();  ///< m/s
  std::int64_t material = kNone;
  double radius = 0.0;  ///< m, of the inside of a cylinder or sphere; 0: flat
  geometry::Vec3 angular_velocity = geometry::Vec3::Zero();  ///< rad/s, about the point
};

/// Numbers of all contacts of a run, by the name of the field: ours.
struct OndemField {
  std::string name;
  std::string unit;
  geometry::StateArray numbers;  ///< a row for each contact, of double or 64-bit integers
};

struct OndemScene {
  double time = 0.0;       ///< s
  double time_step = 0.0;  ///< s
  std::int64_t iteration = 0;
  geometry::Vec3 gravity = geometry::Vec3::Zero();  ///< m/s²
  std::vector<std::string> blocks;                  ///< display groups
  std::vector<OndemMaterial> materials;
  std::vector<OndemBody> bodies;
  std::vector<OndemContact> contacts;  ///< between spheres

  // What Plekton adds.
  bool has_additions = false;
  std::string writer;          ///< the program and its version
  double velocity_time = 0.0;  ///< s, to which the velocities belong
  std::vector<OndemMembrane> membranes;
  std::vector<OndemPlane> planes;
  std::vector<std::array<geometry::Vec3, 2>> contact_lines;  ///< m, core points, to be seen
  std::vector<OndemField> contact_fields;
  geometry::StateTree state;  ///< as in a checkpoint, with the histories of all contacts
};

}  // namespace plekton::dynamics
