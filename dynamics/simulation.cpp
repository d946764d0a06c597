// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"

#include "dynamics/expected_contacts.hpp"
#include "dynamics/present_contacts.hpp"
#include "dynamics/require_index.hpp"
#include "dynamics/scene_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace plekton::dynamics {

namespace {

/// Of what the structures are made.
std::vector<contact::MaterialId> materials_of_structures(const Scene& scene,
                                                         const geometry::Surface& surface) {
  std::vector<contact::MaterialId> materials(surface.structure_count());
  for (std::size_t i = 0; i < scene.elements.facets.size(); ++i) {
    materials[index_of(surface.structure_of(scene.elements.facets[i].nodes[0]))] =
        scene.facet_materials[i];
  }
  for (std::size_t i = 0; i < scene.elements.cylinders.size(); ++i) {
    materials[index_of(surface.structure_of(scene.elements.cylinders[i].nodes[0]))] =
        scene.cylinder_materials[i];
  }
  return materials;
}

contact::ContactScene contact_scene(const Scene& scene, const geometry::Surface& surface,
                                    const SimulationOptions& options) {
  return {.spheres = scene.elements.spheres,
          .surface = surface,
          .materials = scene.materials,
          .of_spheres = scene.sphere_materials,
          .of_structures = materials_of_structures(scene, surface),
          .masses = scene.properties.mass,
          .skin = chosen_skin(scene, options.skin),
          .meets_planes = free_nodes(scene.properties),
          .rest = options.self_contact ? geometry::Positions(scene.state.position)
                                       : geometry::Positions()};
}

/// Into how many pieces the nodes are cut when their stiffness is looked at once: less space, as
/// the contacts, already made, fill what there is.
constexpr std::size_t kPieces = 16;

/// Leaves out the springs along the normals of contacts with surfaces: the forces of the contacts'
/// energy have them, and what turns with them.
struct SlipOnSurfaces {
  ContactSprings& springs;

  void add_pair(NodeId a, NodeId b, const ContactStiffness& contact) {
    springs.add_pair(a, b, contact);
  }
  void add_on_surface(NodeId ball, const geometry::CorePoint& core, ContactStiffness contact,
                      const SurfaceTurning&) {
    contact.normal_stiffness = 0.0;
    springs.add_on_surface(ball, core, contact);
  }
  void add_to_wall(NodeId ball, const ContactStiffness& contact) {
    springs.add_to_wall(ball, contact);
  }
  void add(NodeId node, const IsotropicStiffness& single) { springs.add(node, single); }
};
}  // namespace

Simulation::Simulation(Scene scene, const SimulationOptions& options,
                       const contact::ContactModel& model)
    : scene_((checked(scene, options), held_as_prescribed(std::move(scene)))),
      motion_(options.motion),
      pool_(options.threads),
      surface_(scene_.elements.cylinders, scene_.elements.facets, scene_.state.size()),
      contacts_(model(contact_scene(scene_, surface_, options))),
      bonds_(scene_.bonds, scene_.state.size()),
      yielding_bonds_(scene_.bond_laws, scene_.bonds),
      sheet_facets_(scene_.sheet_facets, scene_.state.size()),
      loads_(scene_),
      driven_planes_(scene_.loads, scene_.planes),
      plane_reactions_(driven_planes_.empty() ? 0 : scene_.planes.size()),
      forces_(scene_.state.size()),
      radii_(node_radii(scene_, surface_)),
      spread_(surface_),
      furthest_(furthest_in_a_step(scene_)),
      pace_radius_(pace_radius(scene_.elements)),
      full_gravity_(options.motion.gravity) {
  motion_.gravity = scene_.loads.gravity_factor.at(0.0) * full_gravity_;
  loads_.start(scene_.state);
  least_furthest_ = furthest_.empty() ? 0.0 : *std::min_element(furthest_.begin(), furthest_.end());
  if (options.skin == 0.0 && !scene_.elements.spheres.empty()) contacts_->tune_skin(pace_radius_);
  if (options.skin == 0.0) contacts_->choose_skin_of_structures();
  // The first look at the contacts: histories are empty, so nothing is changed by it.
  yielding_bonds_.advance(bonds_, scene_.state, pool_);
  yielding_bonds_.forget_dissipated();
  sheet_facets_.advance(scene_.state, pool_);
  sheet_facets_.tear(scene_.state.position, pool_);
  sheet_facets_.forget_dissipated();
  follow_breaks();
  bonds_.advance(scene_.state, pool_);
  contacts_->advance(scene_.state.motion(), scene_.planes, 0.0, pool_, forces_);
  forces_.set_zero();
  const ExpectedContacts expected(scene_, surface_, *contacts_);
  expected_ = expected.of_nodes();
  chooses_time_step_ = options.time_step == 0.0;
  if (chooses_time_step_ && surface_.structure_count() > 0) {
    of_structures_ = expected.of_structures();
    is_counted_.resize(scene_.state.size());
  }
  collision_step_ = expected.collision_step();
  const std::size_t pieces = chooses_time_step_ ? 1 : kPieces;
  NodalStiffness stiffness((scene_.state.size() + pieces - 1) / pieces, &scene_.properties);
  for_each_piece(stiffness, [&] {
    add_expected_to(stiffness);
    add_structures_to(stiffness);
    const NodalStiffness::Total total = stiffness.total();
    initial_stiffness_.translation += total.translation;
    initial_stiffness_.rotation += total.rotation;
  });
  set_first_step(options.time_step, std::move(stiffness));
  initial_moment_ = free_moment(0.0);
  work_.kinetic = kinetic_energy(scene_.state, scene_.properties);
  most_kinetic_ = work_.kinetic;
  initial_energy_ = work_.kinetic + contacts_->elastic_energy() + bonds_.elastic_energy() +
                    sheet_facets_.elastic_energy();
}

/// contact::Motion Simulation::motion()param asked  s; 0: chosen
/// contact::Motion Simulation::motion()param space  for the critical step; kept where the step is
/// chosen contact::Motion Simulation::motion()throws std::invalid_argument if that is too long
void Simulation::set_first_step(double asked, NodalStiffness space) {
  const double critical = critical_step(space).dt;
  if (asked > kLargestStep * critical) {
    std::ostringstream text;
    text << "time step " << asked << " s: the critical time step of this scene is " << critical
         << " s; choose at most " << kLargestStep << " of it (" << kLargestStep * critical
         << " s), or 0 to have " << kSafety << " of it chosen";
    throw std::invalid_argument(text.str());
  }
  dt_ = asked;
  if (!chooses_time_step_) return;
  space_ = std::move(space);
  dt_ = kSafety * critical;
  // Where nothing is stiff and free there is nothing to choose from, however fast it moves.
  if (!std::isfinite(critical)) return;
  choose_time_step();
  if (!std::isfinite(dt_)) dt_ = stable_step_ = kSafety * critical;
}

void Simulation::set_time_step(double dt) {
  if (!(dt > 0.0) || !std::isfinite(dt)) {
    throw std::invalid_argument("time step " + std::to_string(dt) +
                                " s: must be positive and finite");
  }
  dt_ = dt;
  chooses_time_step_ = false;
}

void Simulation::require_time_step() const {
  if (std::isfinite(dt_)) return;
  throw std::logic_error(
      "no time step: nothing in this scene is both free and stiff, so that none could be chosen; "
      "give one");
}

void Simulation::set_velocity(NodeId node, const Vec3& velocity, const Vec3& angular_velocity) {
  require_node("set_velocity", node, scene_.state.size());
  scene_.state.velocity[index_of(node)] = velocity;
  scene_.state.angular_velocity[index_of(node)] = angular_velocity;
  if (!chooses_time_step_ || !std::isfinite(dt_)) return;
  dt_ = std::min(dt_, longest_step(velocity.norm(), largest_gravity(), pace_radius_));
}

double Simulation::motion_ratio() const noexcept {
  return largest_speed(scene_.state) * dt_ / pace_radius_;
}

PresentContacts Simulation::present_contacts() const noexcept {
  return {*contacts_, scene_.planes, radii_};
}

/// Nodes have drifted with the velocities after the last kick.
contact::Motion Simulation::motion() const noexcept {
  contact::Motion motion = scene_.state.motion();
  motion.way = fastest_ * last_drift_;
  return motion;
}

void Simulation::account(const StepWork& work, const StepLengths& lengths) {
  StepWork step = work;
  for (std::size_t i = 0; i < scene_.planes.size(); ++i) {
    const Vec3& velocity = scene_.planes[i].velocity;
    if (!velocity.isZero(0.0))
      step.external -= lengths.kick * contacts_->force_on_plane(i).dot(velocity);
  }
  // The part of the kick that comes after the moment of the forces: all of the first one, half of
  // one between drifts of equal lengths.
  const double later = 0.5 * lengths.drift / lengths.kick;
  const LoadWork left = loads_.work_after({time_, last_drift_, drift_}, scene_.state, pool_);
  pending_ = {0.0, later * step.damped + left.damped, later * step.external + left.external};
  if (last_drift_ == 0.0) initial_energy_ += step.kinetic - work_.kinetic;
  work_.kinetic = step.kinetic;
  work_.damped += step.damped + left.damped;
  work_.external += step.external + left.external;
  fastest_ = std::sqrt(work.fastest_squared);
  fastest_spin_ = std::sqrt(work.fastest_spin_squared);
  largest_overlap_ratio_ = std::max(largest_overlap_ratio_, contacts_->largest_overlap_ratio());
  pass_throughs_ += contacts_->pass_throughs();
  most_crossings_ = std::max(most_crossings_, contacts_->crossings());
}

void Simulation::move_planes() {
  double squared = fastest_ * fastest_;
  for (contact::Plane& plane : scene_.planes) {
    plane.point += drift_ * plane.velocity;
    squared = std::max(squared, plane.velocity.squaredNorm());
  }
  way_in_a_step_ = std::sqrt(squared) * drift_;
  look_.way += way_in_a_step_;
}

Energy Simulation::energy() const {
  Energy energy;
  energy.kinetic = work_.kinetic;
  energy.contact_elastic = contacts_->elastic_energy();
  energy.bond_elastic = bonds_.elastic_energy();
  energy.sheet_elastic = sheet_facets_.elastic_energy();
  // Kinetic and elastic energy are those at the moment of the last forces, one step before the
  // positions.
  energy.gravity = -motion_.gravity.dot(free_moment(last_drift_) - initial_moment_);
  energy.friction = contacts_->dissipated();
  energy.tracking = contacts_->tracking_loss();
  energy.bond_dissipated =
      broken_energy_ + yielding_bonds_.dissipated() + sheet_facets_.dissipated();
  energy.damping = work_.damped - pending_.damped;
  energy.external_work = work_.external - pending_.external;
  energy.initial = initial_energy_;
  energy.rounding = rounding_energy();
  return energy;
}

/// What rounding may add up to in the ledger. A place is rounded by eps |x| and a turn by eps in
/// each step, which is worth 1/2 k (eps |x|)² in a spring; these add up like the variances of a
/// random walk. The sum over nodes that gives the energy of gravity is rounded by n eps of its
/// absolute terms, and their change in each step by eps.
double Simulation::rounding_energy() const {
  constexpr double kEps = std::numeric_limits<double>::epsilon();
  double furthest = 0.0;  // m, from the origin
  double weight = 0.0;    // J, sum of m |g.x|
  for (std::size_t i = 0; i < scene_.state.size(); ++i) {
    const Vec3& x = scene_.state.position[i];
    furthest = std::max(furthest, x.cwiseAbs().maxCoeff());
    if (holds_translation(scene_.properties.held[i])) continue;
    weight += scene_.properties.mass[i] * full_gravity_.cwiseAbs().dot(x.cwiseAbs());
  }
  const auto steps = static_cast<double>(steps_);
  const double springs =
      initial_stiffness_.translation * furthest * furthest + initial_stiffness_.rotation;
  return 0.5 * kEps * kEps * springs * (1.0 + steps) +
         kEps * weight * (static_cast<double>(scene_.state.size()) + steps);
}

void Simulation::add_expected_to(NodalStiffness& stiffness) const {
  for (std::size_t i = 0; i < expected_.size(); ++i)
    stiffness.add(geometry::id_at<NodeId>(i), expected_[i]);
}

void Simulation::add_structures_to(NodalStiffness& stiffness) const {
  for (std::size_t i = 0; i < scene_.bonds.size(); ++i) {
    if (!bonds_.is_broken(i))
      stiffness.add_beam(scene_.bonds[i], scene_.state, bonds_.spring(i).length);
  }
  sheet_facets_.add_to(stiffness, scene_.state);
  loads_.add_springs_to(stiffness);
  loads_.add_pressures_to(stiffness, scene_.state.position);
}

CriticalStep Simulation::critical_step() const {
  NodalStiffness space(scene_.state.size(), &scene_.properties);
  return critical_step(space);
}

CriticalStep Simulation::present_critical_step() const {
  NodalStiffness space(scene_.state.size(), &scene_.properties);
  CriticalStep step = present_step(space);
  step.dt = loads_.critical_step(step.dt, scene_);
  return step;
}

ExactStep Simulation::exact_critical_step() const {
  ContactSprings springs;
  SlipOnSurfaces slip{springs};
  present_contacts().add_to(slip, 0.0, force_positions());
  contact::PatchFinder finder(surface_);
  const auto normal = [&](geometry::Positions x, NodeForces& forces) {
    contacts_->add_elastic_forces(x, forces, finder, [](NodeId) { return true; });
  };
  return dynamics::exact_critical_step(scene_, {bonds_, sheet_facets_}, loads_, springs, time_,
                                       normal);
}

/// Calls look() for all nodes, as many at once as there is space for.
template <class Look>
void Simulation::for_each_piece(NodalStiffness& space, const Look& look) const {
  for (std::size_t first = 0; first < scene_.state.size(); first += space.node_count()) {
    space.begin_at(first);
    look();
  }
}

/// contact::Motion Simulation::motion()param space  for some of the nodes; its contents are
/// overwritten
CriticalStep Simulation::critical_step(NodalStiffness& space) const {
  CriticalStep shortest = structural_step(space, true);
  const CriticalStep present = present_step(space);
  if (present.dt < shortest.dt) shortest = present;
  shortest.dt = loads_.critical_step(shortest.dt, scene_);
  return shortest;
}

/// Of the contacts of now, without gases and viscous damping.
/// contact::Motion Simulation::motion()param space  where there are no surfaces it is all the space
/// that is needed
CriticalStep Simulation::present_step(NodalStiffness& space) const {
  if (surface_.structure_count() == 0) return structural_step(space, false);
  const std::vector<Vec3> x = force_positions();
  NodalStiffness whole(scene_.state.size(), &scene_.properties);
  ContactSprings springs;
  SpreadStiffness spread(surface_);
  add_structures_to(whole);
  present_contacts().add_to(springs, 0.0, x);
  add_spread_to(whole, springs, spread, x);
  SpringShares().add(springs, scene_.properties, whole);
  return whole.critical_step(scene_.properties);
}

/// Without gases and viscous damping.
/// contact::Motion Simulation::motion()param expected  with the contacts that may come, or else
/// with those of now
CriticalStep Simulation::structural_step(NodalStiffness& space, bool expected) const {
  CriticalStep shortest;
  const std::vector<Vec3> x = force_positions();
  for_each_piece(space, [&] {
    if (expected) add_expected_to(space);
    add_structures_to(space);
    if (!expected) present_contacts().add_to(space, 0.0, x);
    const CriticalStep step = space.critical_step(scene_.properties);
    if (step.dt < shortest.dt) shortest = step;
  });
  return shortest;
}

/// contact::Motion Simulation::motion()param longest  s, the step is not longer
void Simulation::advance(double longest) {
  require_time_step();
  yielding_bonds_.advance(bonds_, scene_.state, pool_);
  sheet_facets_.advance(scene_.state, pool_);
  sheet_facets_.tear(scene_.state.position, pool_);
  follow_breaks();
  contacts_->advance(motion(), scene_.planes, last_drift_, pool_, forces_);
  if (chooses_time_step_ && is_look_due()) choose_time_step();
  drift_ = std::min(dt_, longest);
  bonds_.advance(scene_.state, pool_);
  bonds_.add_forces(forces_, pool_);
  sheet_facets_.add_forces(forces_, pool_);
  apply_loads();
  const StepLengths lengths{0.5 * (last_drift_ + drift_), drift_};
  account(leapfrog_.step(scene_.state, forces_, scene_.properties, motion_, lengths, pool_),
          lengths);
  move_planes();
  check_motion();
  time_ += drift_;
  last_drift_ = drift_;
  ++steps_;
  watch_energy();
}

bool Simulation::step_until(double end) {
  constexpr double kRest = 1e-3;  // of a step
  require_time_step();
  const double left = end - time_;
  if (!(left > kRest * dt_)) return false;
  const bool is_rest = left < (1.0 - kRest) * dt_;
  advance(is_rest ? left : dt_);
  return true;
}

}  // namespace plekton::dynamics
