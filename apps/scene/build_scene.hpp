// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"
#include "apps/scene/stage_bodies.hpp"
#include "dynamics/model/scene.hpp"
#include "geometry/mesh/repair/report.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plekton::apps {

/// A membrane in the scene, and what its settings came to.
struct BuiltMembrane {
  std::string name;
  std::optional<geometry::MeshReport> report;  ///< of the import; nothing for a shape
  std::size_t first_node = 0;
  std::size_t nodes = 0;
  std::size_t facets = 0;        ///< none in a net
  std::size_t cylinders = 0;     ///< along every edge of the mesh; none in a sheet, and of a rigid
                                 ///< body only where it has no facets
  std::size_t beams = 0;         ///< or bars: one for each cylinder but those of a rigid body
  std::size_t sheet_facets = 0;  ///< facets that resist; none but in a sheet
  std::vector<bool> on_rim;      ///< by node of the membrane, as in MembraneBody
  std::size_t held_nodes = 0;
  double area = 0.0;           ///< m², of the facets, or of the rectangle around a net
  double mass = 0.0;           ///< kg
  double mean_edge = 0.0;      ///< m, length
  double young_modulus = 0.0;  ///< Pa, of the beams, or of the sheet
  bool is_rigid = false;       ///< the surface of a rigid body
  bool turns_nodes = true;     ///< else its nodes are held against turning, whatever else they are
};

/// Grains of one table in the scene.
struct BuiltGrains {
  std::string name;
  std::size_t count = 0;
  double mass = 0.0;      ///< kg
  double smallest = 0.0;  ///< m, radius
  double largest = 0.0;   ///< m, radius
  bool is_rigid = false;  ///< the spheres of a rigid body
};

/// A rigid body in the scene.
struct BuiltRigidBody {
  std::size_t table = 0;  ///< among [[rigid_bodies]]
  std::string name;
  geometry::NodeId node{-1};                                ///< its reference node
  geometry::Quat orientation = geometry::Quat::Identity();  ///< at the start, of its principal axes
  dynamics::Held held = dynamics::Held::nothing;            ///< by itself and by loads
  dynamics::MassProperties mass;
  Vec3 moments = Vec3::Zero();  ///< kg m², principal
  std::string volume;           ///< what of it has mass
  bool is_absent = false;       ///< not there in this stage
};

/// A reaction that is asked for, with its nodes.
struct BuiltReaction {
  std::string name;
  ReactionKind kind = ReactionKind::plane;
  std::size_t plane = 0;                ///< of kind plane
  std::vector<geometry::NodeId> nodes;  ///< of the other kinds
  std::optional<Vec3> about;            ///< m
};

/// The ties of one table in the scene.
struct BuiltTies {
  std::string name;
  std::size_t first = 0;  ///< among Scene::ties
  std::size_t count = 0;
  double longest_gap = 0.0;  ///< m, at the start
  double softest = 0.0;      ///< N/m
  double stiffest = 0.0;     ///< N/m
  bool lists_each = false;   ///< whether ties.csv has each of them
};

struct BuiltScene {
  dynamics::Scene scene;
  std::vector<BuiltMembrane> membranes;
  std::vector<BuiltGrains> grains;
  std::vector<BuiltRigidBody> rigid_bodies;
  std::vector<BuiltTies> ties;
  std::vector<BuiltReaction> reactions;
  std::vector<geometry::NodeId> moved_nodes;  ///< whose displacement ends the stage
  std::vector<std::string> warnings;
};

/// Hears what is being set up, as in "placing grains sand", and which part of it is done, 0 to 1.
using HearSetUp = std::function<void(const std::string& what, double share)>;

/// Builds the scene of a scenario: membranes and rigid bodies, then grains clear of them and of the
/// planes.
///
/// Every edge of a membrane's mesh, and every bar of a net, becomes a beam or bar of full circular
/// section, radius half the thickness, and a cylinder; every facet a thick facet. The cylinders,
/// like the facets, are numbered in the order of the membranes, and beam i is along cylinder i. In
/// mode continuum there are neither: every facet is one of a thin sheet too, in the same order.
/// @throws InputError listing every problem that only the files and the geometry show: meshes that
///         cannot be used, nothing to hold, grains that do not fit.
BuiltScene build_scene(const Scenario& scenario, const HearSetUp& hear = {});

/// Bodies that are there already.
struct BodiesThere {
  std::span<const std::vector<double>> grains;  ///< m, radii, of the first tables of grains
  std::span<const Vec3> positions;              ///< m, of all their nodes; empty: there are none
  bool are_in_the_way = true;                   ///< whether new grains keep clear of these grains
};

/// The same without loads and reactions. Membranes are where they are made; grains that are there
/// where they are, and the others clear of all of them as they are.
BuiltScene build_bodies(const Scenario& scenario, const BodiesThere& there,
                        const HearSetUp& hear = {});

}  // namespace plekton::apps
