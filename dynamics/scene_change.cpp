// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/scene_change.hpp"

#include "dynamics/model/erase_elements.hpp"
#include "dynamics/model/scene_figures.hpp"
#include "dynamics/simulation.hpp"
#include "dynamics/time_step/step_chooser.hpp"
#include "geometry/base/problems.hpp"
#include "geometry/base/state_archive.hpp"
#include "geometry/primitives/node_sets.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <ostream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

namespace plekton::dynamics {
namespace {

using geometry::StateArchive;
using geometry::StateArray;
using geometry::StateMismatch;
using geometry::StateTree;

/// Calls visit(before, now) for all that is in both scenes.
template <class Visit>
void for_each_kept(const std::vector<std::int32_t>& places, Visit&& visit) {
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i] >= 0) visit(i, static_cast<std::size_t>(places[i]));
}

/// Puts the rows of an array over those of another one.
void put_over(const StateArray& before, const std::vector<std::int32_t>& places, StateArray& now) {
  std::visit(
      [&](const auto& from) {
        auto& to = std::get<std::remove_cvref_t<decltype(from)>>(now.numbers);
        const std::size_t columns = now.columns;
        for_each_kept(places, [&](std::size_t i, std::size_t k) {
          std::copy_n(from.data() + i * columns, columns, to.data() + k * columns);
        });
      },
      before.numbers);
}

/// Rows of a group of arrays, and where they are in the other scene.
struct KeptRows {
  std::string_view group;
  const std::vector<std::int32_t>& places;
};

/// The state of another scene with what was before: rows of groups by their places, all else as it
/// was.
StateTree carried(const StateTree& before, StateTree now, std::span<const KeptRows> groups) {
  for (const auto& [name, array] : before.arrays) {
    const auto group =
        std::find_if(groups.begin(), groups.end(),
                     [&, key = &name](const KeptRows& g) { return key->starts_with(g.group); });
    if (group == groups.end())
      now.arrays[name] = array;
    else if (const auto to = now.arrays.find(name); to != now.arrays.end())
      put_over(array, group->places, to->second);
  }
  return now;
}

/// Where the rigid bodies of a scene are among those of another.
std::vector<std::int32_t> body_places(const Scene& before, const RigidNodes& now,
                                      const std::vector<std::int32_t>& nodes) {
  std::vector<std::int32_t> places;
  for (const RigidBody& body : before.rigid_bodies) {
    const std::int32_t node = nodes[index_of(body.node)];
    places.push_back(node < 0 ? -1 : now.body_at(NodeId{node}));
  }
  return places;
}

/// What of each node is held in a scene.
struct Holds {
  std::vector<Held> all;
  std::vector<Held> prescribed;  ///< by loads, which say how it moves
};

Holds holds_of(const Scene& scene) {
  Scene loaded;
  loaded.properties.held.assign(scene.properties.size(), Held::nothing);
  loaded.loads = scene.loads;
  loaded.rigid_bodies = scene.rigid_bodies;
  return {scene.properties.held, held_as_prescribed(std::move(loaded)).properties.held};
}

/// Motions that are held from now on, and those whose load has ended and that are held without it.
Held stopped(std::size_t then, const Holds& before, std::size_t now, const Holds& holds) {
  constexpr auto kBits = [](Held held) { return static_cast<unsigned>(held); };
  const unsigned own_before = kBits(before.all[then]) & ~kBits(before.prescribed[then]);
  const unsigned own = kBits(holds.all[now]) & ~kBits(holds.prescribed[now]);
  return static_cast<Held>((kBits(holds.all[now]) & ~kBits(before.all[then])) |
                           (own & ~own_before));
}

void stop(Held motions, Vec3& velocity, Vec3& spin) {
  for (int axis = 0; axis < 3; ++axis) {
    if (holds_along(motions, axis)) velocity[axis] = 0.0;
    if (holds_about(motions, axis)) spin[axis] = 0.0;
  }
}

/// Of the nodes of structures, which come first in both.
bool are_same_there(const Scene& a, const Scene& b) {
  for (std::size_t i = 0; i < std::min(a.state.size(), b.state.size()); ++i) {
    const auto node = geometry::id_at<NodeId>(i);
    if (a.is_there(node) != b.is_there(node)) return false;
  }
  return true;
}

/// @param elements  as they are made, without what is absent; becomes what is left of them
/// @returns whether any are others than they were made
template <class Element>
bool take_table(const Scene& before, const std::vector<Element>& there,
                const std::vector<contact::MaterialId>& there_materials, const Scene& now,
                std::vector<Element>& elements, std::vector<contact::MaterialId>& materials) {
  geometry::NodeSets<Element{}.nodes.size()> were, made;
  for (const Element& element : there) were.add(element.nodes);
  for (const Element& element : elements) made.add(element.nodes);
  were.sort();
  made.sort();
  std::vector<Element> kept;
  std::vector<contact::MaterialId> kept_materials;
  const auto keep = [&](const Element& element, contact::MaterialId material) {
    kept.push_back(element);
    kept_materials.push_back(material);
  };
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!before.is_there(elements[i].nodes[0]) || were.contains(elements[i].nodes))
      keep(elements[i], materials[i]);
  }
  const std::size_t of_made = kept.size();
  for (std::size_t i = 0; i < there.size(); ++i) {
    if (now.is_there(there[i].nodes[0]) && !made.contains(there[i].nodes))
      keep(there[i], there_materials[i]);
  }
  const bool others = kept.size() != elements.size() || of_made != kept.size();
  elements = std::move(kept);
  materials = std::move(kept_materials);
  return others;
}

/// What moves a plane.
enum class Driver : std::uint8_t { none, motion, servo };

std::vector<Driver> drivers_of(const Scene& scene) {
  std::vector<Driver> drivers(scene.planes.size(), Driver::none);
  for (const PlaneMotion& motion : scene.loads.plane_motions)
    drivers[motion.plane] = Driver::motion;
  for (const PlaneServo& servo : scene.loads.servos) drivers[servo.plane] = Driver::servo;
  return drivers;
}

/// Of the planes of a scene, who drove them in the one before.
std::vector<Driver> drivers_before(const Scene& before, const Scene& now,
                                   const std::vector<std::int32_t>& places) {
  const std::vector<Driver> then = drivers_of(before);
  std::vector<Driver> drivers(now.planes.size(), Driver::none);
  for_each_kept(places, [&](std::size_t i, std::size_t k) { drivers[k] = then[i]; });
  return drivers;
}

/// What the driver of a plane does not set of its pace is as it is made: a motion sets the velocity,
/// a servo that along the normal, or the widening of a container.
void set_rest_of_pace(contact::Plane& plane, const contact::Plane& made, Driver driver,
                      Driver before) {
  const bool is_flat = plane.form == contact::Plane::Form::flat;
  if (driver != Driver::servo) plane.widening = made.widening;
  if (driver == Driver::none || (driver == Driver::servo && !is_flat))
    plane.velocity = made.velocity;
  if (driver == Driver::servo && is_flat && before == Driver::motion)
    plane.velocity =
        made.velocity + (plane.velocity - made.velocity).dot(plane.normal) * plane.normal;
}

/// @param what   as in "nodes"
/// @param there  how many there were
/// @param here   how many there are now
void list_problems(std::string_view what, const std::vector<std::int32_t>& places,
                   std::size_t there, std::size_t here, std::ostream& problems) {
  if (places.size() != there) {
    problems << "go_on_from: places." << what << " has " << places.size() << " entries; expected "
             << there << ", a place among the " << what << " of now for each of before, or -1\n";
    return;
  }
  std::vector<bool> is_taken(here, false);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::int32_t place = places[i];
    if (place == -1) continue;
    const bool is_none = place < 0 || static_cast<std::size_t>(place) >= here;
    if (is_none)
      problems << "go_on_from: places." << what << '[' << i << "] is " << place << "; there are "
               << here << ' ' << what << " now, counted from 0, and -1 is none of them\n";
    else if (is_taken[static_cast<std::size_t>(place)])
      problems << "go_on_from: places." << what << '[' << i << "] is " << place
               << ", as of one before; no two are the same of now\n";
    if (!is_none) is_taken[static_cast<std::size_t>(place)] = true;
  }
}

/// @throws std::invalid_argument listing every problem
void require_places(const Scene& before, const Scene& now, const SceneChange& change) {
  std::ostringstream problems;
  const contact::BodyPlaces& places = change.places;
  list_problems("nodes", places.nodes, before.state.size(), now.state.size(), problems);
  list_problems("spheres", places.spheres, before.elements.spheres.size(),
                now.elements.spheres.size(), problems);
  list_problems("planes", places.planes, before.planes.size(), now.planes.size(), problems);
  if (!change.moved_planes.empty() && change.moved_planes.size() != now.planes.size())
    problems << "go_on_from: moved_planes has " << change.moved_planes.size()
             << " entries; expected " << now.planes.size()
             << ", one for each plane of now, or none\n";
  geometry::throw_if_any(problems);
}

}  // namespace

void Simulation::go_on_from(Simulation& before, const SceneChange& change) {
  if (steps_ != 0)
    throw std::logic_error(
        "a simulation goes on from another one before its first step, not after " +
        std::to_string(steps_));
  require_places(before.scene_, scene_, change);
  require_same_structures(before, change.places);
  take_state(before, change);
  take_contacts(before, change.places);
  ties_.follow(scene_.elements);
  follow_holds(before, change.places);
  if (has_begun()) find_late_starts(before.scene_, change.places);
  note_change(before);
  if (chooser_ != nullptr) set_first_step(0.0);
}

void Simulation::require_same_structures(const Simulation& before,
                                         const contact::BodyPlaces& places) const {
  for (std::size_t node = 0; node < before.surface_.node_count(); ++node) {
    if (before.surface_.structure_of(geometry::id_at<NodeId>(node)) != geometry::StructureId{-1} &&
        places.nodes[node] != static_cast<std::int32_t>(node))
      throw StateMismatch("the nodes of structures have other ids than before");
  }
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
  StateTree there, here;
  before.exchange_kept(StateArchive::writer(there));
  exchange_kept(StateArchive::writer(here));
  const StateTree state = carried(there, std::move(here), groups);
  exchange_kept(StateArchive::reader(state));
  if (has_new_nodes) fastest_ = std::max(fastest_, largest_speed(scene_.state));
  const std::vector<Driver> drivers = drivers_of(scene_);
  const std::vector<Driver> then = drivers_before(before.scene_, scene_, change.places.planes);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (!change.moved_planes.empty() && change.moved_planes[i])
      scene_.planes[i] = planes[i];
    else
      set_rest_of_pace(scene_.planes[i], planes[i], drivers[i], then[i]);
  }
}

void Simulation::leave_out_absent() {
  if (scene_.is_absent.empty()) return;
  whole_ = surface_;
  const auto is_absent = [this](const auto& element, contact::MaterialId) {
    return !scene_.is_there(element.nodes[0]);
  };
  const bool are_fewer =
      erase_elements(scene_.elements.facets, scene_.facet_materials, is_absent) |
      erase_elements(scene_.elements.cylinders, scene_.cylinder_materials, is_absent);
  if (are_fewer) follow_surface();
}

/// Calls look() with the contacts as they would be found, and leaves them as they are, whatever it
/// throws.
/// @param ago  s, before now: where nodes and planes were then
template <class Look>
void Simulation::look_ahead(double ago, const Look& look) {
  nodes_.know_all();
  StateTree kept;
  contacts_->exchange(StateArchive::writer(kept), scene_.planes, pool_);
  NodeState state = scene_.state;
  state.position = positions_before(state, ago);
  std::vector<contact::Plane> planes = scene_.planes;
  for (contact::Plane& plane : planes) {
    plane.point -= ago * plane.velocity;
    plane.radius -= ago * plane.widening;
  }
  NodeForces forces(state.size());
  const auto put_back = [&] {
    contacts_->exchange(StateArchive::reader(kept), scene_.planes, pool_);
  };
  try {
    contacts_->advance(state.motion(), planes, 0.0, pool_, forces);
    look();
  } catch (...) {
    put_back();
    throw;
  }
  put_back();
}

/// J, half a drift ago: what comes or goes between two forces has acted on half of the drift between
/// them, so that this loses nothing to second order (trapezoidal rule). What contacts will lose at
/// once, as where friction is less or a plane is gone, is still theirs: it is counted when it is
/// lost. Before the first step what they have is what they will have.
double Simulation::contact_energy_between() {
  double energy = contacts_->elastic_energy();
  if (!has_begun()) return energy;
  const double lost = contacts_->dissipated() + contacts_->tracking_loss();
  look_ahead(0.5 * last_drift_, [&] {
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
  look_ahead(0.0, [&] {
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
  const bool others = take_table(there, there.elements.facets, there.facet_materials, scene_,
                                 scene_.elements.facets, scene_.facet_materials) |
                      take_table(there, there.elements.cylinders, there.cylinder_materials, scene_,
                                 scene_.elements.cylinders, scene_.cylinder_materials);
  const bool comes_or_goes = !are_same_there(there, scene_);
  if (others || comes_or_goes) change_surface(part(there.elements));
  contacts_->take_over(*before.contacts_, places, scene_.planes, scene_.state.position, pool_);
  if (comes_or_goes) {
    const double tracking = contacts_->tracking_loss();
    change_surface(part(scene_.elements));
    taken_out_ += contacts_->tracking_loss() - tracking;
  }
  if (others) loads_.follow(geometry::SurfaceChange(made, surface_));
  const double from_outside = contact_energy_between() - energy_before;
  work_.external += from_outside;
  pending_.external += from_outside - (contacts_->elastic_energy() - stored);
}

/// Rigid bodies that are held in another way turn from now on as they move now; the others to the
/// last bit as before.
void Simulation::follow_holds(const Simulation& before, const contact::BodyPlaces& places) {
  const Holds holds_before = holds_of(before.scene_);
  const Holds holds = holds_of(scene_);
  for_each_kept(places.nodes, [&](std::size_t then, std::size_t now) {
    const Held stopping = stopped(then, holds_before, now, holds);
    const Held was = holds_before.all[then], is = holds.all[now];
    if (was == is && stopping == Held::nothing) return;
    stop(stopping, scene_.state.velocity[now], scene_.state.angular_velocity[now]);
    const auto node = geometry::id_at<NodeId>(now);
    const bool turns_on = (was & Held::rotation) == (is & Held::rotation) &&
                          (stopping & Held::rotation) == Held::nothing;
    if (turns_on)
      rigid_bodies_.go_on_turning_from(node, scene_.state, scene_.properties);
    else
      rigid_bodies_.start_from(node, scene_.state, scene_.properties);
  });
}

/// What was not there, and what was held along an axis, or moved as told, and is free now.
void Simulation::find_late_starts(const Scene& before, const contact::BodyPlaces& places) {
  std::vector<Held> held_before(scene_.state.size(), Held::everything);
  for_each_kept(places.nodes, [&](std::size_t then, std::size_t now) {
    if (before.is_there(geometry::id_at<NodeId>(then)))
      held_before[now] = before.properties.held[then];
  });
  for (std::size_t i = 0; i < scene_.state.size(); ++i) {
    const auto node = geometry::id_at<NodeId>(i);
    const auto was = static_cast<unsigned>(held_before[i] & Held::everything);
    const auto is = static_cast<unsigned>(scene_.properties.held[i]);
    if (scene_.is_there(node)) late_starts_.add(node, static_cast<Held>(was & ~is));
  }
}

/// What they move by at this moment is what the state says: none of it comes from anywhere.
void Simulation::put_back_late_starts() {
  nodes_.know_all();
  work_.external -= late_starts_.put_back(
      {last_drift_, drift_},
      {scene_.state, forces_, scene_.properties, rigid_nodes_, rigid_bodies_, motion_.gravity});
}

/// Energy that comes or goes with bodies, stiffness and fixity is work from outside. Where weight
/// has no energy is a matter of choice: what comes and goes leaves the energy of weight as it is.
void Simulation::note_change(const Simulation& before) {
  initial_moment_ =
      before.initial_moment_ + (free_moment(last_drift_) - before.free_moment(last_drift_));
  const double kinetic = moving_energy() - before.moving_energy();
  work_.kinetic += kinetic;
  work_.external += kinetic;
}

double Simulation::moving_energy() const {
  return kinetic_energy(scene_.state, scene_.properties) +
         rigid_bodies_.turning_energy(scene_.state, scene_.properties);
}

}  // namespace plekton::dynamics
