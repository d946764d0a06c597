// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/time_table.hpp"
#include "dynamics/state/node_state.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

/// What acts on a scene from outside, as plain data. Sets of nodes name every node once. A factor
/// multiplies what stands beside it, at the time of the simulation; 1 unless told. A load that has
/// begun in another scene (Simulation::go_on_from) is told how things stood then; its factor counts
/// from there (TimeTable::from).
namespace plekton::dynamics {

/// A turn about an axis that stays where it is.
struct AxisTurn {
  Vec3 point = Vec3::Zero();  ///< m, any of the axis
  Vec3 axis = Vec3::UnitZ();  ///< unit
  double angle = 0.0;         ///< rad, counterclockwise seen against the axis
};

/// Nodes that move as prescribed: by displacement factor(t), counted from the factor at time 0,
/// plus velocity times the integral of the factor, from where they are at the start. What is
/// prescribed is held, so forces do not change it; the other motions stay free. Rotations turn with
/// angular_velocity factor(t). Places are those of the tables to rounding after every step; a
/// displacement that has a corner makes the velocity jump. With a turn the nodes go round its axis
/// by angle (factor(t) - factor(0)), exactly on their circles, and turn with it where their
/// rotation is prescribed; a displacement or velocity comes after that.
struct PrescribedMotion {
  std::vector<NodeId> nodes = {};
  Held held = Held::translation;         ///< the motions that are prescribed
  Vec3 displacement = Vec3::Zero();      ///< m
  Vec3 velocity = Vec3::Zero();          ///< m/s
  Vec3 angular_velocity = Vec3::Zero();  ///< rad/s
  TimeTable factor = {};
  std::optional<AxisTurn> turn = std::nullopt;  ///< only where all of the translation is prescribed
  /// m, where the nodes were at the start of the factor; empty: where they are in the scene.
  std::vector<Vec3> start = {};
};

/// A plane that moves with velocity factor(t).
struct PlaneMotion {
  std::size_t plane = 0;
  Vec3 velocity = Vec3::Zero();  ///< m/s
  TimeTable factor = {};
  std::optional<Vec3> start = std::nullopt;  ///< m, its point then; nothing: that in the scene
};

/// A force and a torque on each of some nodes, times factor(t), in directions that stay.
struct NodalForce {
  std::vector<NodeId> nodes = {};
  Vec3 force = Vec3::Zero();   ///< N, on each node
  Vec3 torque = Vec3::Zero();  ///< N m, on each node
  TimeTable factor = {};
};

/// Springs from each of some nodes to the place where it is at the start.
struct GroundSprings {
  std::vector<NodeId> nodes = {};
  Vec3 stiffness = Vec3::Zero();  ///< N/m, >= 0, along the axes of the world, of each node
  /// m, the places to which they pull; empty: where the nodes are in the scene.
  std::vector<Vec3> start = {};
};

/// What a closed surface holds: p = (outside + pressure factor(t)) (V0 / V)^exponent - outside,
/// with V0 the volume at the start.
struct Gas {
  double outside_pressure = 101325.0;  ///< Pa, absolute, >= 0
  double exponent = 1.0;               ///< > 0; 1: the temperature stays; 1.4: no heat passes (air)
};

/// The pressure on a closed surface by the volume that it holds: straight lines between rows, the
/// ends stay.
struct PressureByVolume {
  std::vector<std::array<double, 2>> rows;  ///< m³, increasing, and Pa
};

/// A pressure on facets along their normals, as they are at any time: p A / 3 on each corner, the
/// area vector A by the order of the corners. On a closed surface that is the gradient of p V,
/// without any resultant force or moment. Facets that are torn are pressed no more; a gas escapes
/// with the first of them, and its pressure is over.
struct SurfacePressure {
  std::vector<geometry::FaceId> facets = {};
  double pressure = 0.0;                  ///< Pa, over the outside where the surface holds a gas
  TimeTable factor = {};                  ///< of the pressure
  std::optional<Gas> gas = std::nullopt;  ///< only where the facets are closed
  /// In place of the pressure and a gas, times factor(t); only where the facets are closed.
  std::optional<PressureByVolume> by_volume = std::nullopt;
  std::optional<double> start_volume = std::nullopt;  ///< m³, V0; nothing: that in the scene
};

/// Dashpots along beams: c = 2 ratio sqrt(EA/L0 m), with m the reduced mass of the two nodes (half
/// the mass of either if they are equal), that of the free node if one is held. At 1 a beam alone
/// between two free nodes is critically damped.
struct BeamDamping {
  std::vector<std::size_t> bonds = {};
  double ratio = 0.0;  ///< >= 0
};

/// Dashpots in the facets of sheets against being stretched, in proportion to their stiffness
/// (loads/damped_sheets.hpp). At 1 the fastest stretching of a facet alone between its nodes is
/// critically damped.
struct SheetDamping {
  std::vector<std::size_t> facets = {};  ///< by place in Scene::sheet_facets
  double ratio = 0.0;                    ///< >= 0
};

/// Forces -rate m v and torques -rate I w: drag in a medium at rest.
struct MassDamping {
  std::vector<NodeId> nodes = {};
  double rate = 0.0;  ///< 1/s, >= 0
};

/// A plate that is pressed on the bodies along its normal with (force + pressure area) factor(t);
/// how it finds its place stands in plane_servo.hpp. Its velocity across the normal stays. A
/// container is pressed all around, by its radius; the area of a cylinder between two planes is
/// then 2 pi radius times area times their distance, and nothing bounds a ball.
struct PlaneServo {
  std::size_t plane = 0;
  double force = 0.0;     ///< N, >= 0
  double pressure = 0.0;  ///< Pa, >= 0
  double area = 1.0;      ///< m², > 0; m or 1 where planes bound it
  /// Pairs of planes that face each other: the area is multiplied by the distance of each pair, as
  /// it is at any time.
  std::vector<std::array<std::size_t, 2>> between = {};
  TimeTable factor = {};
  double largest_speed = 0.0;  ///< m/s, > 0
  double gain = 0.1;           ///< above 0, at most 1
};

/// A rigid body that is pressed on the others along an axis of the world with (force + pressure
/// area) factor(t), as a plate is by PlaneServo; or that is turned about such an axis through its
/// centre, with torque factor(t). Its motion along or about that axis is prescribed then, and its
/// weight and other loads there are borne by the servo; the other motions stay free.
struct BodyServo {
  std::size_t body = 0;   ///< by place in Scene::rigid_bodies
  int axis = 2;           ///< 0 to 2: x, y, z
  double towards = -1.0;  ///< 1 or -1: along or about the axis, or against it
  double force = 0.0;     ///< N, >= 0
  double pressure = 0.0;  ///< Pa, >= 0
  double torque = 0.0;    ///< N m, >= 0; above 0 it turns, and the force and the pressure are 0
  double area = 1.0;      ///< m², > 0; m or 1 where planes bound it
  std::vector<std::array<std::size_t, 2>> between = {};  ///< as of PlaneServo
  TimeTable factor = {};
  double largest_speed = 0.0;  ///< m/s, or rad/s where it turns; > 0
  double gain = 0.1;           ///< above 0, at most 1

  bool turns() const noexcept { return torque > 0.0; }
};

/// All that acts from outside.
struct Loads {
  std::vector<PrescribedMotion> motions = {};
  std::vector<PlaneMotion> plane_motions = {};
  std::vector<PlaneServo> servos = {};
  std::vector<BodyServo> body_servos = {};
  std::vector<NodalForce> forces = {};
  std::vector<GroundSprings> ground_springs = {};
  std::vector<SurfacePressure> pressures = {};
  std::vector<BeamDamping> beam_damping = {};
  std::vector<SheetDamping> sheet_damping = {};
  std::vector<MassDamping> mass_damping = {};
  TimeTable gravity_factor = {};  ///< of the gravity in MotionOptions
};

/// What is held by itself or because a motion is prescribed. Nodes that do not exist are left out.
/// @param held  by NodeId
std::vector<Held> held_with_motions(std::vector<Held> held,
                                    std::span<const PrescribedMotion> motions);

}  // namespace plekton::dynamics
