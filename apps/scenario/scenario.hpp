// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/grains/size_curve.hpp"
#include "apps/scenario/load_settings.hpp"
#include "apps/scenario/problems.hpp"
#include "apps/scenario/rigid_body_settings.hpp"
#include "apps/scenario/shape_settings.hpp"
#include "apps/scenario/stage_settings.hpp"
#include "apps/scenario/tie_settings.hpp"
#include "contact/base/plane.hpp"
#include "contact/law_list.hpp"
#include "dynamics/structure/bond_strength.hpp"
#include "dynamics/structure/lumped_mass.hpp"
#include "dynamics/structure/wire_curve.hpp"
#include "geometry/base/ranks.hpp"
#include "geometry/base/types.hpp"
#include "geometry/mesh/repair/repair.hpp"
#include "geometry/primitives/box.hpp"
#include "geometry/query/region.hpp"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

/// A scenario as data, all values in SI units. apps/scenario.md documents every key, its unit and
/// its default.
namespace plekton::apps {

using geometry::Vec3;

struct SimulationSettings {
  double duration = 0.0;            ///< s
  std::optional<double> time_step;  ///< s; nothing: chosen from the stiffness
  Place time_step_place;
  Vec3 gravity{0.0, 0.0, -9.81};  ///< m/s²
  double damping = 0.0;           ///< numerical, in [0, 1)
  bool damp_gravity = true;
  bool self_contact = true;  ///< whether a structure may touch itself
  double skin = 0.0;         ///< m; 0: chosen
  std::uint64_t seed = 1;
  int threads = 1;
  geometry::Ranks* ranks = nullptr;  ///< not of the file: who computes it; nothing: this process
};

struct MaterialSettings {
  std::string name;
  std::optional<double> density;  ///< kg/m³
  double young_modulus = 0.0;     ///< Pa
  double stiffness_ratio = 0.3;   ///< tangential over normal stiffness
  double friction_angle = 0.0;    ///< rad
  double poisson_ratio = 0.3;     ///< of the solid, for laws after Hertz
};

/// What two materials do where they touch.
struct PairSettings {
  Place place;
  std::size_t first = 0;   ///< material
  std::size_t second = 0;  ///< material
  contact::ContactSettings contact;
};

/// Where a mesh is put: scaled, then turned, then moved.
struct Placement {
  double scale = 1.0;
  Vec3 axis{0.0, 0.0, 1.0};
  double angle = 0.0;               ///< rad
  Vec3 translation = Vec3::Zero();  ///< m
};

/// Which nodes of a membrane are held.
enum class HoldWhich : std::uint8_t { none, rim, box, all };

struct HoldSettings {
  HoldWhich which = HoldWhich::none;
  geometry::Box box{Vec3::Zero(), Vec3::Zero()};  ///< m, for HoldWhich::box
  bool rotation = false;                          ///< rotations are held too
  Vec3 velocity = Vec3::Zero();                   ///< m/s
};

/// What resists in a membrane: beams along the edges, bars along the edges that only resist
/// stretching, or the facets as a thin sheet.
enum class MembraneMode : std::uint8_t { lattice, truss, continuum };

/// How the mass of a membrane goes to its nodes: half of each edge to its ends, or a third of each
/// facet to its corners.
enum class MassMode : std::uint8_t { edge, area };

/// Where a scenario asks for steps of a repair.
struct RepairKey {
  std::string name;  ///< of the key, as in "target_edge"
  Place place;
};

struct MembraneSettings {
  std::string name;
  std::filesystem::path mesh;                             ///< relative to the current folder
  geometry::RepairOptions repair;                         ///< of the mesh, lengths after scaling
  std::optional<ShapeSettings> shape;                     ///< instead of the mesh
  Place source_place;                                     ///< of the mesh or shape
  std::map<geometry::RepairStep, RepairKey> repair_keys;  ///< of the steps that are asked for
  Placement placement;
  MembraneMode mode = MembraneMode::lattice;
  double thickness = 0.0;  ///< m
  std::size_t material = 0;
  std::optional<double> young_modulus;      ///< Pa, of the beams or bars along the edges, or of the
                                            ///< sheet; else from sheet_stiffness
  double sheet_stiffness = 0.0;             ///< N/m, of the membrane as a sheet
  double poisson_ratio = 0.3;               ///< of the sheet, or of the beams, for their torsion
  double prestrain = 0.0;                   ///< > -1, by which it is stretched at the start
  double rest_pressure = 0.0;               ///< Pa, under which it stands at the start as drawn
  std::optional<double> bending_stiffness;  ///< N m, of a sheet; else that of a solid plate
  std::optional<dynamics::BondStrength> strength;  ///< of the beams or bars, if they yield or break
  std::optional<double> tear_strength;             ///< Pa, of a sheet, if it tears
  std::optional<dynamics::WireCurve> wire;         ///< of the bars, instead of a modulus
  std::optional<dynamics::WireCurve> twist_wire;   ///< of the twists of a hexagonal net; else wire
  MassMode mass_mode = MassMode::edge;
  dynamics::NodalInertia nodal_inertia = dynamics::NodalInertia::ball;
  std::optional<double>
      density;  ///< kg/m³, of the beams (edge) or the plate (area); else from areal_mass
  double areal_mass = 0.0;  ///< kg/m²
  HoldSettings hold;
  Vec3 initial_velocity = Vec3::Zero();   ///< m/s, of the nodes that are not held
  std::vector<Vec3> initial_velocities;   ///< m/s, instead, by point of the shape; or empty
  std::optional<std::size_t> rigid_body;  ///< whose surface it is, and no membrane
  bool is_absent = false;                 ///< not there yet in this stage, or any more
};

/// How grains are placed in their space: one after the other at random, on a face-centred cubic
/// lattice, or grown until they are as dense as asked for.
enum class GrainPlacement : std::uint8_t { random, lattice, packed };

struct GrainSettings {
  std::string name;
  Place place;
  std::size_t material = 0;
  SizeCurve sizes{1.0};
  std::variant<std::size_t, double> amount{
      std::size_t{0}};                            ///< count, or volume of the solids (m³)
  std::optional<double> porosity;                 ///< of the space, instead of an amount
  std::optional<double> stress;                   ///< Pa, mean pressure to which they are packed
  std::vector<Vec3> centres;                      ///< m, of all grains; empty: placed in the space
  std::vector<double> radii;                      ///< m, by centre; empty: as sizes says
  std::optional<std::size_t> rigid_body;          ///< whose spheres they are, and no grains
  bool is_absent = false;                         ///< as a membrane is
  geometry::Box box{Vec3::Zero(), Vec3::Zero()};  ///< m, holds the grains wholly
  std::optional<geometry::CylinderRegion> cylinder;  ///< instead of the box
  std::string inside;                                ///< a closed membrane, instead of the box
  GrainPlacement placement = GrainPlacement::random;
  Vec3 velocity = Vec3::Zero();              ///< m/s
  Vec3 angular_velocity = Vec3::Zero();      ///< rad/s
  std::vector<Vec3> velocities;              ///< m/s, instead, by centre; or empty
  std::vector<Vec3> angular_velocities;      ///< rad/s, instead, by centre; or empty
  std::vector<geometry::Quat> orientations;  ///< unit, by centre; or empty: not turned
  std::uint64_t seed = 0;
};

/// As contact::Plane; without a name it is called by its number.
struct PlaneSettings {
  std::string name;
  std::size_t number = 0;        ///< among all planes that have come, in any stage
  Vec3 point = Vec3::Zero();     ///< m
  Vec3 normal{0.0, 0.0, 1.0};    ///< unit, into the space of the bodies; of a flat one
  Vec3 velocity = Vec3::Zero();  ///< m/s
  std::size_t material = 0;
  contact::Plane::Form form = contact::Plane::Form::flat;
  double radius = 0.0;            ///< m, of a cylinder or sphere
  Vec3 axis{0.0, 0.0, 1.0};       ///< unit
  double angular_velocity = 0.0;  ///< rad/s, about the axis through the point

  bool is_flat() const noexcept { return form == contact::Plane::Form::flat; }
  /// As its columns are called: its name, or as in "planes[0]".
  std::string label() const { return name.empty() ? default_plane_name(number) : name; }
  /// As messages call it: as in "planes.floor", or "planes[0]".
  std::string path() const { return name.empty() ? label() : "planes." + name; }
};

/// What forces a reaction adds up: those of bodies on a plane; those on supports of nodes; those of
/// contacts on a body; all that act on nodes; those of beams and sheets between nodes and the rest.
enum class ReactionKind : std::uint8_t { plane, support, contacts, nodes, section };

/// A force and a moment to be written as time goes on.
struct ReactionSettings {
  std::string name;
  std::string path;  ///< what messages call it, as in "output.reactions.floor"
  ReactionKind kind = ReactionKind::plane;
  std::size_t plane = 0;      ///< of kind plane
  NodeSetSettings nodes;      ///< of the other kinds; of contacts all nodes of the body
  std::optional<Vec3> about;  ///< m, point of the moment; nothing: that of the plane, or the origin
};

/// A part of the sample to be measured as time goes on.
struct MeasureSettings {
  std::string name;                        ///< of its file too
  std::optional<geometry::Region> region;  ///< nothing: the box around the grains at that time
  double bottom = -std::numeric_limits<double>::infinity();  ///< m, height; with that box
  double top = std::numeric_limits<double>::infinity();      ///< m, height
  std::vector<std::size_t> planes;  ///< that cut the region, where they are at that time
};

struct OutputSettings {
  double interval = 0.0;                           ///< s, between frames
  double history_interval = 0.0;                   ///< s, between rows of energy.csv
  double reactions_interval = 0.0;                 ///< s, between rows of reactions.csv
  std::optional<double> checkpoint_interval;       ///< s; nothing: one at the end alone
  std::optional<double> checkpoint_wall_interval;  ///< s, of the clock; nothing: none by it
  std::int64_t hash_interval = 0;  ///< steps, between hashes of the state in run.json
  bool grains = true;
  bool membranes = true;
  bool contacts = true;
  bool contact_list = false;  ///< contacts.csv
  std::vector<ReactionSettings> reactions;
  std::vector<MeasureSettings> measures;
};

struct Scenario {
  std::filesystem::path file;          ///< or kStandardInputName
  std::string text;                    ///< of the file, as it was read
  std::vector<std::string> overrides;  ///< "path=value" each, in the order they were applied
  SimulationSettings simulation;
  std::vector<MaterialSettings> materials;
  std::vector<PairSettings> contacts;
  std::vector<MembraneSettings> membranes;  ///< after these the surfaces of rigid bodies
  std::vector<GrainSettings> grains;        ///< before these the spheres of rigid bodies
  std::vector<RigidBodySettings> rigid_bodies;
  std::vector<TieSettings> ties;
  std::vector<PlaneSettings> planes;
  std::vector<LoadSettings> loads;
  OutputSettings output;
  std::optional<StageEnd> stop;        ///< before the duration is over; without one of its own
  std::optional<StageSettings> stage;  ///< of which this is the scenario
  NamesOfStages names_of_stages;       ///< where there are some
  std::vector<Scenario> stages;        ///< all of them; the rest of this is the first one

  /// What ends this stage, or the run; nothing but the duration: null.
  const StageEnd* end() const noexcept { return stage ? &stage->end : stop ? &*stop : nullptr; }
};

}  // namespace plekton::apps
