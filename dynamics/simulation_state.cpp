// SPDX-License-Identifier: GPL-3.0-or-later
// The state of a simulation.
#include "dynamics/checkpoint/checkpoint_file.hpp"
#include "dynamics/simulation.hpp"
#include "dynamics/time_step/step_chooser.hpp"
#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace plekton::dynamics {

geometry::StateTree Simulation::snapshot() {
  geometry::StateTree tree;
  exchange(geometry::StateArchive::writer(tree));
  return tree;
}

void Simulation::restore(const geometry::StateTree& state) {
  if (steps_ != 0)
    throw std::logic_error("a state is restored before the first step of a simulation, not after " +
                           std::to_string(steps_));
  exchange(geometry::StateArchive::reader(state));
}

void Simulation::save(const std::filesystem::path& file) {
  write_checkpoint(file, snapshot());
}

void Simulation::load(const std::filesystem::path& file) {
  restore(read_checkpoint(file));
}

void Simulation::exchange(const geometry::StateArchive& archive) {
  archive.same("scene", scene_hash_, "another scene");
  exchange_kept(archive);
  exchange_elements(archive.group("elements"));
  exchange_loads(archive.group("loads"));
  contacts_->exchange(archive.group("contacts"), scene_.planes, pool_);
  exchange_step(archive.group("step"));
}

/// What goes on in another scene too.
void Simulation::exchange_kept(const geometry::StateArchive& archive) {
  exchange_motion(archive);
  bonds_.exchange(archive.group("bonds"));
  yielding_bonds_.exchange(archive.group("yield"));
  sheet_facets_.exchange(archive.group("sheets"));
  if (archive.is_reading()) loads_.follow(bonds_, sheet_facets_);
  if (!ties_.empty()) ties_.exchange(archive.group("ties"));
  if (!rigid_bodies_.empty()) rigid_bodies_.exchange(archive.group("rigid_bodies"));
  exchange_asked_breaks(archive.group("asked_breaks"));
  exchange_last_step(archive.group("step"));
  exchange_ledger(archive.group("ledger"));
}

void Simulation::exchange_motion(const geometry::StateArchive& archive) {
  nodes_.know_all();
  archive("time", time_);
  archive("steps", steps_);
  const geometry::StateArchive nodes = archive.group("nodes");
  nodes.fixed("position", scene_.state.position, "nodes");
  nodes.fixed("velocity", scene_.state.velocity, "nodes");
  nodes.fixed("angular_velocity", scene_.state.angular_velocity, "nodes");
  nodes.fixed("orientation", scene_.state.orientation, "nodes");
  nodes.fixed("force", forces_.force, "nodes");
  nodes.fixed("torque", forces_.torque, "nodes");
  std::vector<Vec3> points, velocities;
  std::vector<double> radii, widenings;
  for (const contact::Plane& plane : scene_.planes) {
    points.push_back(plane.point);
    velocities.push_back(plane.velocity);
    radii.push_back(plane.radius);
    widenings.push_back(plane.widening);
  }
  const geometry::StateArchive planes = archive.group("planes");
  planes.fixed("point", points, "planes");
  planes.fixed("velocity", velocities, "planes");
  planes.fixed("radius", radii, "planes");
  planes.fixed("widening", widenings, "planes");
  for (std::size_t i = 0; i < points.size(); ++i) {
    scene_.planes[i].point = points[i];
    scene_.planes[i].velocity = velocities[i];
    scene_.planes[i].radius = radii[i];
    scene_.planes[i].widening = widenings[i];
  }
  archive("gravity", motion_.gravity);
}

namespace {

template <class Id>
bool is_below(std::size_t count, Id id) noexcept {
  const auto i = static_cast<std::int64_t>(id);
  return i >= 0 && i < static_cast<std::int64_t>(count);
}
template <class Nodes>
bool has_nodes(const Scene& scene, const Nodes& nodes) noexcept {
  return std::all_of(nodes.begin(), nodes.end(),
                     [&](NodeId node) { return is_below(scene.state.size(), node); });
}

/// Elements with their materials. @returns whether they are others than before
template <class Element>
bool exchange_table(const geometry::StateArchive& archive, const char* name, const Scene& scene,
                    std::vector<Element>& elements, std::vector<contact::MaterialId>& materials) {
  struct Kept {
    Element element;
    contact::MaterialId material;
  };
  std::vector<Kept> kept;
  for (std::size_t i = 0; i < elements.size(); ++i) kept.push_back({elements[i], materials[i]});
  archive.rows(name, kept, [&](geometry::RowFields& row, Kept& one) {
    row("nodes", one.element.nodes);
    row.require(has_nodes(scene, one.element.nodes), "nodes");
    row("radius", one.element.radius);
    row("material", one.material);
    row.require(is_below(scene.materials.size(), one.material), "material");
  });
  const bool is_same = std::equal(
      kept.begin(), kept.end(), elements.begin(), elements.end(),
      [](const Kept& one, const Element& element) { return one.element.nodes == element.nodes; });
  elements.clear();
  materials.clear();
  for (const Kept& one : kept) {
    elements.push_back(one.element);
    materials.push_back(one.material);
  }
  return !is_same;
}

}  // namespace

/// What is left of the elements. Contacts and loads go on with it as if all had broken at once.
void Simulation::exchange_elements(const geometry::StateArchive& archive) {
  const bool others =
      exchange_table(archive, "cylinders", scene_, scene_.elements.cylinders,
                     scene_.cylinder_materials) |
      exchange_table(archive, "facets", scene_, scene_.elements.facets, scene_.facet_materials);
  if (!others) return;
  try {
    follow_surface();
  } catch (const std::invalid_argument& error) {
    throw geometry::StateMismatch(
        std::string("the elements left in the state are none of these: ") + error.what());
  }
}

/// What has been asked for and comes with the next step.
void Simulation::exchange_asked_breaks(const geometry::StateArchive& archive) {
  archive("bonds", broken_.bonds);
  archive("cylinders", broken_.cylinders);
  archive("facets", broken_.facets);
  for (const std::size_t bond : broken_.bonds) archive.require(bond < bonds_.size(), "bonds");
  for (const auto& nodes : broken_.cylinders)
    archive.require(has_nodes(scene_, nodes), "cylinders");
  for (const auto& nodes : broken_.facets) archive.require(has_nodes(scene_, nodes), "facets");
}

void Simulation::exchange_last_step(const geometry::StateArchive& archive) {
  archive("drift", drift_);
  archive("last_drift", last_drift_);
  archive("fastest", fastest_);
  archive("fastest_spin", fastest_spin_);
}

/// What the last step found of loads, and what has been set of them since the start.
void Simulation::exchange_loads(const geometry::StateArchive& archive) {
  loads_.exchange(archive);
  driven_planes_.exchange(archive.group("planes"), scene_.planes.size());
  driven_bodies_.exchange(archive.group("bodies"));
  scene_.loads.servos = driven_planes_.servos();
  scene_.loads.body_servos = driven_bodies_.servos();
}

/// How long steps are, and what the next choice of one knows.
void Simulation::exchange_step(const geometry::StateArchive& archive) {
  const bool may_be_none = !std::isfinite(dt_);
  late_starts_.exchange(archive, scene_.state.size());
  archive("time_step", dt_);
  archive.require(dt_ >= 0.0 && (may_be_none || std::isfinite(dt_)), "time_step");
  bool is_chosen = chooser_ != nullptr;
  archive("is_chosen", is_chosen);
  if (is_chosen && chooser_ == nullptr)
    throw geometry::StateMismatch(
        "the state was that of a simulation that chooses its time step; give none here either");
  if (!is_chosen) chooser_.reset();
  if (is_chosen) chooser_->exchange(archive.group("choice"));
}

void Simulation::exchange_ledger(const geometry::StateArchive& archive) {
  const auto exchange_work = [&](const char* name, StepWork& work) {
    const geometry::StateArchive of = archive.group(name);
    of("kinetic", work.kinetic);
    of("damped", work.damped);
    of("external", work.external);
    of("fastest_squared", work.fastest_squared);
    of("fastest_spin_squared", work.fastest_spin_squared);
  };
  exchange_work("work", work_);
  exchange_work("pending", pending_);
  archive("broken", broken_energy_);
  archive("taken_out", taken_out_);
  archive("initial", initial_energy_);
  archive("most_kinetic", most_kinetic_);
  archive("most_accounted", most_accounted_);
  archive("suspect", suspect_);
  archive("initial_moment", initial_moment_);
  archive("initial_translation", initial_stiffness_.translation);
  archive("initial_rotation", initial_stiffness_.rotation);
  momentum_.exchange(archive.group("momentum"));
  archive("largest_overlap_ratio", largest_overlap_ratio_);
  archive("pass_throughs", pass_throughs_);
  archive("most_crossings", most_crossings_);
}

}  // namespace plekton::dynamics
