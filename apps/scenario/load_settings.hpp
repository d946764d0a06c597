// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/problems.hpp"
#include "dynamics/model/loads.hpp"
#include "geometry/primitives/box.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace plekton::apps {

/// Which nodes of a body: all; those on its rim; those where a coordinate is least or greatest;
/// those in a box.
enum class SetWhich : std::uint8_t { all, rim, x_min, x_max, y_min, y_max, z_min, z_max, box };

/// Nodes of one membrane, or of one table of grains, or the reference node of a rigid body.
struct NodeSetSettings {
  std::optional<std::size_t> rigid_body;  ///< as a whole; then the rest has no meaning
  bool of_grains = false;
  std::size_t body = 0;  ///< among the membranes or the grains
  SetWhich which = SetWhich::all;
  geometry::Box box{geometry::Vec3::Zero(), geometry::Vec3::Zero()};  ///< m, for SetWhich::box
  Place place;                                                        ///< of the key nodes
};

/// A load with what it acts on still to be looked up: its nodes, facets or beams are filled in when
/// the scene is built.
struct MotionSettings {
  NodeSetSettings nodes;
  dynamics::PrescribedMotion motion;
};
struct ForceSettings {
  NodeSetSettings nodes;
  dynamics::NodalForce load;
  bool is_total = false;  ///< the force is that of all nodes together
};
struct GroundSpringSettings {
  NodeSetSettings nodes;
  dynamics::GroundSprings springs;
};
struct MassDampingSettings {
  NodeSetSettings nodes;
  dynamics::MassDamping damping;
};
struct PressureSettings {
  std::size_t membrane = 0;
  Place membrane_place;
  dynamics::SurfacePressure load;
  Place volume_place;  ///< of the key gas or by_volume
};
struct BeamDampingSettings {
  std::size_t membrane = 0;
  dynamics::BeamDamping damping;
};
struct SheetDampingSettings {
  std::size_t membrane = 0;
  dynamics::SheetDamping damping;
};
struct BodyServoSettings {
  std::size_t rigid_body = 0;  ///< among [[rigid_bodies]]
  Place place;                 ///< of the key rigid_body
  dynamics::BodyServo servo;
};
struct GravitySettings {
  dynamics::TimeTable factor;
};

/// What one table [[loads]] asks for.
struct LoadSettings {
  std::string name;
  std::string path;  ///< what messages call it, as in "loads.pull"
  Place place;
  std::variant<GravitySettings, MotionSettings, ForceSettings, GroundSpringSettings,
               MassDampingSettings, PressureSettings, BeamDampingSettings, SheetDampingSettings,
               dynamics::PlaneMotion, dynamics::PlaneServo, BodyServoSettings>
      load;
};

}  // namespace plekton::apps
