// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"

#include "dynamics/carry_over/carried_elements.hpp"
#include "dynamics/carry_over/carried_holds.hpp"
#include "dynamics/carry_over/carried_planes.hpp"
#include "dynamics/carry_over/carried_state.hpp"
#include "dynamics/carry_over/places_check.hpp"
#include "dynamics/checkpoint/checkpoint_file.hpp"
#include "dynamics/contacts_then.hpp"
#include "dynamics/loads/applied_loads.hpp"
#include "dynamics/measures/fault_finder.hpp"
#include "dynamics/measures/mean_carried.hpp"
#include "dynamics/measures/plane_forces.hpp"
#include "dynamics/measures/rounding_energy.hpp"
#include "dynamics/measures/section_force.hpp"
#include "dynamics/measures/unbalanced_force.hpp"
#include "dynamics/model/acted_on.hpp"
#include "dynamics/model/contact_scene.hpp"
#include "dynamics/model/erase_elements.hpp"
#include "dynamics/model/exchange_scene.hpp"
#include "dynamics/model/require_index.hpp"
#include "dynamics/model/scene_figures.hpp"
#include "dynamics/model/scene_hash.hpp"
#include "dynamics/scene_check.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/sheet_facets.hpp"
#include "dynamics/time_step/step_chooser.hpp"
#include "dynamics/time_step/step_limits.hpp"
#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace plekton::dynamics {

namespace {

/// Into how many pieces the nodes are cut when their stiffness is looked at once: less space, as
/// the contacts, already made, fill what there is.
constexpr std::size_t kPieces = 16;

}  // namespace

Simulation::Simulation(const Scene& scene, const SimulationOptions& options,
                       const contact::ContactModel& model)
    : Simulation(Scene(scene), options, model) {}

Simulation::Simulation(Scene&& scene, const SimulationOptions& options,
                       const contact::ContactModel& model)
    : scene_((check(scene), check(options, model), to_compute_with(std::move(scene)))),
      scene_hash_(scene_hash(scene_)),
      motion_(options.motion),
      pool_(options.threads),
      surface_(scene_.elements.cylinders, scene_.elements.facets, scene_.state.size()),
      rigid_nodes_(scene_.rigid_bodies, scene_.state, scene_.properties),
      rigid_bodies_(scene_.rigid_bodies, scene_.state),
      contacts_(model(contact_scene(scene_, surface_, options.skin, options.self_contact))),
      bonds_(std::make_unique<BeamBonds>(scene_.bonds, scene_.state.size())),
      yielding_bonds_(scene_.bond_laws, scene_.bonds),
      sheet_facets_(std::make_unique<SheetFacets>(scene_.sheet_facets, scene_.state.size())),
      ties_(scene_),
      loads_(std::make_unique<AppliedLoads>(scene_)),
      driven_planes_(scene_.loads, scene_.planes),
      driven_bodies_(scene_, surface_),
      forces_(scene_.state.size()),
      nodes_(scene_.state, forces_),
      largest_radius_(largest_radius(scene_.elements)),
      pace_radius_(pace_radius(scene_.elements)),
      may_touch_(may_touch(scene_, surface_, options.self_contact)),
      full_gravity_(options.motion.gravity),
      momentum_(scene_.state.position) {
  nodes_.share(contacts_->shared_motion(), acted_on(scene_), servo_planes(scene_));
  motion_.gravity = scene_.loads.gravity_factor.at(0.0) * full_gravity_;
  leave_out_absent();
  loads_->start(scene_.state);
  rigid_bodies_.start(scene_.state, scene_.properties);
  const std::vector<double> furthest = furthest_in_a_step(scene_, largest_radius_);
  least_furthest_ = furthest.empty() ? 0.0 : *std::min_element(furthest.begin(), furthest.end());
  if (options.skin == 0.0 && !scene_.elements.spheres.empty()) contacts_->tune_skin(pace_radius_);
  if (options.skin == 0.0) contacts_->choose_skin_of_structures();
  // What breaks as it is made goes on to touch: steps are chosen for it too.
  limits_ = std::make_unique<StepLimits>(resistance());
  if (options.time_step == 0.0) chooser_ = std::make_unique<StepChooser>(resistance(), *limits_);
  // The first look at the contacts: histories are empty, so nothing is changed by it.
  yielding_bonds_.advance(*bonds_, scene_.state, 0.0, pool_);
  yielding_bonds_.forget_dissipated();
  sheet_facets_->advance(scene_.state, 0.0, pool_);
  sheet_facets_->tear(scene_.state.position, pool_);
  sheet_facets_->forget_dissipated();
  follow_breaks();
  bonds_->advance(scene_.state, pool_);
  ties_.advance(scene_.state.position);
  ties_.forget_dissipated();
  contacts_->advance(scene_.state.motion(), scene_.planes, 0.0, pool_, forces_);
  // The first step is chosen for what the forces do to all nodes, also those of other ranks.
  nodes_.found_forces();
  nodes_.know_all();
  bonds_->add_forces(forces_, pool_);
  ties_.add_forces(forces_);
  sheet_facets_->add_forces(forces_, pool_);
  loads_->add_driving_forces(time_, scene_.state, forces_, pool_);
  set_first_step(options.time_step);
  forces_.set_zero();
  initial_moment_ = free_moment(0.0);
  const double kinetic = moving_energy();
  ledger_.start(kinetic, kinetic + contacts_->elastic_energy() + bonds_->elastic_energy() +
                             ties_.elastic_energy() + sheet_facets_->elastic_energy());
}

/// @param asked  s; 0: chosen
/// @throws std::invalid_argument if that is too long
void Simulation::set_first_step(double asked) {
  const bool is_chosen = chooser_ != nullptr;
  const std::size_t pieces = is_chosen ? 1 : kPieces;
  NodalStiffness space((scene_.state.size() + pieces - 1) / pieces, &scene_.properties,
                       &rigid_nodes_);
  initial_stiffness_ = limits_->total_stiffness(space);
  const double critical = limits_->critical(space, scene_.state.position).dt;
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
  require_own_force(nodes, force, rigid_nodes_, scene_.state.size());
  nodes_.act_on(nodes);
  loads_->add(std::move(nodes), std::move(force));
}

void Simulation::set_force(std::size_t load, const Vec3& force, const Vec3& torque) {
  loads_->set_force(load, force, torque);
}

void Simulation::set_pressure(std::size_t load, double pressure) {
  loads_->set_pressure(load, pressure);
  if (chooser_ != nullptr) chooser_->look_again();
}

void Simulation::set_servo(std::size_t load, double force, double pressure) {
  driven_planes_.set_target(load, force, pressure);
  scene_.loads.servos[load] = driven_planes_.servos()[load];
}

void Simulation::set_body_servo(std::size_t load, double target, double pressure) {
  driven_bodies_.set_target(load, target, pressure);
  scene_.loads.body_servos[load] = driven_bodies_.servos()[load];
}

void Simulation::set_plane_velocity(std::size_t plane, const Vec3& velocity) {
  require_index("set_plane_velocity", "plane", plane, scene_.planes.size());
  driven_planes_.set_velocity(plane, velocity);
  if (chooser_ != nullptr) chooser_->look_again();
}

double Simulation::motion_ratio() const {
  if (!may_touch_) return 0.0;
  nodes_.know_all();
  return largest_speed(scene_.state) * dt_ / pace_radius_;
}

Resistance Simulation::resistance() const noexcept {
  return {scene_,         surface_, *contacts_, *bonds_,     yielding_bonds_,
          *sheet_facets_, ties_,    *loads_,    rigid_nodes_};
}

/// @param dt  s, the longest step before the look; infinite: the first one is to be chosen
Pace Simulation::pace(double dt) const noexcept {
  const TimeSpan until_next_look{time_, time_ + longest_to_next_look(dt)};
  return {steps_,
          std::max({largest_speed(scene_.state), loads_->largest_speed(until_next_look),
                    driven_planes_.largest_speed_of_others(scene_.planes),
                    driven_planes_.largest_speed(until_next_look), driven_bodies_.largest_speed()}),
          largest_gravity()};
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
      step.external -= lengths.kick * contacts_->on_plane(i).force.dot(velocity);
  }
  step.external -= lengths.kick * power_on_turning_;
  for (std::size_t i = 0; i < plane_reactions_.size(); ++i)
    step.external -= lengths.kick * plane_reactions_[i].push * scene_.planes[i].widening;
  const LoadWork left = loads_->work_after({time_, last_drift_, drift_}, scene_.state, pool_);
  ledger_.book(step, lengths, left, last_drift_ == 0.0);
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
  Energy energy = ledger_.energy();
  energy.contact_elastic = contacts_->elastic_energy();
  energy.bond_elastic = bonds_->elastic_energy() + ties_.elastic_energy();
  energy.sheet_elastic = sheet_facets_->elastic_energy();
  // Kinetic and elastic energy are those at the moment of the last forces, one step before the
  // positions.
  energy.gravity = -motion_.gravity.dot(free_moment(last_drift_) - initial_moment_);
  energy.friction = contacts_->dissipated();
  energy.tracking += contacts_->tracking_loss();
  energy.bond_dissipated = energy.bond_dissipated + yielding_bonds_.dissipated() +
                           sheet_facets_->dissipated() + ties_.dissipated();
  energy.rounding = rounding_energy({scene_.state, scene_.properties, forces_, full_gravity_,
                                     initial_stiffness_, last_drift_, steps_});
  return energy;
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
  power_on_turning_ = power_on_turning(*contacts_, scene_.planes);
  nodes_.found_forces();
}

void Simulation::choose_step() {
  nodes_.know_all();
  dt_ = chooser_->choose(dt_, pace(std::max(dt_, chooser_->last_chosen())));
}

/// @param longest  s, the step is not longer
void Simulation::advance(double longest) {
  require_time_step();
  asked_breaks_.break_all(*bonds_, *sheet_facets_, scene_.state, last_drift_, ledger_);
  yielding_bonds_.advance(*bonds_, scene_.state, last_drift_, pool_);
  sheet_facets_->advance(scene_.state, last_drift_, pool_);
  sheet_facets_->tear(scene_.state.position, pool_);
  follow_breaks();
  find_contacts();
  if (chooser_ != nullptr && chooser_->is_due(steps_, dt_, fastest_spin_)) choose_step();
  drift_ = std::min(dt_, longest);
  bonds_->advance(scene_.state, pool_);
  bonds_->add_forces(forces_, pool_);
  ties_.advance(scene_.state.position);
  ties_.add_forces(forces_);
  sheet_facets_->add_forces(forces_, pool_);
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
  if (fastest_ * drift_ <= least_furthest_ && fastest_spin_ * drift_ < std::numbers::pi) return;
  nodes_.know_all();
  if (const auto runaway =
          find_runaway(scene_.state, furthest_in_a_step(scene_, largest_radius_), drift_))
    throw Diverged(*runaway, steps_, time_, scene_.state,
                   fault_finder().fault(*runaway, {last_drift_, drift_, chooser_ != nullptr},
                                        ledger_.suspect()));
}

/// Energy is made where motion is: the ledger is looked at when the kinetic energy has doubled, and
/// now and then, for what has gone into friction at once.
void Simulation::watch_energy() {
  constexpr std::int64_t kStepsBetweenLedgers = 1024;
  if (ledger_.has_doubled() || steps_ % kStepsBetweenLedgers == 0) check_energy();
}

void Simulation::check_energy() {
  const Energy now = energy();
  const double made = std::max(now.made(), -now.kinetic);
  const double accounted = ledger_.look(now);
  const double plane_speed = std::max(driven_planes_.largest_speed(),
                                      fastest_on_planes(scene_.planes, scene_.state.position));
  // What starts from rest under a load has its first kinetic energy, a negative one, as initial.
  const double there = accounted + std::abs(now.initial) +
                       prescribed_energy(scene_.state, scene_.properties, plane_speed);
  if (made <= std::max(now.rounding, there)) return;
  const Divergence divergence{Divergence::Sign::energy,
                              most_energetic(scene_.state, scene_.properties), made, there};
  // What makes the energy need not act any more when it has become too much.
  FaultFinder finder = fault_finder();
  const std::string suspect =
      finder.strongest_action(divergence, state_before(scene_.state, last_drift_));
  if (!suspect.empty()) ledger_.set_suspect(suspect);
  // A comparison with NaN is false.
  if (made <= kFarMore * there) return;
  // Where next to nothing moves yet, as in the first steps under a load, what steps cut off is many
  // times the energy there is. All of it in one node would not take that further between two looks
  // than anything may go in a step: nobody could see it.
  const double speed = std::sqrt(2.0 * made / scene_.properties.mass[index_of(divergence.node)]);
  const double way = static_cast<double>(kStepsBetweenLooks) * speed * last_drift_;
  if (way <= finder.furthest(divergence.node)) return;
  throw Diverged(
      divergence, std::max<std::int64_t>(0, steps_ - 1), time_ - last_drift_, scene_.state,
      finder.fault(divergence, {last_drift_, last_drift_, chooser_ != nullptr}, ledger_.suspect()));
}

/// Before loads are added. With springs of stiffness k_i that have the energies e_i, the forces add
/// up to no more than sqrt(2 sum k_i sum e_i) (Cauchy-Schwarz): what bodies carry in balance. To add
/// up the energies costs much of a step: the ones of some looks stand for those of all.
void Simulation::watch_momentum() {
  constexpr std::int64_t kLooks = 32;
  double carried = 0.0;
  if (steps_ % (kLooks * MomentumBalance::kStepsBetweenLooks) == 0) {
    const double elastic = std::abs(contacts_->elastic_energy()) + bonds_->elastic_energy() +
                           sheet_facets_->elastic_energy() + ties_.elastic_energy();
    carried = kLooks * std::sqrt(2.0 * initial_stiffness_.translation * elastic);
  }
  momentum_.look({scene_.state.position, forces_, *contacts_, scene_.planes, ties_, carried,
                  0.5 * (last_drift_ + drift_), nodes_.shared()},
                 pool_);
}

FaultFinder Simulation::fault_finder() {
  nodes_.know_all();
  return {resistance(), *limits_, scene_.state, forces_, largest_radius_, pool_};
}

// Loads.

/// m/s², at any time.
double Simulation::largest_gravity() const noexcept {
  return scene_.loads.gravity_factor.largest() * full_gravity_.norm();
}

void Simulation::apply_loads() {
  follow_gravity();
  loads_->look_at(yielding_bonds_);
  if (loads_->may_look_at_all()) nodes_.know_all();
  const LoadStep step{time_, last_drift_, drift_};
  LoadWork work = loads_->add_forces(step, scene_.state, forces_, pool_);
  rigid_bodies_.gather(scene_.state, forces_, scene_.properties, pool_);
  loads_->move(step, scene_.state, forces_, pool_, work);
  ledger_.add_external(work.external);
  ledger_.add_damped(work.damped);
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
  ledger_.add_external(
      driven_bodies_.act(step, felt, forces_, rigid_nodes_, scene_.planes, scene_.state, look_at));
}

/// None where nothing asks for them.
void Simulation::find_plane_reactions() {
  plane_reactions_.clear();
  const auto widens = [](const contact::Plane& plane) { return plane.widening != 0.0; };
  if (driven_planes_.empty() && std::ranges::none_of(scene_.planes, widens)) return;
  for (std::size_t i = 0; i < scene_.planes.size(); ++i)
    plane_reactions_.push_back({contacts_->on_plane(i).force, contacts_->on_plane(i).push});
}

void Simulation::drive_planes() {
  places_ahead_.clear();
  const auto press = [&](std::size_t plane, double way, ServoTime when) {
    if (when == ServoTime::after_drift && places_ahead_.empty()) find_places_ahead();
    const geometry::Positions x =
        when == ServoTime::now ? geometry::Positions(scene_.state.position) : places_ahead_;
    return press_on_plane(*contacts_, scene_.planes, plane, way, x);
  };
  ledger_.add_external(
      driven_planes_.act({time_, last_drift_, drift_}, plane_reactions_, press, scene_.planes));
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

Vec3 Simulation::acceleration(std::size_t i, const Vec3& gravity) const {
  return free_acceleration(geometry::id_at<NodeId>(i), forces_.force[i], gravity, scene_.properties,
                           rigid_nodes_);
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
  ledger_.add_external(-(gravity - motion_.gravity).dot(mean));
  motion_.gravity = gravity;
}

Vec3 Simulation::free_moment(double before) const {
  return dynamics::free_moment(scene_.state, scene_.properties, before);
}

// What breaks.

void Simulation::break_bond(std::size_t bond) {
  asked_breaks_.ask_bond(bond, bonds_->size());
}

void Simulation::break_cylinder(NodeId a, NodeId b) {
  asked_breaks_.ask_cylinder(a, b, scene_);
}

void Simulation::break_facet(const std::array<NodeId, 3>& nodes) {
  asked_breaks_.ask_facet(nodes, scene_);
}

/// Before the forces of a step: takes out what hangs on the bonds and sheets that break in it,
/// because they yielded, tore or were asked to. Linear in the scene where elements are gone; that
/// step may allocate.
void Simulation::follow_breaks() {
  const bool are_whole = yielding_bonds_.broken().empty() && sheet_facets_->broken().empty();
  if (asked_breaks_.empty() && are_whole) return;
  loads_->follow(*bonds_, *sheet_facets_);
  if (surface_.cell_count() > 0) {
    asked_breaks_.add_broken(yielding_bonds_, *sheet_facets_);
    if (take_out_broken(scene_, asked_breaks_.parts(), *bonds_, *sheet_facets_)) follow_surface();
  }
  asked_breaks_.clear();
}

/// The scene's elements have become fewer. Elastic energies of contacts before and after are
/// compared half a drift ago, for the same reason as those of bonds.
void Simulation::follow_surface() {
  const geometry::Surface before =
      change_surface(surface_.left_with(scene_.elements.cylinders, scene_.elements.facets));
  loads_->follow(geometry::SurfaceChange(before, surface_));
  ties_.follow(scene_.elements);
}

/// Contacts go on where their features are there still.
/// @returns the surface of before
geometry::Surface Simulation::change_surface(geometry::Surface next) {
  nodes_.know_all();
  std::swap(next, surface_);
  contacts_->follow(geometry::SurfaceChange(next, surface_), motion(),
                    positions_before(scene_.state, 0.5 * last_drift_), pool_);
  return next;
}

// What can be read out between steps.

std::vector<Vec3> Simulation::force_positions() const {
  nodes_.know_all();
  return positions_before(scene_.state, last_drift_);
}

Vec3 Simulation::force_point(std::size_t plane) const {
  require_index("force_point", "plane", plane, scene_.planes.size());
  return scene_.planes[plane].point - last_drift_ * scene_.planes[plane].velocity;
}

double Simulation::force_radius(std::size_t plane) const {
  require_index("force_radius", "plane", plane, scene_.planes.size());
  return scene_.planes[plane].radius - last_drift_ * scene_.planes[plane].widening;
}

std::vector<contact::ContactRecord> Simulation::list_contacts() {
  contacts_->assign_ids();
  return contact_rows();
}

std::vector<contact::ContactRecord> Simulation::contact_rows() const {
  std::vector<contact::ContactRecord> rows;
  contacts_->for_each_record(force_positions(),
                             [&](const contact::ContactRecord& row) { rows.push_back(row); });
  return rows;
}

ForceAndMoment Simulation::plane_reaction(std::size_t plane) const {
  require_index("plane_reaction", "plane", plane, scene_.planes.size());
  const contact::PlaneAction& action = contacts_->on_plane(plane);
  return {action.force, action.moment};
}

double Simulation::pressing_on(std::size_t plane) const {
  require_index("pressing_on", "plane", plane, scene_.planes.size());
  const contact::PlaneAction& action = contacts_->on_plane(plane);
  return PlaneReaction{action.force, action.push}.pressing(scene_.planes[plane]);
}

ForceAndMoment Simulation::support_reaction(std::span<const NodeId> nodes,
                                            const Vec3& about) const {
  for (const NodeId node : nodes) require_node("support_reaction", node, scene_.state.size());
  std::vector<NodeId> supported;
  std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(supported),
               [this](NodeId node) { return rigid_nodes_.body_followed_by(node) < 0; });
  const std::vector<Vec3> positions = force_positions();
  return dynamics::support_reaction(
      supported, {positions, forces_, scene_.properties, motion_.gravity}, about);
}

ForceAndMoment Simulation::section_force(std::span<const NodeId> nodes, const Vec3& about) const {
  nodes_.know_all();
  std::vector<char> is_inside(scene_.state.size(), 0);
  for (const NodeId node : nodes) {
    require_node("section_force", node, is_inside.size());
    is_inside[index_of(node)] = 1;
  }
  return dynamics::section_force(is_inside, state_before(scene_.state, last_drift_), *bonds_,
                                 *sheet_facets_, about);
}

double Simulation::unbalanced_force_ratio() const {
  const NodeState then = state_before(state(), last_drift_);
  const LoadedNodesView nodes{then.position, forces_, scene_.properties, motion_.gravity};
  return dynamics::unbalanced_force_ratio(nodes, mean_carried(resistance(), then));
}

std::vector<FacetTraction> Simulation::facet_tractions() {
  NodeForces forces(scene_.state.size());
  contacts_->add_surface_forces(forces, pool_);
  return dynamics::facet_tractions(scene_.elements.facets, forces.force, force_positions());
}

const Vec3& Simulation::gathered_force(std::size_t body) const {
  require_index("gathered_force", "rigid body", body, scene_.rigid_bodies.size());
  return rigid_bodies_.gathered_force(body);
}

const Vec3& Simulation::gathered_torque(std::size_t body) const {
  require_index("gathered_torque", "rigid body", body, scene_.rigid_bodies.size());
  return rigid_bodies_.gathered_torque(body);
}

BondForces Simulation::bond_forces(std::size_t bond) const {
  require_index("bond_forces", "bond", bond, bonds_->size());
  return yielding_bonds_.forces_of(bond, *bonds_, scene_.state);
}

BondStress Simulation::bond_stress(std::size_t bond) const {
  require_index("bond_stress", "bond", bond, bonds_->size());
  return dynamics::bond_stress(bond_forces(bond), scene_.bonds[bond].section);
}

// The state.

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
  bonds_->exchange(archive.group("bonds"));
  yielding_bonds_.exchange(archive.group("yield"));
  sheet_facets_->exchange(archive.group("sheets"));
  if (archive.is_reading()) loads_->follow(*bonds_, *sheet_facets_);
  if (!ties_.empty()) ties_.exchange(archive.group("ties"));
  if (!rigid_bodies_.empty()) rigid_bodies_.exchange(archive.group("rigid_bodies"));
  asked_breaks_.exchange(archive.group("asked_breaks"), bonds_->size(), scene_.state.size());
  exchange_last_step(archive.group("step"));
  exchange_ledger(archive.group("ledger"));
}

void Simulation::exchange_motion(const geometry::StateArchive& archive) {
  nodes_.know_all();
  archive("time", time_);
  archive("steps", steps_);
  exchange_nodes(archive.group("nodes"), scene_.state, forces_);
  exchange_planes(archive.group("planes"), scene_.planes);
  archive("gravity", motion_.gravity);
}

/// What is left of the elements. Contacts and loads go on with it as if all had broken at once.
void Simulation::exchange_elements(const geometry::StateArchive& archive) {
  if (!dynamics::exchange_elements(archive, scene_)) return;
  try {
    follow_surface();
  } catch (const std::invalid_argument& error) {
    throw geometry::StateMismatch(
        std::string("the elements left in the state are none of these: ") + error.what());
  }
}

void Simulation::exchange_last_step(const geometry::StateArchive& archive) {
  archive("drift", drift_);
  archive("last_drift", last_drift_);
  archive("fastest", fastest_);
  archive("fastest_spin", fastest_spin_);
}

/// What the last step found of loads, and what has been set of them since the start.
void Simulation::exchange_loads(const geometry::StateArchive& archive) {
  loads_->exchange(archive);
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
  ledger_.exchange(archive);
  archive("initial_moment", initial_moment_);
  archive("initial_translation", initial_stiffness_.translation);
  archive("initial_rotation", initial_stiffness_.rotation);
  momentum_.exchange(archive.group("momentum"));
  archive("largest_overlap_ratio", largest_overlap_ratio_);
  archive("pass_throughs", pass_throughs_);
  archive("most_crossings", most_crossings_);
}

// How it goes on from another one.

void Simulation::go_on_from(Simulation& before, const SceneChange& change) {
  if (steps_ != 0)
    throw std::logic_error(
        "a simulation goes on from another one before its first step, not after " +
        std::to_string(steps_));
  require_places(before.scene_, scene_, change);
  require_same_structures(before.surface_, change.places.nodes);
  const NodalStiffness::Total stiffness = initial_stiffness_;
  take_state(before, change);
  initial_stiffness_ = stiffness;
  take_contacts(before, change.places);
  ties_.follow(scene_.elements);
  follow_holds(before.scene_, change.places.nodes, scene_, rigid_bodies_);
  if (has_begun()) add_late_starts(before.scene_, change.places.nodes, scene_, late_starts_);
  note_change(before);
  if (chooser_ != nullptr) set_first_step(0.0);
}

/// All that is kept from step to step, but for contacts and how a step is chosen.
void Simulation::take_state(Simulation& before, const SceneChange& change) {
  const bool has_new_nodes = std::count_if(change.places.nodes.begin(), change.places.nodes.end(),
                                           [](std::int32_t node) { return node >= 0; }) !=
                             static_cast<std::ptrdiff_t>(scene_.state.size());
  const std::vector<contact::Plane> planes = scene_.planes;
  const std::vector<std::int32_t> bodies =
      body_places(before.scene_, rigid_nodes_, change.places.nodes);
  const std::array groups{KeptRows{"nodes/", change.places.nodes},
                          KeptRows{"planes/", change.places.planes},
                          KeptRows{"rigid_bodies/", bodies}};
  geometry::StateTree there, here;
  before.exchange_kept(geometry::StateArchive::writer(there));
  exchange_kept(geometry::StateArchive::writer(here));
  const geometry::StateTree state = carried_state(there, std::move(here), groups);
  exchange_kept(geometry::StateArchive::reader(state));
  if (has_new_nodes) fastest_ = std::max(fastest_, largest_speed(scene_.state));
  settle_planes(before.scene_, change, planes, scene_);
}

void Simulation::leave_out_absent() {
  if (scene_.is_absent.empty()) return;
  whole_ = surface_;
  if (erase_absent(scene_)) follow_surface();
}

void Simulation::look_at_contacts(double ago, geometry::FunctionRef<void()> look) {
  nodes_.know_all();
  contacts_then(*contacts_, scene_, ago, pool_, look);
}

/// J, half a drift ago: what comes or goes between two forces has acted on half of the drift between
/// them, so that this loses nothing to second order (trapezoidal rule). What contacts will lose at
/// once, as where friction is less or a plane is gone, is still theirs: it is counted when it is
/// lost. Before the first step what they have is what they will have.
double Simulation::contact_energy_between() {
  double energy = contacts_->elastic_energy();
  if (!has_begun()) return energy;
  const double lost = contacts_->dissipated() + contacts_->tracking_loss();
  look_at_contacts(0.5 * last_drift_, [&] {
    energy =
        contacts_->elastic_energy() + (contacts_->dissipated() + contacts_->tracking_loss() - lost);
  });
  return energy;
}

std::vector<contact::ContactRecord> Simulation::next_contact_rows(
    geometry::FunctionRef<bool(const contact::ContactRecord&)> wants) {
  if (!has_begun())
    throw std::logic_error("the contacts of the first step are those of the start: contact_rows()");
  std::vector<contact::ContactRecord> rows;
  look_at_contacts(0.0, [&] {
    contacts_->for_each_record(scene_.state.position, [&](const contact::ContactRecord& row) {
      if (wants(row)) rows.push_back(row);
    });
  });
  return rows;
}

/// Contacts on the surface as it was, and then what has come and gone of that. Energy that they had
/// stored on what is gone is work from outside, and none that tracking lost. So is what contacts
/// have in this scene and had not in the other: those that come with bodies that touch others at
/// once, and with another stiffness. The ledger is of the moment of the last forces.
void Simulation::take_contacts(Simulation& before, const contact::BodyPlaces& places) {
  const double stored = before.contacts_->elastic_energy();
  const double energy_before = before.contact_energy_between();
  const geometry::Surface whole = whole_ ? *whole_ : surface_;
  const geometry::Surface made = surface_;
  const Scene& there = before.scene_;
  const auto part = [&whole](const geometry::Elements& of) {
    return whole.left_with(of.cylinders, of.facets);
  };
  const bool others = take_elements(there, scene_);
  const bool comes_or_goes = !are_same_there(there, scene_);
  if (others || comes_or_goes) change_surface(part(there.elements));
  contacts_->take_over(*before.contacts_, places, scene_.planes, scene_.state.position, pool_);
  if (comes_or_goes) {
    const double tracking = contacts_->tracking_loss();
    change_surface(part(scene_.elements));
    ledger_.add_taken_out(contacts_->tracking_loss() - tracking);
  }
  if (others) loads_->follow(geometry::SurfaceChange(made, surface_));
  const double from_outside = contact_energy_between() - energy_before;
  ledger_.bring(from_outside, from_outside - (contacts_->elastic_energy() - stored));
}

/// What they move by at this moment is what the state says: none of it comes from anywhere.
void Simulation::put_back_late_starts() {
  nodes_.know_all();
  ledger_.add_external(-late_starts_.put_back(
      {last_drift_, drift_},
      {scene_.state, forces_, scene_.properties, rigid_nodes_, rigid_bodies_, motion_.gravity}));
}

/// Energy that comes or goes with bodies, stiffness and fixity is work from outside. Where weight
/// has no energy is a matter of choice: what comes and goes leaves the energy of weight as it is.
void Simulation::note_change(const Simulation& before) {
  initial_moment_ =
      before.initial_moment_ + (free_moment(last_drift_) - before.free_moment(last_drift_));
  ledger_.bring_kinetic(moving_energy() - before.moving_energy());
}

double Simulation::moving_energy() const {
  return kinetic_energy(scene_.state, scene_.properties) +
         rigid_bodies_.turning_energy(scene_.state, scene_.properties);
}

}  // namespace plekton::dynamics
