// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contact_model.hpp"
#include "dynamics/asked_breaks.hpp"
#include "dynamics/carry_over/late_starts.hpp"
#include "dynamics/carry_over/scene_change.hpp"
#include "dynamics/checkpoint/checkpoint_error.hpp"
#include "dynamics/integrators/nodes_of_ranks.hpp"
#include "dynamics/loads/own_force.hpp"
#include "dynamics/loads/plane_servo.hpp"
#include "dynamics/loads/rigid_servo.hpp"
#include "dynamics/measures/bond_stress.hpp"
#include "dynamics/measures/diverged.hpp"
#include "dynamics/measures/energy_ledger.hpp"
#include "dynamics/measures/facet_traction.hpp"
#include "dynamics/measures/momentum_balance.hpp"
#include "dynamics/measures/reactions.hpp"
#include "dynamics/model/scene.hpp"
#include "dynamics/rigid/rigid_bodies.hpp"
#include "dynamics/simulation_options.hpp"
#include "dynamics/state/rigid_nodes.hpp"
#include "dynamics/stiffness/nodal_stiffness.hpp"
#include "dynamics/structure/yielding_bonds.hpp"
#include "dynamics/ties/ties.hpp"
#include "dynamics/time_step/exact_step.hpp"
#include "dynamics/time_step/motion_step.hpp"
#include "dynamics/time_step/step_cause.hpp"
#include "geometry/base/function_ref.hpp"
#include "geometry/base/state_tree.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace plekton::dynamics {

class AppliedLoads;
class BeamBonds;
class FaultFinder;
class SheetFacets;
class StepChooser;
class StepLimits;
struct Pace;
struct Resistance;

/// A scene in motion. The state belongs to the simulation; what is given out are views of it.
///
/// Simulations have nothing in common: each may be used in a thread of its own, one thread at a time
/// (saving and loading wait for each other, as most builds of the HDF5 library are for one thread).
///
/// Several processes may compute one scene (contact::among_ranks): all make the same calls in the
/// same order and get the same answers. A view is of now; after a step it has to be asked for anew.
///
/// Every call that takes a node, bond, plane, rigid body or load checks its id, and throws
/// std::out_of_range with the call, the id and how many there are.
class Simulation {
 public:
  /// @throws std::invalid_argument listing every problem of the scene, or of the options and the
  ///         model, among them a time step above kLargestStep of the critical one
  /// @param scene  is copied in the library, not in what includes this and would compile for longer
  /// @param model  which contact law there is
  Simulation(const Scene& scene, const SimulationOptions& options,
             const contact::ContactModel& model = contact::linear_frictional());
  /// @param scene  is taken over
  Simulation(Scene&& scene, const SimulationOptions& options,
             const contact::ContactModel& model = contact::linear_frictional());
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  ~Simulation();

  /// One time step. @throws Diverged; std::logic_error if none was given where nothing sets one; what
  /// a force of one's own throws. The step is half done then: but for the logic_error, the simulation
  /// can be looked at and is to be thrown away, or made anew and loaded from a snapshot of before.
  void step() { advance(std::numeric_limits<double>::infinity()); }
  /// One time step on the way to a time. The last kStepsBetweenLooks before it are equally long, as
  /// long as ends there: what swings fast would change its energy by as much as a single step
  /// differs from those before it. The next step() is as long as chosen or given again. A rest of a
  /// thousandth of a step, as rounding leaves it, is left out, but there is one step at least.
  /// @param end  s; nothing is done if it is not a number
  /// @throws as step()
  /// @returns whether there was any time left; nothing is done without
  bool step_until(double end);

  /// Breaks a bond for good, in the next step: it carries nothing any more, and the elements it
  /// held are gone from elements() and surface() (broken_elements.hpp). Nothing touches
  /// them then; contacts on what is left go on with their histories. Masses stay with the nodes, so
  /// no momentum is lost; what the bond had stored is counted as dissipated, and what contacts had
  /// as lost in tracking.
  ///
  /// A structure may fall apart: its pieces keep its material, and touch each other as a structure
  /// touches itself, if options said so, and not where they were near along edges at rest. A node
  /// that has lost its last element goes on moving with its mass; it touches nothing but planes, as
  /// a ball of the radius it had.
  /// @param bond  by its place in Scene::bonds; broken already: no effect
  void break_bond(std::size_t bond);
  /// Breaks a cylinder, with all bonds between its nodes, likewise. Along a side of a facet it
  /// tears that as a broken bond does.
  /// @throws std::invalid_argument if there is no cylinder between these nodes
  void break_cylinder(NodeId a, NodeId b);
  /// Tears a facet, with the facet of a sheet on the same nodes, likewise. Its sides stay as
  /// cylinders where bonds hold them.
  /// @throws std::invalid_argument if there is no facet on these nodes
  void break_facet(const std::array<NodeId, 3>& nodes);

  /// s.
  double time() const noexcept { return time_; }
  std::int64_t steps() const noexcept { return steps_; }
  /// s; infinite if none was given and nothing in the scene sets one.
  double time_step() const noexcept { return dt_; }
  /// @param dt  s, > 0, from the next step on; from then on it is not chosen any more. It is not
  ///            compared with critical_step(), above which energies grow
  /// @throws std::invalid_argument if it is not positive and finite
  void set_time_step(double dt);

  /// What it is made of, in its present state.
  const Scene& scene() const {
    nodes_.know_all();
    return scene_;
  }
  const NodeState& state() const { return scene().state; }
  /// The velocities of held nodes may be set between steps, unless a motion is prescribed for them
  /// (Scene::loads), and those of the reference nodes of rigid bodies, which take their nodes along.
  /// Of a node that is free its kinetic energy changes so without work in the ledger.
  /// @param velocity, angular_velocity  m/s, rad/s
  /// @throws std::invalid_argument for a node that follows a rigid body, or a velocity that is not
  ///         finite
  void set_velocity(NodeId node, const Vec3& velocity, const Vec3& angular_velocity = Vec3::Zero());
  /// Adds a force of one's own to the loads, asked for in every step from the next one on
  /// (loads/own_force.hpp); its work is external. The time step knows nothing of it: one that grows
  /// stiffly with places or velocities needs a step that follows it. It is no part of the state: add
  /// it again after restore().
  /// @param nodes  each once; none that follows a rigid body
  /// @throws std::invalid_argument for a node twice, or of a rigid body, and without a function
  void add_force(std::vector<NodeId> nodes, OwnForce force);
  /// Changes a load, from the next step on, by its place in Loads::forces; its factor goes on.
  /// It is part of the state from then on, and forgotten by go_on_from().
  /// @param force, torque  N, N m
  /// @throws std::invalid_argument for a force or torque that is not finite
  void set_force(std::size_t load, const Vec3& force, const Vec3& torque = Vec3::Zero());
  /// The same by its place in Loads::pressures. A step that was chosen follows; one that was given
  /// does not. @param pressure  Pa
  /// @throws std::invalid_argument for one by volume, or a pressure that is not finite
  void set_pressure(std::size_t load, double pressure);
  /// The same of a plane servo, by its place in Loads::servos: with force + pressure area from then
  /// on (N, Pa). @throws std::invalid_argument for targets that are not finite, below 0, or both 0
  void set_servo(std::size_t load, double force, double pressure = 0.0);
  /// The same by its place in Loads::body_servos. @param target  N, or N m of one that turns, which
  /// has no pressure, and a torque that is not 0
  void set_body_servo(std::size_t load, double target, double pressure = 0.0);
  /// The velocity (m/s) of a plane that no load moves, from the next step on. A step that was given
  /// does not follow.
  /// @throws std::invalid_argument for a plane that a load moves, or a velocity that is not finite
  void set_plane_velocity(std::size_t plane, const Vec3& velocity);
  const NodeProperties& properties() const noexcept { return scene_.properties; }
  /// Those that are left; nodes keep their ids.
  const geometry::Elements& elements() const noexcept { return scene_.elements; }
  const geometry::Surface& surface() const noexcept { return surface_; }
  const std::vector<contact::Plane>& planes() const noexcept { return scene_.planes; }
  /// All beams: dynamics/structure/beam_bonds.hpp, to be included by those who ask them.
  const BeamBonds& bonds() const noexcept { return *bonds_; }
  /// The bonds that yield or break, and which of them broke in the last step.
  const YieldingBonds& yielding_bonds() const noexcept { return yielding_bonds_; }
  /// What a bond carries where its nodes are now.
  BondForces bond_forces(std::size_t bond) const;
  const SheetFacets& sheet_facets() const noexcept { return *sheet_facets_; }
  /// By place in Scene::ties: what they carry, have slid and taken.
  const Ties& ties() const noexcept { return ties_; }
  /// By place in Scene::rigid_bodies: their angular momenta.
  const RigidBodies& rigid_bodies() const noexcept { return rigid_bodies_; }
  const AppliedLoads& loads() const noexcept { return *loads_; }
  const contact::Contacts& contacts() const noexcept { return *contacts_; }
  /// N, N m, of contacts, bonds, ties, sheets and loads in the last step, gravity not included; of
  /// the reference node of a rigid body with those on all that follow it. 0 before the first step.
  const NodeForces& forces() const {
    nodes_.know_all();
    return forces_;
  }

  /// m/s², in the last step.
  const Vec3& gravity() const noexcept { return motion_.gravity; }

  /// m, where the nodes were when the forces of the last step were found: a drift before now.
  std::vector<Vec3> force_positions() const;
  /// m, where the point of a plane was then.
  Vec3 force_point(std::size_t plane) const;
  /// m, the radius of a container then.
  double force_radius(std::size_t plane) const;
  /// All contacts of the last step with all that they did to the nodes. Those that have no number
  /// get one (contact::Contacts::assign_ids).
  std::vector<contact::ContactRecord> list_contacts();
  /// The same without giving numbers.
  std::vector<contact::ContactRecord> contact_rows() const;
  /// Those that the next step will find where the nodes are now, some of which may not have been
  /// there in the last one. Takes about as long as a step and a snapshot.
  /// @param wants  which of them; what it throws leaves the simulation as it was
  /// @throws std::logic_error before the first step, whose contacts are those of contact_rows()
  std::vector<contact::ContactRecord> next_contact_rows(
      geometry::FunctionRef<bool(const contact::ContactRecord&)> wants);
  /// N, how hard bodies press on a flat plane against its normal, or on a container all around.
  double pressing_on(std::size_t plane) const;
  /// What bodies do to a plane, about force_point(plane).
  ForceAndMoment plane_reaction(std::size_t plane) const;
  /// What the supports of nodes bear: measures/reactions.hpp. Of grains, membranes and any other
  /// bodies contact_force_on() there tells what contacts do to them. A rigid body is supported where
  /// its reference node is held, which bears what acts on all of its nodes; these count for nothing
  /// by themselves.
  /// @param about  m, point of the moment
  ForceAndMoment support_reaction(std::span<const NodeId> nodes, const Vec3& about) const;
  /// What a section carries that cuts some nodes from all others: what beams and sheets across it do
  /// to these nodes in the last step. Of the nodes beyond the place where a cable is cut it is the
  /// pull of the rest. Torn elements carry nothing. Linear in the number of nodes and elements.
  /// @param about  m, point of the moment
  /// @throws std::out_of_range for nodes that are none
  ForceAndMoment section_force(std::span<const NodeId> nodes, const Vec3& about) const;
  /// N, of all that acts on the nodes of a rigid body in the last step (contacts, ties, bonds,
  /// sheets, pressure), but for what loads do to its reference node; by place in
  /// Scene::rigid_bodies. 0 before the first step, also of a state that was restored.
  const Vec3& gathered_force(std::size_t body) const;
  /// N m, the torque of these about the centre of mass.
  const Vec3& gathered_torque(std::size_t body) const;
  /// How far from balance the last step was: measures/unbalanced_force.hpp. Like all reading out it
  /// costs nothing until it is asked for; then time linear in the number of nodes and contacts.
  double unbalanced_force_ratio() const;
  /// What contacts did to the facets in the last step: measures/facet_traction.hpp.
  std::vector<FacetTraction> facet_tractions();
  /// Of a bond as its nodes are now.
  BondStress bond_stress(std::size_t bond) const;

  Energy energy() const;
  /// Looks whether far more energy has come from nowhere than there ever was. step() does so when
  /// the kinetic energy has doubled, and now and then; at the end of a run it is for the caller.
  /// @throws Diverged naming the contact or element that acts most where most of it is
  void check_energy();
  /// How far the balance of momentum has been off at most (measures/momentum_balance.hpp): no more
  /// than rounding.
  MomentumDrift momentum_drift() const noexcept { return momentum_.drift(); }
  /// Largest overlap of any step so far over a radius: of the smaller of two spheres, of the sphere
  /// on a surface or plane, of the thinner of two structures.
  double largest_overlap_ratio() const noexcept { return largest_overlap_ratio_; }
  /// How often so far a sphere's centre went through a facet or a cylinder: its overlap was deeper
  /// than both radii. From then on it is pushed out on the other side.
  std::int64_t pass_throughs() const noexcept { return pass_throughs_; }
  /// The most pairs of facets and cylinders whose cores crossed in a step: structures that went
  /// into each other by more than both radii. They are pushed apart along the shortest way.
  std::size_t most_crossings() const noexcept { return most_crossings_; }
  /// Critical time step: of the structures and contacts as they are now, or with the contacts that
  /// may come, whichever is shorter.
  CriticalStep critical_step() const;
  /// The same of the structures and contacts as they are now alone: what a chosen step keeps to.
  CriticalStep present_critical_step() const;
  /// What the present step has to keep to: a given one to contacts that may come too.
  CriticalStep limit_of_step() const {
    return chooses_time_step() ? present_critical_step() : critical_step();
  }
  /// Whether the step is chosen as it goes, and not given.
  bool chooses_time_step() const noexcept { return chooser_ != nullptr; }
  /// What limits critical_step().
  StepCause critical_cause() const;
  /// Critical time step of the structures and contacts as they are now, by the frequencies of the
  /// scene as a whole (exact_step.hpp). Contacts between structures count with what holds each of
  /// their nodes by itself, and ones in a concave crease are all counted: there it may be too
  /// short.
  ExactStep exact_critical_step() const;
  /// How far the fastest node moves in a step over the smallest radius: of the spheres, or of the
  /// structures if there are none. Above kLargestMotion (dynamics/time_step/motion_step.hpp)
  /// contacts are seen late; a chosen step keeps below that, a given one may not. 0 of one structure
  /// alone that may not touch itself; not a number where time_step() is infinite.
  double motion_ratio() const;

  // The state, to go on from later or elsewhere.

  /// All that decides how the simulation goes on, and what can be read out of its last step but for
  /// gathered_force() and gathered_torque(), as plain numbers in an order that does not depend on
  /// threads. It changes nothing; linear in the scene and its contacts.
  geometry::StateTree snapshot();
  /// Goes on from a state: from here on every bit is as it was there, with any number of threads.
  /// To be called before the first step of a simulation of the same scene, materials and laws; its
  /// loads may be other ones of the same kinds. Those that have been set there go on so, by place.
  /// @throws std::logic_error after the first step
  /// @throws geometry::StateMismatch if the state is of another scene, or damaged, or its step was
  ///         chosen and this one's is given, or loads move other planes: the simulation can only be
  ///         thrown away then
  void restore(const geometry::StateTree& state);
  /// The same, to and from an HDF5 file with a data set for every array of the state. load() refuses
  /// a file of another version of them, and one in which a bit has changed.
  /// @throws OutputError of save(); CheckpointError, and as restore(), of load()
  void save(const std::filesystem::path& file);
  void load(const std::filesystem::path& file);

  /// Goes on from where another simulation is, in a scene with some of the same bodies: with other
  /// loads, planes, numbers of materials and laws, fixities and spheres. What contacts remember of
  /// bodies that stay goes on, so that no force jumps where nothing changed; time and steps go on
  /// counting. Spheres that stay keep their order. Energy that comes or goes with bodies and
  /// stiffness counts as external work; weight as if it had no energy when it came or went.
  /// To be called before the first step. A step that is chosen is chosen anew, and is not longer
  /// than that of the scene as it was made until it has grown.
  /// @throws std::logic_error after the first step
  /// @throws std::invalid_argument for places that are none: nothing is changed then
  /// @throws geometry::StateMismatch if structures or laws are others: the simulation can only be
  ///         thrown away then
  void go_on_from(Simulation& before, const SceneChange& change);

 private:
  void advance(double longest);
  void find_contacts();
  void choose_step();
  contact::Motion motion() const noexcept;
  void follow_breaks();
  void follow_surface();
  geometry::Surface change_surface(geometry::Surface next);
  void apply_loads();
  void find_plane_reactions();
  void drive_planes();
  void find_places_ahead();
  Vec3 acceleration(std::size_t node, const Vec3& gravity) const;
  void drive_bodies(const LoadStep& step);
  void follow_gravity();
  Vec3 free_moment(double before) const;
  double largest_gravity() const noexcept;
  void account(const StepWork& work, const StepLengths& lengths);
  void check_motion();
  void watch_energy();
  void watch_momentum();
  FaultFinder fault_finder();
  void set_first_step(double asked);
  void foresee_first_kick(double kick);
  void require_time_step() const;
  Resistance resistance() const noexcept;
  Pace pace(double dt) const noexcept;
  void move_planes();
  void exchange(const geometry::StateArchive& archive);
  void exchange_kept(const geometry::StateArchive& archive);
  void exchange_elements(const geometry::StateArchive& archive);
  void exchange_motion(const geometry::StateArchive& archive);
  void exchange_ledger(const geometry::StateArchive& archive);
  void exchange_last_step(const geometry::StateArchive& archive);
  void exchange_loads(const geometry::StateArchive& archive);
  void exchange_step(const geometry::StateArchive& archive);
  void leave_out_absent();
  void look_at_contacts(double ago, geometry::FunctionRef<void()> look);
  bool has_begun() const noexcept { return steps_ > 0; }
  double contact_energy_between();
  void take_contacts(Simulation& before, const contact::BodyPlaces& places);
  void take_state(Simulation& before, const SceneChange& change);
  void put_back_late_starts();
  void note_change(const Simulation& before);
  double moving_energy() const;

  Scene scene_;
  std::uint64_t scene_hash_;  ///< as it was given
  MotionOptions motion_;
  geometry::ThreadPool pool_;
  geometry::Surface surface_;
  std::optional<geometry::Surface> whole_;  ///< with what is absent, if anything is
  RigidNodes rigid_nodes_;
  RigidBodies rigid_bodies_;
  LateStarts late_starts_;  ///< in the next step
  std::unique_ptr<contact::Contacts> contacts_;
  std::unique_ptr<BeamBonds> bonds_;
  YieldingBonds yielding_bonds_;
  std::unique_ptr<SheetFacets> sheet_facets_;
  Ties ties_;
  std::unique_ptr<AppliedLoads> loads_;
  DrivenPlanes driven_planes_;
  DrivenBodies driven_bodies_;
  BodyPress body_press_;                        ///< working space, to drive bodies
  std::vector<PlaneReaction> plane_reactions_;  ///< of planes that are driven or widen; else none
  std::vector<Vec3> places_ahead_;              ///< m, of nodes; to drive planes
  double power_on_turning_ = 0.0;  ///< W, what bodies do to planes that turn, at the last forces
  AskedBreaks asked_breaks_;       ///< in the next step
  NodeForces forces_;
  NodesOfRanks nodes_;
  std::unique_ptr<StepLimits> limits_;
  std::unique_ptr<StepChooser> chooser_;  ///< none if the step was given
  double dt_ = 0.0;
  double drift_ = 0.0;       ///< s, length of the drift under way
  double last_drift_ = 0.0;  ///< s, length of the last step; 0 before the first
  double time_ = 0.0;
  std::int64_t steps_ = 0;
  double fastest_ = std::numeric_limits<double>::infinity();  ///< m/s, after the last step
  double fastest_spin_ = 0.0;                                 ///< rad/s, after the last step
  double largest_radius_;                                     ///< m, at the start
  double least_furthest_ = 0.0;  ///< m, what any node may move in a step
  double pace_radius_ = 0.0;     ///< m, against which the motion in a chosen step is measured
  bool may_touch_ = true;
  EnergyLedger ledger_;
  Vec3 full_gravity_;                        ///< m/s², of which motion_.gravity is a part
  Vec3 initial_moment_ = Vec3::Zero();       ///< kg m, free moment at the start
  NodalStiffness::Total initial_stiffness_;  ///< with the contacts that may come
  MomentumBalance momentum_;
  double largest_overlap_ratio_ = 0.0;
  std::int64_t pass_throughs_ = 0;
  std::size_t most_crossings_ = 0;
};

}  // namespace plekton::dynamics
