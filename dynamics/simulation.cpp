// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"

#include "dynamics/measures/fault_finder.hpp"
#include "dynamics/model/acted_on.hpp"
#include "dynamics/model/require_index.hpp"
#include "dynamics/model/scene_figures.hpp"
#include "dynamics/model/scene_hash.hpp"
#include "dynamics/scene_check.hpp"
#include "dynamics/time_step/step_chooser.hpp"
#include "dynamics/time_step/step_limits.hpp"
#include "geometry/base/problems.hpp"
#include "geometry/base/vector_width.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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
          .masses = contact_masses(scene),
          .skin = chosen_skin(scene, options.skin),
          .meets_planes = free_nodes(scene),
          .rest = options.self_contact ? geometry::Positions(scene.state.position)
                                       : geometry::Positions(),
          .groups = rigid_groups(scene)};
}

/// @returns the scene
/// @throws std::invalid_argument listing every problem of the scene or the options, or about the
///         width of vectors (geometry/base/vector_width.hpp)
const Scene& checked(const Scene& scene, const SimulationOptions& options,
                     const contact::ContactModel& model) {
  check(scene);
  geometry::vector_width();  // asked for in a way that cannot be: said here, not within a kernel
  std::ostringstream problems;
  if (!(options.time_step >= 0.0))
    problems << "time step " << options.time_step << " s: must be 0 (choose) or more\n";
  if (!(options.motion.damping >= 0.0 && options.motion.damping < 1.0)) {
    problems << "numerical damping " << options.motion.damping
             << ": must be at least 0 and below 1\n";
  }
  if (!(options.skin >= 0.0))
    problems << "skin " << options.skin << " m: must be 0 (choose) or more\n";
  if (!options.motion.gravity.allFinite()) problems << "gravity is not finite\n";
  if (!model) problems << "contact model: is none; models.hpp makes them\n";
  if (options.threads < 1) problems << "threads " << options.threads << ": must be at least 1\n";
  geometry::throw_if_any(problems);
  return scene;
}

/// Into how many pieces the nodes are cut when their stiffness is looked at once: less space, as
/// the contacts, already made, fill what there is.
constexpr std::size_t kPieces = 16;

/// Whether a scene may ever have a contact.
bool may_touch(const Scene& scene, const geometry::Surface& surface,
               const SimulationOptions& options) {
  return !scene.elements.spheres.empty() || !scene.planes.empty() ||
         surface.structure_count() > 1 || options.self_contact;
}

}  // namespace

Simulation::Simulation(const Scene& scene, const SimulationOptions& options,
                       const contact::ContactModel& model)
    : Simulation(Scene(scene), options, model) {}

Simulation::Simulation(Scene&& scene, const SimulationOptions& options,
                       const contact::ContactModel& model)
    : scene_((checked(scene, options, model), held_as_prescribed(std::move(scene)))),
      scene_hash_(scene_hash(scene_)),
      motion_(options.motion),
      pool_(options.threads),
      surface_(scene_.elements.cylinders, scene_.elements.facets, scene_.state.size()),
      rigid_nodes_(scene_.rigid_bodies, scene_.state, scene_.properties),
      rigid_bodies_(scene_.rigid_bodies, scene_.state),
      contacts_(model(contact_scene(scene_, surface_, options))),
      bonds_(scene_.bonds, scene_.state.size()),
      yielding_bonds_(scene_.bond_laws, scene_.bonds),
      sheet_facets_(scene_.sheet_facets, scene_.state.size()),
      ties_(scene_),
      loads_(scene_),
      driven_planes_(scene_.loads, scene_.planes),
      driven_bodies_(scene_, surface_),
      forces_(scene_.state.size()),
      nodes_(scene_.state, forces_),
      furthest_(furthest_in_a_step(scene_)),
      pace_radius_(pace_radius(scene_.elements)),
      may_touch_(may_touch(scene_, surface_, options)),
      full_gravity_(options.motion.gravity),
      momentum_(scene_.state.position) {
  nodes_.share(contacts_->shared_motion(), acted_on(scene_));
  motion_.gravity = scene_.loads.gravity_factor.at(0.0) * full_gravity_;
  leave_out_absent();
  loads_.start(scene_.state);
  rigid_bodies_.start(scene_.state, scene_.properties);
  least_furthest_ = furthest_.empty() ? 0.0 : *std::min_element(furthest_.begin(), furthest_.end());
  if (options.skin == 0.0 && !scene_.elements.spheres.empty()) contacts_->tune_skin(pace_radius_);
  if (options.skin == 0.0) contacts_->choose_skin_of_structures();
  // What breaks as it is made goes on to touch: steps are chosen for it too.
  limits_ = std::make_unique<StepLimits>(resistance());
  if (options.time_step == 0.0) chooser_ = std::make_unique<StepChooser>(resistance(), *limits_);
  // The first look at the contacts: histories are empty, so nothing is changed by it.
  yielding_bonds_.advance(bonds_, scene_.state, 0.0, pool_);
  yielding_bonds_.forget_dissipated();
  sheet_facets_.advance(scene_.state, 0.0, pool_);
  sheet_facets_.tear(scene_.state.position, pool_);
  sheet_facets_.forget_dissipated();
  follow_breaks();
  bonds_.advance(scene_.state, pool_);
  ties_.advance(scene_.state.position);
  ties_.forget_dissipated();
  contacts_->advance(scene_.state.motion(), scene_.planes, 0.0, pool_, forces_);
  // The first step is chosen for what the forces do to all nodes, also those of other ranks.
  nodes_.found_forces();
  nodes_.know_all();
  bonds_.add_forces(forces_, pool_);
  ties_.add_forces(forces_);
  sheet_facets_.add_forces(forces_, pool_);
  set_first_step(options.time_step);
  forces_.set_zero();
  initial_moment_ = free_moment(0.0);
  work_.kinetic = moving_energy();
  most_kinetic_ = work_.kinetic;
  initial_energy_ = work_.kinetic + contacts_->elastic_energy() + bonds_.elastic_energy() +
                    ties_.elastic_energy() + sheet_facets_.elastic_energy();
}

/// @param asked  s; 0: chosen
/// @throws std::invalid_argument if that is too long
void Simulation::set_first_step(double asked) {
  const bool is_chosen = chooser_ != nullptr;
  const std::size_t pieces = is_chosen ? 1 : kPieces;
  NodalStiffness space((scene_.state.size() + pieces - 1) / pieces, &scene_.properties,
                       &rigid_nodes_);
  initial_stiffness_ = limits_->total_stiffness(space);
  const double critical = limits_->critical(space, force_positions()).dt;
  dt_ = asked;
  if (asked > kLargestStep * critical) {
    std::ostringstream text;
    text << "time step " << asked << " s: the critical time step of this scene is " << critical
         << " s; choose at most " << kLargestStep << " of it (" << kLargestStep * critical
         << " s), or 0 to have " << kSafety << " of it chosen";
    throw std::invalid_argument(text.str());
  }
  if (!is_chosen) return;
  std::vector<Vec3> given = scene_.state.velocity;
  if (std::isfinite(critical)) foresee_first_kick(kSafety * critical);
  dt_ = chooser_->first(critical, std::move(space), pace(std::numeric_limits<double>::infinity()));
  scene_.state.velocity = std::move(given);
}

/// What is stretched at the start gets fast in its first step. That is chosen for the speeds that
/// forces bring in a kick (s): a leapfrog that has to shorten its step while they are large makes
/// energy, 1/8 m a² times the difference of the squares.
void Simulation::foresee_first_kick(double kick) {
  for (std::size_t i = 0; i < scene_.state.size(); ++i)
    scene_.state.velocity[i] += kick * acceleration(i, Vec3::Zero());
}

Simulation::~Simulation() = default;

void Simulation::set_time_step(double dt) {
  if (!(dt > 0.0) || !std::isfinite(dt)) {
    throw std::invalid_argument("time step " + std::to_string(dt) +
                                " s: must be positive and finite");
  }
  dt_ = dt;
  chooser_.reset();
}

void Simulation::require_time_step() const {
  if (std::isfinite(dt_)) return;
  throw std::logic_error(
      "no time step: nothing in this scene is both free and stiff, so that none could be chosen; "
      "give one");
}

void Simulation::set_velocity(NodeId node, const Vec3& velocity, const Vec3& angular_velocity) {
  require_node("set_velocity", node, scene_.state.size());
  if (const std::int32_t body = rigid_nodes_.body_followed_by(node); body >= 0) {
    throw std::invalid_argument("set_velocity: node " + std::to_string(index_of(node)) +
                                " follows rigid body " + std::to_string(body) +
                                "; set the velocity of its reference node, " +
                                std::to_string(index_of(rigid_nodes_.reference(body))));
  }
  if (!velocity.allFinite() || !angular_velocity.allFinite())
    throw std::invalid_argument("set_velocity: velocity and angular velocity must be finite");
  scene_.state.velocity[index_of(node)] = velocity;
  scene_.state.angular_velocity[index_of(node)] = angular_velocity;
  rigid_bodies_.start_from(node, scene_.state, scene_.properties);
  if (chooser_ == nullptr || !std::isfinite(dt_)) return;
  dt_ = std::min(dt_, longest_step(velocity.norm(), largest_gravity(), pace_radius_));
  chooser_->look_again();
}

void Simulation::add_force(std::vector<NodeId> nodes, OwnForce force) {
  if (!force) throw std::invalid_argument("add_force: got no function to ask for the forces");
  for (const NodeId node : nodes) {
    require_node("add_force", node, scene_.state.size());
    if (rigid_nodes_.body_followed_by(node) >= 0)
      throw std::invalid_argument("add_force: node " + std::to_string(index_of(node)) +
                                  " follows a rigid body; load its reference node");
  }
  std::vector<NodeId> sorted = nodes;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end())
    throw std::invalid_argument("add_force: node " + std::to_string(index_of(*twice)) +
                                " is there twice; name each once");
  nodes_.act_on(nodes);
  loads_.add(std::move(nodes), std::move(force));
}

void Simulation::set_force(std::size_t load, const Vec3& force, const Vec3& torque) {
  require_index("set_force", "force", load, loads_.force_count());
  if (!force.allFinite() || !torque.allFinite())
    throw std::invalid_argument("set_force: force and torque must be finite");
  loads_.set_force(load, force, torque);
}

void Simulation::set_pressure(std::size_t load, double pressure) {
  require_index("set_pressure", "pressure", load, loads_.pressed_surfaces().size());
  if (scene_.loads.pressures[load].by_volume)
    throw std::invalid_argument("set_pressure: pressure " + std::to_string(load) +
                                " follows the volume by a table");
  if (!std::isfinite(pressure))
    throw std::invalid_argument("set_pressure: the pressure must be finite");
  loads_.set_pressure(load, pressure);
  if (chooser_ != nullptr) chooser_->look_again();
}

namespace {

/// @throws std::invalid_argument
void require_target(const char* call, double force, double pressure) {
  if (std::isfinite(force) && std::isfinite(pressure) && force >= 0.0 && pressure >= 0.0 &&
      force + pressure > 0.0)
    return;
  throw std::invalid_argument(std::string(call) + ": got " + std::to_string(force) + " and " +
                              std::to_string(pressure) +
                              "; expected finite targets, none below 0, one of them above");
}

}  // namespace

void Simulation::set_servo(std::size_t load, double force, double pressure) {
  require_index("set_servo", "servo", load, scene_.loads.servos.size());
  require_target("set_servo", force, pressure);
  scene_.loads.servos[load].force = force;
  scene_.loads.servos[load].pressure = pressure;
  driven_planes_.set_target(load, force, pressure);
}

void Simulation::set_body_servo(std::size_t load, double target, double pressure) {
  require_index("set_body_servo", "body servo", load, scene_.loads.body_servos.size());
  require_target("set_body_servo", target, pressure);
  BodyServo& servo = scene_.loads.body_servos[load];
  if (servo.turns() && !(target > 0.0 && pressure == 0.0))
    throw std::invalid_argument("set_body_servo: servo " + std::to_string(load) +
                                " has a torque; expected one above 0, and no pressure");
  (servo.turns() ? servo.torque : servo.force) = target;
  servo.pressure = pressure;
  driven_bodies_.set_target(load, servo);
}

void Simulation::set_plane_velocity(std::size_t plane, const Vec3& velocity) {
  require_index("set_plane_velocity", "plane", plane, scene_.planes.size());
  if (driven_planes_.drives(plane))
    throw std::invalid_argument("set_plane_velocity: plane " + std::to_string(plane) +
                                " is moved by a load; change that, or leave it out");
  if (!velocity.allFinite())
    throw std::invalid_argument("set_plane_velocity: the velocity must be finite");
  driven_planes_.set_velocity(plane, velocity);
  if (chooser_ != nullptr) chooser_->look_again();
}

double Simulation::motion_ratio() const {
  if (!may_touch_) return 0.0;
  nodes_.know_all();
  return largest_speed(scene_.state) * dt_ / pace_radius_;
}

Resistance Simulation::resistance() const noexcept {
  return {scene_,        surface_, *contacts_, bonds_,      yielding_bonds_,
          sheet_facets_, ties_,    loads_,     rigid_nodes_};
}

/// @param dt  s, the longest step before the look; infinite: the first one is to be chosen
Pace Simulation::pace(double dt) const noexcept {
  const TimeSpan until_next_look{time_, time_ + longest_to_next_look(dt)};
  return {steps_,
          std::max({largest_speed(scene_.state), loads_.largest_speed(until_next_look),
                    speed_of_free_planes(), driven_planes_.largest_speed(until_next_look),
                    driven_bodies_.largest_speed()}),
          largest_gravity()};
}

/// m/s, of planes that no load moves.
double Simulation::speed_of_free_planes() const noexcept {
  double fastest = 0.0;
  for (std::size_t i = 0; i < scene_.planes.size(); ++i)
    if (!driven_planes_.drives(i)) fastest = std::max(fastest, scene_.planes[i].speed());
  return fastest;
}

/// Nodes have drifted with the velocities after the last kick.
contact::Motion Simulation::motion() const noexcept {
  contact::Motion motion = scene_.state.motion();
  motion.max_displacement = fastest_ * last_drift_;
  return motion;
}

void Simulation::account(const StepWork& work, const StepLengths& lengths) {
  StepWork step = work;
  for (std::size_t i = 0; i < scene_.planes.size(); ++i) {
    const Vec3& velocity = scene_.planes[i].velocity;
    if (!velocity.isZero(0.0))
      step.external -= lengths.kick * contacts_->force_on_plane(i).dot(velocity);
  }
  step.external -= lengths.kick * power_on_turning_;
  for (std::size_t i = 0; i < plane_reactions_.size(); ++i)
    step.external -= lengths.kick * plane_reactions_[i].push * scene_.planes[i].widening;
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
  double fastest = fastest_;
  for (contact::Plane& plane : scene_.planes) {
    plane.point += drift_ * plane.velocity;
    plane.radius += drift_ * plane.widening;
    fastest = std::max(fastest, plane.speed());
  }
  if (chooser_ != nullptr) chooser_->moved(fastest * drift_);
}

Energy Simulation::energy() const {
  nodes_.know_all();
  Energy energy;
  energy.kinetic = work_.kinetic;
  energy.contact_elastic = contacts_->elastic_energy();
  energy.bond_elastic = bonds_.elastic_energy() + ties_.elastic_energy();
  energy.sheet_elastic = sheet_facets_.elastic_energy();
  // Kinetic and elastic energy are those at the moment of the last forces, one step before the
  // positions.
  energy.gravity = -motion_.gravity.dot(free_moment(last_drift_) - initial_moment_);
  energy.friction = contacts_->dissipated();
  energy.tracking = contacts_->tracking_loss() - taken_out_;
  energy.bond_dissipated = broken_energy_ + yielding_bonds_.dissipated() +
                           sheet_facets_.dissipated() + ties_.dissipated();
  energy.damping = work_.damped - pending_.damped;
  energy.external_work = work_.external - pending_.external;
  energy.initial = initial_energy_;
  energy.rounding = rounding_energy();
  return energy;
}

/// What rounding may add up to in the ledger. A place is rounded by eps |x| and a turn by eps in
/// each step, which is worth 1/2 k (eps |x|)² in a spring; these add up like the variances of a
/// random walk. The sum over nodes that gives the energy of gravity is rounded by n eps of its
/// absolute terms, and their change in each step by eps. Work in a step is a sum of terms of either
/// sign, as that of pressure on a shell that is moved, each rounded by eps; those of the last step
/// stand for all. And springs that places rounded by eps |x| strain push with k eps |x|, either way,
/// against what is moved.
double Simulation::rounding_energy() const {
  constexpr double kEps = std::numeric_limits<double>::epsilon();
  double furthest = 0.0;  // m, from the origin
  double weight = 0.0;    // J, sum of m |g.x|
  double power = 0.0;     // W, sum of |f| |v|
  double moved = 0.0;     // m/s, of what moves as prescribed
  for (std::size_t i = 0; i < scene_.state.size(); ++i) {
    const Vec3& x = scene_.state.position[i];
    furthest = std::max(furthest, x.cwiseAbs().maxCoeff());
    power += forces_.force[i].cwiseAbs().dot(scene_.state.velocity[i].cwiseAbs());
    if (holds_translation(scene_.properties.held[i])) {
      moved = std::max(moved, scene_.state.velocity[i].norm());
      continue;
    }
    weight += scene_.properties.mass[i] * full_gravity_.cwiseAbs().dot(x.cwiseAbs());
  }
  const auto steps = static_cast<double>(steps_);
  const double springs =
      initial_stiffness_.translation * furthest * furthest + initial_stiffness_.rotation;
  return 0.5 * kEps * kEps * springs * (1.0 + steps) +
         kEps * weight * (static_cast<double>(scene_.state.size()) + steps) +
         kEps * power * last_drift_ * steps +
         kEps * initial_stiffness_.translation * furthest * moved * last_drift_ * std::sqrt(steps);
}

CriticalStep Simulation::critical_step() const {
  return limits_->critical(force_positions());
}

CriticalStep Simulation::present_critical_step() const {
  return limits_->present(force_positions());
}

StepCause Simulation::critical_cause() const {
  return limits_->cause(force_positions());
}

ExactStep Simulation::exact_critical_step() const {
  return limits_->exact(force_positions(), time_);
}

void Simulation::find_contacts() {
  if (contacts_->makes_lists(motion(), scene_.planes, pool_)) nodes_.know_all();
  contacts_->advance(motion(), scene_.planes, last_drift_, pool_, forces_);
  power_on_turning_ = power_on_turning_planes();
  nodes_.found_forces();
}

/// W, what bodies do to planes that turn about their axes. While nodes are where forces were found.
double Simulation::power_on_turning_planes() const {
  if (std::ranges::none_of(scene_.planes, &contact::Plane::turns)) return 0.0;
  double power = 0.0;
  contacts_->for_each_plane_record(scene_.state.position, [&](const contact::ContactRecord& row) {
    const contact::Plane& plane = scene_.planes[static_cast<std::size_t>(row.b.index)];
    const Vec3 lever = row.point - plane.point;
    power += plane.turning().dot(lever.cross(row.force()) + row.moment);
  });
  return power;
}

void Simulation::choose_step() {
  nodes_.know_all();
  dt_ = chooser_->choose(dt_, pace(std::max(dt_, chooser_->last_chosen())));
}

/// @param longest  s, the step is not longer
void Simulation::advance(double longest) {
  require_time_step();
  break_asked();
  yielding_bonds_.advance(bonds_, scene_.state, last_drift_, pool_);
  sheet_facets_.advance(scene_.state, last_drift_, pool_);
  sheet_facets_.tear(scene_.state.position, pool_);
  follow_breaks();
  find_contacts();
  if (chooser_ != nullptr && chooser_->is_due(steps_, dt_, fastest_spin_)) choose_step();
  drift_ = std::min(dt_, longest);
  bonds_.advance(scene_.state, pool_);
  bonds_.add_forces(forces_, pool_);
  ties_.advance(scene_.state.position);
  ties_.add_forces(forces_);
  sheet_facets_.add_forces(forces_, pool_);
  if (MomentumBalance::is_due(steps_)) watch_momentum();
  apply_loads();
  if (!late_starts_.empty()) put_back_late_starts();
  const StepLengths lengths{0.5 * (last_drift_ + drift_), drift_};
  StepWork work =
      rigid_bodies_.step(scene_.state, forces_, scene_.properties, motion_, lengths, pool_);
  work += nodes_.step(scene_.properties, motion_, lengths, pool_);
  account(work, lengths);
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
  if (!(left > (steps_ > 0 ? kRest * dt_ : 0.0))) return false;
  const double steps = std::max(1.0, std::ceil(left / dt_ - kRest));
  const bool is_whole = std::abs(left - steps * dt_) <= kRest * dt_;
  const bool is_near = steps <= static_cast<double>(kStepsBetweenLooks);
  advance(is_near && !is_whole ? left / steps : dt_);
  return true;
}

/// No node is looked at while none is fast enough.
void Simulation::check_motion() {
  const bool is_slow =
      fastest_ * drift_ <= least_furthest_ && fastest_spin_ * drift_ < std::numbers::pi;
  if (is_slow) return;
  nodes_.know_all();
  if (const auto runaway = find_runaway(scene_.state, furthest_, drift_))
    throw Diverged(
        *runaway, steps_, time_, scene_.state,
        fault_finder().fault(*runaway, {last_drift_, drift_, chooser_ != nullptr}, suspect_));
}

/// Energy is made where motion is: the ledger is looked at when the kinetic energy has doubled, and
/// now and then, for what has gone into friction at once.
void Simulation::watch_energy() {
  constexpr std::int64_t kStepsBetweenLedgers = 1024;
  if (std::abs(work_.kinetic) <= 2.0 * most_kinetic_ && steps_ % kStepsBetweenLedgers != 0) return;
  check_energy();
}

/// m/s, of the planes: of one that turns, the fastest where the nodes are.
double Simulation::fastest_on_planes() const {
  double fastest = 0.0;
  for (const contact::Plane& plane : scene_.planes) {
    fastest = std::max(fastest, plane.speed());
    if (!plane.turns()) continue;
    for (const Vec3& x : scene_.state.position)
      fastest = std::max(fastest, plane.velocity_at(x).norm());
  }
  return fastest;
}

void Simulation::check_energy() {
  const Energy now = energy();
  const double made = std::max(now.made(), -now.kinetic);
  most_kinetic_ = std::max(most_kinetic_, std::abs(now.kinetic));
  most_accounted_ = std::max(most_accounted_, now.accounted());
  const double plane_speed = std::max(driven_planes_.largest_speed(), fastest_on_planes());
  // What starts from rest under a load has its first kinetic energy, a negative one, as initial.
  const double there = most_accounted_ + std::abs(now.initial) +
                       prescribed_energy(scene_.state, scene_.properties, plane_speed);
  if (made <= std::max(now.rounding, there)) return;
  const Divergence divergence{Divergence::Sign::energy,
                              most_energetic(scene_.state, scene_.properties), made, there};
  // What makes the energy need not act any more when it has become too much.
  FaultFinder finder = fault_finder();
  const std::string suspect =
      finder.strongest_action(divergence, state_before(scene_.state, last_drift_));
  if (!suspect.empty()) suspect_ = suspect;
  // A comparison with NaN is false.
  if (made <= kFarMore * there) return;
  // Where next to nothing moves yet, as in the first steps under a load, what steps cut off is many
  // times the energy there is. All of it in one node would not take that further between two looks
  // than anything may go in a step: nobody could see it.
  const std::size_t i = index_of(divergence.node);
  const double speed = std::sqrt(2.0 * made / scene_.properties.mass[i]);
  if (static_cast<double>(kStepsBetweenLooks) * speed * last_drift_ <= furthest_[i]) return;
  throw Diverged(
      divergence, std::max<std::int64_t>(0, steps_ - 1), time_ - last_drift_, scene_.state,
      finder.fault(divergence, {last_drift_, last_drift_, chooser_ != nullptr}, suspect_));
}

/// Before loads are added. With springs of stiffness k_i that have the energies e_i, the forces add
/// up to no more than sqrt(2 sum k_i sum e_i) (Cauchy-Schwarz): what bodies carry in balance. To add
/// up the energies costs much of a step: the ones of some looks stand for those of all.
void Simulation::watch_momentum() {
  constexpr std::int64_t kLooks = 32;
  double carried = 0.0;
  if (steps_ % (kLooks * MomentumBalance::kStepsBetweenLooks) == 0) {
    const double elastic = std::abs(contacts_->elastic_energy()) + bonds_.elastic_energy() +
                           sheet_facets_.elastic_energy() + ties_.elastic_energy();
    carried = kLooks * std::sqrt(2.0 * initial_stiffness_.translation * elastic);
  }
  momentum_.look({scene_.state.position, forces_, *contacts_, ties_, carried,
                  0.5 * (last_drift_ + drift_), nodes_.shared()},
                 pool_);
}

FaultFinder Simulation::fault_finder() {
  nodes_.know_all();
  return {resistance(), *limits_, scene_.state, forces_, furthest_, pool_};
}

// Loads.

/// m/s², at any time.
double Simulation::largest_gravity() const noexcept {
  return scene_.loads.gravity_factor.largest() * full_gravity_.norm();
}

void Simulation::apply_loads() {
  follow_gravity();
  loads_.look_at(yielding_bonds_);
  if (loads_.may_look_at_all()) nodes_.know_all();
  const LoadStep step{time_, last_drift_, drift_};
  LoadWork work = loads_.add_forces(step, scene_.state, forces_, pool_);
  rigid_bodies_.gather(scene_.state, forces_, scene_.properties, pool_);
  loads_.move(step, scene_.state, forces_, pool_, work);
  work_.external += work.external;
  work_.damped += work.damped;
  if (!driven_bodies_.empty()) drive_bodies(step);
  find_plane_reactions();
  if (!driven_planes_.empty()) drive_planes();
}

void Simulation::drive_bodies(const LoadStep& step) {
  nodes_.know_all();  // also those that are near the bodies
  const auto felt = [this](const BodyServo& servo) {
    return servo.turns() ? rigid_bodies_.gathered_torque(servo.body)
                         : rigid_bodies_.gathered_force(servo.body);
  };
  const auto look_at = [this](const BodyPress::Way& way) -> const BodyPress& {
    body_press_.look(*contacts_, rigid_nodes_, way, scene_.planes, scene_.state.position);
    return body_press_;
  };
  work_.external +=
      driven_bodies_.act(step, felt, forces_, rigid_nodes_, scene_.planes, scene_.state, look_at);
}

/// None where nothing asks for them.
void Simulation::find_plane_reactions() {
  plane_reactions_.clear();
  const auto widens = [](const contact::Plane& plane) { return plane.widening != 0.0; };
  if (driven_planes_.empty() && std::ranges::none_of(scene_.planes, widens)) return;
  plane_reactions_.resize(scene_.planes.size());
  contacts_->for_each_plane_force([&](std::size_t plane, const Vec3& force, double push) {
    plane_reactions_[plane].force += force;
    plane_reactions_[plane].push += push;
  });
}

void Simulation::drive_planes() {
  places_ahead_.clear();
  const auto press = [&](std::size_t plane, double way, ServoTime when) {
    if (when == ServoTime::now) return plane_press(plane, way, scene_.state.position);
    if (places_ahead_.empty()) find_places_ahead();
    return plane_press(plane, way, places_ahead_);
  };
  work_.external +=
      driven_planes_.act({time_, last_drift_, drift_}, plane_reactions_, press, scene_.planes);
}

/// Of all nodes after the drift that begins now: of those that are no part of a rigid body as the
/// leapfrog will have them, but for numerical damping.
void Simulation::find_places_ahead() {
  nodes_.know_all();
  const double kick = 0.5 * (last_drift_ + drift_);
  for (std::size_t i = 0; i < scene_.state.size(); ++i) {
    const Vec3 velocity = scene_.state.velocity[i] + kick * acceleration(i, motion_.gravity);
    places_ahead_.push_back(scene_.state.position[i] + drift_ * velocity);
  }
}

/// m/s², by the last forces, along the axes that a node is free in; 0 of parts of rigid bodies.
Vec3 Simulation::acceleration(std::size_t i, const Vec3& gravity) const {
  const auto node = geometry::id_at<NodeId>(i);
  if (rigid_nodes_.body_at(node) >= 0 || rigid_nodes_.body_followed_by(node) >= 0)
    return Vec3::Zero();
  const Vec3 free = free_axes(scene_.properties.held[i]);
  if (free.isZero(0.0)) return Vec3::Zero();
  return free.cwiseProduct(gravity + forces_.force[i] / scene_.properties.mass[i]);
}

/// Of all bodies that the plane would touch with the nodes at x if it were a way (m) further along
/// its normal.
PlanePress Simulation::plane_press(std::size_t plane, double way, geometry::Positions x) const {
  PlanePress press;
  contacts_->for_each_near_plane_pair(
      way, scene_.planes, x,
      [&](NodeId, std::size_t near, const contact::PairSprings& pair, double gap) {
        if (near != plane || !(gap < way)) return;
        press.force += pair.normal_force(gap - way);
        press.stiffness += pair.stiffness(gap - way).normal;
        if (gap < 0.0) press.damping += pair.stiffness(gap).normal_damping;
      });
  return press;
}

/// Gravity that grows does work on what lies still: its energy is that of the gravity of now.
///
/// Kicks by g0 and g1 do the work (g0 + g1)/2 . (C1 - C0) over the drift between them, C the free
/// moment; -g1.C1 + g0.C0 differs from it by -(g1 - g0).(C0 + C1)/2.
void Simulation::follow_gravity() {
  const Vec3 gravity = scene_.loads.gravity_factor.at(time_) * full_gravity_;
  if (gravity == motion_.gravity) return;
  nodes_.know_all();
  const Vec3 mean = 0.5 * (free_moment(last_drift_) + free_moment(0.0)) - initial_moment_;
  work_.external -= (gravity - motion_.gravity).dot(mean);
  motion_.gravity = gravity;
}

/// Mass times place (kg m) of the free nodes along the axes they are free in, at a time before now
/// (s).
Vec3 Simulation::free_moment(double before) const {
  Vec3 moment = Vec3::Zero();
  for (std::size_t i = 0; i < scene_.state.size(); ++i) {
    const Vec3 position = scene_.state.position[i] - before * scene_.state.velocity[i];
    moment +=
        scene_.properties.mass[i] * free_axes(scene_.properties.held[i]).cwiseProduct(position);
  }
  return moment;
}

}  // namespace plekton::dynamics
