// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/build_loads.hpp"

#include "apps/scene/at_start.hpp"
#include "apps/scene/node_set.hpp"
#include "apps/scene/prescribed_once.hpp"
#include "dynamics/loads/surface_pressure.hpp"
#include "dynamics/loads/surface_pressure_check.hpp"
#include "dynamics/model/scene_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>

namespace plekton::apps {
namespace {

using geometry::NodeId;

/// Adds one load after the other and collects what is wrong with them.
class LoadBuilder {
 public:
  LoadBuilder(const Scenario& scenario, BuiltScene& built, const StageBodies* bodies)
      : scenario_(scenario),
        built_(built),
        bodies_(bodies),
        loads_(built.scene.loads),
        prescribed_(built.scene.properties.held) {}

  void add_all() {
    for (std::size_t i = 0; i < scenario_.loads.size(); ++i) {
      current_ = &scenario_.loads[i];
      start_ = bodies_ ? &bodies_->starts[scenario_.stage->origins.loads[i]] : nullptr;
      const AtStart at_start(built_, start_);
      std::visit([&](const auto& load) { add(load); }, current_->load);
    }
    problems_.throw_if_any();
    warn_about_held_nodes();
  }

 private:
  void add(const GravitySettings& gravity) {
    if (std::exchange(has_gravity_, true))
      complain(current_->place, "kind", "there is a load of kind gravity already; expected one");
    loads_.gravity_factor = begun(gravity.factor);
  }

  void add(const MotionSettings& settings) {
    dynamics::PrescribedMotion motion = settings.motion;
    motion.nodes = nodes_of_set(settings.nodes);
    motion.factor = begun(motion.factor);
    motion.start = places_of(motion.nodes);
    const std::string taken = prescribed_.add(motion, *current_);
    if (!taken.empty()) {
      complain(
          settings.nodes.place, "nodes",
          fmt::format("in \"{}\", {}; expected each component of a node to be prescribed once: "
                      "take other nodes or components",
                      name_of(settings.nodes, built_), taken));
    }
    loads_.motions.push_back(std::move(motion));
  }

  void add(const ForceSettings& settings) {
    dynamics::NodalForce load = settings.load;
    load.nodes = nodes_of_set(settings.nodes);
    load.factor = begun(load.factor);
    if (settings.is_total && !load.nodes.empty())
      load.force /= static_cast<double>(load.nodes.size());
    if (load.force.isZero(0.0) && load.torque.isZero(0.0))
      warn(
          fmt::format("{}: its force and torque are 0: it does nothing, unless a program sets it "
                      "as it runs; give one, or leave it out",
                      current_->path));
    warn_where_off(settings.load.factor);
    forced_by_.push_back(current_);
    loads_.forces.push_back(std::move(load));
  }

  void add(const GroundSpringSettings& settings) {
    const std::vector<NodeId> nodes = nodes_of_set(settings.nodes);
    if (settings.springs.stiffness.isZero(0.0))
      warn(fmt::format("{}: its stiffness is 0: it does nothing; give one, or leave it out",
                       current_->path));
    sprung_by_.push_back(current_);
    loads_.ground_springs.push_back({nodes, settings.springs.stiffness, places_of(nodes)});
  }

  void add(const MassDampingSettings& settings) {
    loads_.mass_damping.push_back({nodes_of_set(settings.nodes), settings.damping.rate});
  }

  void add(const BeamDampingSettings& settings) {
    dynamics::BeamDamping damping = settings.damping;
    const auto [first, count] = range_of(settings.membrane, &BuiltMembrane::beams);
    if (count == 0)
      complain(current_->place, "membrane",
               fmt::format("\"{}\" has no beams to damp; expected a membrane of beams or bars, or "
                           "kind = \"mass_damping\"",
                           built_.membranes[settings.membrane].name));
    for (std::size_t i = 0; i < count; ++i) damping.bonds.push_back(first + i);
    loads_.beam_damping.push_back(std::move(damping));
  }

  void add(const SheetDampingSettings& settings) {
    dynamics::SheetDamping damping = settings.damping;
    const auto [first, count] = range_of(settings.membrane, &BuiltMembrane::sheet_facets);
    if (count == 0)
      complain(current_->place, "membrane",
               fmt::format("\"{}\" is no sheet; expected a membrane in mode continuum, or kind = "
                           "\"beam_damping\" for one of beams or bars",
                           built_.membranes[settings.membrane].name));
    for (std::size_t i = 0; i < count; ++i) damping.facets.push_back(first + i);
    loads_.sheet_damping.push_back(std::move(damping));
  }

  void add(const PressureSettings& settings) {
    dynamics::SurfacePressure load = settings.load;
    const auto [first, count] = range_of(settings.membrane, &BuiltMembrane::facets);
    for (std::size_t i = 0; i < count; ++i)
      load.facets.push_back(geometry::id_at<geometry::FaceId>(first + i));
    const std::string& name = built_.membranes[settings.membrane].name;
    if (count == 0)
      complain(settings.membrane_place, "membrane",
               fmt::format("\"{}\" is a net without facets; expected a sheet or a shell for the "
                           "pressure to act on",
                           name));
    else if (faces_one_way(settings, load) && (load.gas || load.by_volume))
      require_closed(settings, load);
    warn_about_turned_facets(built_.membranes[settings.membrane]);
    if (load.pressure == 0.0 && !load.gas && !load.by_volume)
      warn(
          fmt::format("{}: its pressure is 0, without gas or by_volume: it does nothing, unless a "
                      "program sets it as it runs; give one, or leave it out",
                      current_->path));
    if (!load.gas) warn_where_off(load.factor);
    load.factor = begun(load.factor);
    if (load.gas && start_ != nullptr) load.start_volume = volume_of(load);
    loads_.pressures.push_back(std::move(load));
  }

  void add(dynamics::PlaneMotion motion) {
    drive(motion.plane);
    const PlaneSettings& plane = scenario_.planes[motion.plane];
    if (!plane.velocity.isZero(0.0))
      complain(current_->place, "plane",
               fmt::format("\"{}\" has a velocity of its own; leave planes.{}.velocity out",
                           plane.name, plane.name));
    motion.factor = begun(motion.factor);
    if (start_ != nullptr) motion.start = start_->planes[motion.plane];
    loads_.plane_motions.push_back(motion);
  }

  void add(dynamics::PlaneServo servo) {
    drive(servo.plane);
    warn_where_off(servo.factor);
    servo.factor = begun(servo.factor);
    loads_.servos.push_back(servo);
  }

  void add(const BodyServoSettings& settings) {
    const NodeId reference = rigid_body_of(settings.rigid_body, built_).node;
    const auto& bodies = built_.scene.rigid_bodies;
    const auto body = std::find_if(bodies.begin(), bodies.end(),
                                   [&](const auto& one) { return one.node == reference; });
    dynamics::BodyServo servo = settings.servo;
    warn_where_off(servo.factor);
    servo.factor = begun(servo.factor);
    servo.body = static_cast<std::size_t>(body - bodies.begin());
    dynamics::PrescribedMotion along;  // as one that no other motion may prescribe too
    along.nodes = {reference};
    along.held = dynamics::driven_axis(servo);
    const std::string taken = prescribed_.add(along, *current_);
    if (!taken.empty())
      complain(settings.place, "rigid_body",
               fmt::format("of \"{}\", {}; leave that free for the servo",
                           rigid_body_of(settings.rigid_body, built_).name, taken));
    loads_.body_servos.push_back(std::move(servo));
  }

  /// The first facet or beam of a membrane, and how many there are.
  std::pair<std::size_t, std::size_t> range_of(std::size_t membrane,
                                               std::size_t BuiltMembrane::*count) const {
    std::size_t first = 0;
    for (std::size_t i = 0; i < membrane; ++i) first += built_.membranes[i].*count;
    return {first, built_.membranes[membrane].*count};
  }

  std::vector<NodeId> nodes_of_set(const NodeSetSettings& set) {
    std::vector<NodeId> nodes = nodes_of(set, built_);
    if (nodes.empty()) complain(set.place, "nodes", nothing_of(set, built_));
    return nodes;
  }

  /// Its numbers count from when the load began.
  dynamics::TimeTable begun(const dynamics::TimeTable& factor) const {
    return start_ ? factor.from(start_->time) : factor;
  }

  /// m, where the load began; empty if that is now.
  std::vector<geometry::Vec3> places_of(const std::vector<NodeId>& nodes) const {
    std::vector<geometry::Vec3> places;
    for (std::size_t i = 0; start_ != nullptr && i < nodes.size(); ++i)
      places.push_back(start_->positions[index_of(nodes[i])]);
    return places;
  }

  /// m³
  double volume_of(const dynamics::SurfacePressure& load) const {
    std::vector<std::array<NodeId, 3>> corners;
    for (const geometry::FaceId facet : load.facets)
      corners.push_back(built_.scene.elements.facets[index_of(facet)].nodes);
    return dynamics::volume_under(corners, built_.scene.state.position);
  }

  std::vector<geometry::Facet> facets_of(const dynamics::SurfacePressure& load) const {
    std::vector<geometry::Facet> facets;
    for (const geometry::FaceId facet : load.facets)
      facets.push_back(built_.scene.elements.facets[index_of(facet)]);
    return facets;
  }

  bool faces_one_way(const PressureSettings& settings, const dynamics::SurfacePressure& load) {
    const auto two = dynamics::opposite_neighbours(facets_of(load));
    if (!two) return true;
    complain(settings.membrane_place, "membrane",
             fmt::format("facets {} and {} of \"{}\" are neighbours but face opposite ways, and "
                         "pressure acts along their normals; swap two corners of one of them",
                         (*two)[0], (*two)[1], built_.membranes[settings.membrane].name));
    return false;
  }

  void require_closed(const PressureSettings& settings, const dynamics::SurfacePressure& load) {
    const std::string& name = built_.membranes[settings.membrane].name;
    const std::string_view key = load.gas ? "gas" : "by_volume";
    if (!dynamics::are_closed(facets_of(load)))
      complain(
          settings.volume_place, key,
          fmt::format("\"{}\" is open and encloses no volume; expected a closed surface: close "
                      "it (fill_holes), or leave {} out for a pressure that does not depend "
                      "on the volume",
                      name, key));
    else if (!(volume_of(load) > 0.0))
      complain(
          settings.volume_place, key,
          fmt::format("the facets of \"{}\" face inward; expected them to face outward", name));
  }

  /// Pressure acts along the normals, so it matters which side was meant.
  void warn_about_turned_facets(const BuiltMembrane& membrane) {
    if (!membrane.report || membrane.report->changed.flipped_facets == 0) return;
    // Of the facets of the file; remeshed there are others.
    const std::string all =
        membrane.report->reshaped ? "" : fmt::format(" of the {}", membrane.facets);
    built_.warnings.push_back(fmt::format(
        "{}: {}{} facets of \"{}\" faced the other way in their file and were turned over, so that "
        "the pressure pushes all of them to one side; look whether it is the right one",
        current_->path, membrane.report->changed.flipped_facets, all, membrane.name));
  }

  /// Of what does nothing before the run ends; of stages nobody knows when that is.
  /// @param factor  counts from when the load begins
  void warn_where_off(const dynamics::TimeTable& factor) {
    const double end =
        scenario_.stage ? std::numeric_limits<double>::infinity() : scenario_.simulation.duration;
    const auto& rows = factor.rows();
    const bool is_on =
        factor.at(0.0) != 0.0 || std::any_of(rows.begin(), rows.end(), [&](const auto& row) {
          return row.value != 0.0 && row.time > 0.0 && row.time < end;
        });
    if (is_on || (!scenario_.stage && factor.at(end) != 0.0)) return;
    warn(
        fmt::format("{}: its factor is 0 at all times until the run ends: it does nothing; give "
                    "rows of other numbers before that, or leave the load out",
                    current_->path));
  }

  /// Whether a force or torque has a part in which a node is free.
  static bool can_move(const dynamics::NodalForce& load, dynamics::Held held) {
    for (int axis = 0; axis < 3; ++axis) {
      if (load.force[axis] != 0.0 && !dynamics::holds_along(held, axis)) return true;
      if (load.torque[axis] != 0.0 && !dynamics::holds_about(held, axis)) return true;
    }
    return false;
  }

  static bool can_move(const dynamics::GroundSprings& load, dynamics::Held held) {
    return !dynamics::free_axes(held).cwiseProduct(load.stiffness).isZero(0.0);
  }

  /// By motions and servos too, which may come after the loads.
  void warn_about_held_nodes() {
    const std::vector<dynamics::Held> held = dynamics::held_with_loads(built_.scene);
    warn_where_held(loads_.forces, forced_by_, held, "along its force and about its torque");
    warn_where_held(loads_.ground_springs, sprung_by_, held, "along its springs");
  }

  /// @param by  the load of each
  template <class Load>
  void warn_where_held(const std::vector<Load>& loads, const std::vector<const LoadSettings*>& by,
                       const std::vector<dynamics::Held>& held, std::string_view axes) {
    for (std::size_t i = 0; i < loads.size(); ++i) {
      const auto moves = [&](NodeId node) { return can_move(loads[i], held[index_of(node)]); };
      if (!can_move(loads[i], dynamics::Held::nothing) ||
          std::any_of(loads[i].nodes.begin(), loads[i].nodes.end(), moves))
        continue;
      warn(
          fmt::format("{}: all that it acts on is held or moved as told {}, so that it moves "
                      "nothing; free something (hold, motions, servos), or take other nodes",
                      by[i]->path, axes));
    }
  }

  void warn(std::string warning) { built_.warnings.push_back(std::move(warning)); }

  void drive(std::size_t plane) {
    if (driven_.empty()) driven_.resize(scenario_.planes.size(), nullptr);
    const LoadSettings* const by = std::exchange(driven_[plane], current_);
    if (by != nullptr)
      complain(current_->place, "plane",
               fmt::format("\"{}\" is driven by {} already; expected one load for a plane",
                           scenario_.planes[plane].name, by->path));
  }

  void complain(const Place& place, std::string_view key, const std::string& what) {
    problems_.add(place, fmt::format("{}.{}: {}", current_->path, key, what));
  }

  const Scenario& scenario_;
  BuiltScene& built_;
  const StageBodies* bodies_;
  dynamics::Loads& loads_;
  PrescribedOnce prescribed_;
  Problems problems_;
  const LoadSettings* current_ = nullptr;
  const StageStart* start_ = nullptr;           // of the load; nothing: it begins with the scene
  std::vector<const LoadSettings*> driven_;     // by plane
  std::vector<const LoadSettings*> forced_by_;  // by place among the forces
  std::vector<const LoadSettings*> sprung_by_;  // likewise among the ground springs
  bool has_gravity_ = false;
};

}  // namespace

void add_loads(const Scenario& scenario, BuiltScene& built, const StageBodies* bodies) {
  LoadBuilder(scenario, built, bodies).add_all();
}

}  // namespace plekton::apps
