// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/scene_contacts.hpp"

#include "contact/surface_surface/mean_node_masses.hpp"
#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace plekton::contact {
namespace {

/// Structures are thinner than grains are wide: with the grains' skin a net would list half of
/// itself.
double skin_of_structures(const geometry::Surface& surface, double skin) {
  for (std::size_t i = 0; i < surface.structure_count(); ++i) {
    skin = std::min(skin, 0.5 * surface.radius(geometry::id_at<geometry::StructureId>(i)));
  }
  return skin;
}

/// m, over which bodies of a scene may stick to each other; of laws whose reach grows with the
/// radii of both bodies, or with the smaller one's.
double largest_interaction_range(std::span<const geometry::Sphere> spheres,
                                 const geometry::Surface& surface,
                                 const ContactMaterials& materials) {
  if (!materials.pairs.may_act_at_a_distance()) return 0.0;
  std::map<MaterialId, double> largest;  // m, radius of the bodies of a material
  const auto add = [&](MaterialId material, double radius) {
    largest[material] = std::max(largest[material], radius);
  };
  for (std::size_t i = 0; i < spheres.size(); ++i) add(materials.of_spheres[i], spheres[i].radius);
  for (std::size_t i = 0; i < surface.structure_count(); ++i)
    add(materials.of_structures[i], surface.radius(geometry::id_at<geometry::StructureId>(i)));
  double reach = 0.0;
  for (const auto& [material_a, radius_a] : largest) {
    for (std::size_t b = 0; b < materials.pairs.size(); ++b) {
      const auto material_b = geometry::id_at<MaterialId>(b);
      const auto other = largest.find(material_b);
      const double radius_b = other == largest.end() ? radius_a : other->second;
      for (const double radius : {radius_a, radius_b}) {
        reach = std::max(reach, AnyLaw::interaction_range(materials.pairs.combine(
                                    {material_a, radius_a}, {material_b, radius})));
      }
    }
  }
  return reach;
}

/// By StructureId: all its nodes are in a group.
std::vector<char> rigid_structures(const geometry::Surface& surface,
                                   const geometry::ExclusionGroups& groups) {
  std::vector<char> are_rigid(surface.structure_count(), 1);
  for (std::size_t n = 0; n < surface.node_count(); ++n) {
    const auto node = geometry::id_at<NodeId>(n);
    const auto structure = surface.structure_of(node);
    if (structure != geometry::StructureId{-1} && groups.group_of(node) < 0)
      are_rigid[index_of(structure)] = 0;
  }
  return are_rigid;
}

}  // namespace

SceneContacts::SceneContacts(std::span<const geometry::Sphere> spheres,
                             const geometry::Surface& surface, ContactMaterials materials,
                             double skin, const std::vector<bool>& meets_planes, Positions rest,
                             const geometry::ExclusionGroups& groups)
    : materials_(std::move(materials)),
      materials_hash_(materials_.pairs.hash()),
      neighbours_(spheres, surface, skin, largest_interaction_range(spheres, surface, materials_)),
      cell_neighbours_(surface, rest, skin_of_structures(surface, skin), !rest.empty()),
      plane_neighbours_(skin, largest_interaction_range(spheres, surface, materials_)),
      with_surfaces_(surface),
      between_structures_(surface),
      surface_(&surface) {
  neighbours_.leave_out(groups);
  cell_neighbours_.leave_out(groups);
  materials_.structure_masses = structure::mean_node_masses(surface, materials_.masses);
  between_structures_.set_rigid(rigid_structures(surface, groups));
  spheres_.reserve(spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const NodeId node = spheres[i].nodes[0];
    spheres_.push_back({node, spheres[i].radius, materials_.of_spheres[i], groups.group_of(node),
                        materials_.mass_of(node)});
  }
  for (std::size_t n = 0; n < surface.node_count(); ++n) {
    const auto structure = surface.structure_of(geometry::id_at<NodeId>(n));
    if (structure == geometry::StructureId{-1} || (!meets_planes.empty() && !meets_planes[n]))
      continue;
    const NodeId node = geometry::id_at<NodeId>(n);
    spheres_.push_back({node, surface.radius(structure),
                        materials_.of_structures[index_of(structure)], groups.group_of(node),
                        materials_.mass_of(node), structure});
  }
}

void SceneContacts::advance(const Motion& motion, std::span<const Plane> planes, double dt,
                            geometry::ThreadPool& pool, NodeForces& forces) {
  if (start_ == Start::now) end_start(planes, pool);
  if (start_ == Start::ahead) start_ = Start::now;
  const auto was_asked = std::exchange(are_lists_due_, std::nullopt);
  if (was_asked ? *was_asked : look_at_lists(motion, pool)) {
    neighbours_.make(motion.position, pool);
    tracking_loss_ += with_spheres_.rebuild(neighbours_.sphere_pairs(), spheres_, materials_.pairs,
                                            pool, motion.position);
    tracking_loss_ += list_on_surfaces();
    plane_neighbours_.expire(neighbours_.skin());
    is_shared_out_ = false;
    ++list_count_;
  }
  if (cell_neighbours_.update(motion.position, pool, motion.max_displacement)) {
    tracking_loss_ += between_structures_.rebuild(cell_neighbours_.pairs(), materials_);
    ++list_count_;
  }
  if (plane_neighbours_.update(spheres_, planes, motion.position)) {
    tracking_loss_ +=
        with_planes_.rebuild(plane_neighbours_.pairs(), spheres_, planes, materials_.pairs);
    is_shared_out_ = false;
    ++list_count_;
  }
  if (!is_shared_out_ || (shared_motion() != nullptr && shared_motion()->is_due())) share_out();
  dissipated_ += with_spheres_.advance(motion, dt, pool, forces);
  add(with_surfaces_.advance(motion, dt, pool));
  add(between_structures_.advance(motion, dt, pool));
  with_surfaces_.add_forces(forces, pool);
  between_structures_.add_forces(forces);
  dissipated_ += with_planes_.advance(motion, planes, dt, pool, forces);
}

bool SceneContacts::makes_lists(const Motion& motion, std::span<const Plane> planes,
                                geometry::ThreadPool& pool) {
  are_lists_due_ = look_at_lists(motion, pool);
  const bool is_shared_out = is_shared_out_ && (!shared_motion() || !shared_motion()->is_due());
  return start_ != Start::over || *are_lists_due_ || !is_shared_out ||
         plane_neighbours_.is_due(planes);
}

/// Of ranks each looks at the nodes that it knows.
bool SceneContacts::look_at_lists(const Motion& motion, geometry::ThreadPool& pool) {
  const SharedMotion* const shared = shared_motion();
  if (shared == nullptr || !shared->is_of_use())
    return neighbours_.is_due(motion.position, pool, motion.max_displacement);
  const geometry::KnownNodes known{&shared->ranks(), shared->common(), shared->own()};
  return neighbours_.is_due(motion.position, pool, motion.max_displacement, &known);
}

/// What meets surfaces is computed by all ranks.
void SceneContacts::share_out() {
  is_shared_out_ = true;
  if (const SharedMotion* const shared = shared_motion()) {
    std::vector<NodeId> met;
    const auto add = [&](const geometry::IndexPair& pair) {
      met.push_back(spheres_[static_cast<std::size_t>(pair.a)].node);
    };
    std::ranges::for_each(neighbours_.sphere_structures(), add);
    for (const geometry::IndexPair& pair : plane_neighbours_.pairs())
      if (shared->keeps_common_near(static_cast<std::size_t>(pair.b)) ||
          spheres_[static_cast<std::size_t>(pair.a)].rigid_body >= 0)
        add(pair);
    with_spheres_.share_out(met);
  }
  with_planes_.share_out(spheres_,
                         {&with_spheres_.blocks(), with_spheres_.holders(), shared_motion()});
}

/// The first step is over: the contacts listed go on with the parameters of later ones.
void SceneContacts::end_start(std::span<const Plane> planes, geometry::ThreadPool& pool) {
  start_ = Start::over;
  if (!materials_.pairs.end_start()) return;
  is_shared_out_ = false;
  ++list_count_;
  with_spheres_.rebuild(neighbours_.sphere_pairs(), spheres_, materials_.pairs, pool,
                        neighbours_.list_positions());
  list_on_surfaces();
  between_structures_.take_parameters(materials_);
  with_planes_.rebuild(plane_neighbours_.pairs(), spheres_, planes, materials_.pairs);
}

/// @returns the energy (J) lost with contacts that left the list
double SceneContacts::list_on_surfaces() {
  return with_surfaces_.rebuild(neighbours_.sphere_structures(), neighbours_.near_cells(),
                                neighbours_.cells(), spheres_, materials_.of_structures,
                                materials_.pairs);
}

void SceneContacts::follow(const geometry::SurfaceChange& change, const Motion& motion,
                           Positions at, geometry::ThreadPool& pool) {
  is_shared_out_ = false;
  ++list_count_;
  tracking_loss_ += with_surfaces_.follow(change, neighbours_.cells(), at);
  neighbours_.follow(change);
  tracking_loss_ += list_on_surfaces();
  cell_neighbours_.follow(change);
  cell_neighbours_.update(motion.position, pool);
  const Motion then{at, motion.velocity, motion.angular_velocity};
  tracking_loss_ +=
      between_structures_.follow(change, cell_neighbours_.pairs(), materials_, then, pool);
}

void SceneContacts::exchange(const geometry::StateArchive& archive, std::span<const Plane> planes,
                             geometry::ThreadPool& pool) {
  archive.same("materials", materials_hash_, "other materials or other contact laws");
  exchange_sums(archive);
  exchange_of_spheres(archive, pool);
  exchange_of_structures(archive, pool);
  exchange_of_planes(archive, planes);
}

void SceneContacts::exchange_sums(const geometry::StateArchive& archive) {
  exchange_start(archive);
  archive("dissipated", dissipated_);
  archive("tracking_loss", tracking_loss_);
  archive("last_number", last_number_);
  archive("list_count", list_count_);
  if (!archive.is_reading()) return;
  is_shared_out_ = false;
  are_lists_due_.reset();
}

void SceneContacts::exchange_of_spheres(const geometry::StateArchive& archive,
                                        geometry::ThreadPool& pool) {
  neighbours_.exchange(archive.group("neighbours"), pool);
  with_spheres_.exchange(archive.group("spheres"), [&] {
    with_spheres_.rebuild(neighbours_.sphere_pairs(), spheres_, materials_.pairs, pool,
                          neighbours_.list_positions());
  });
  with_surfaces_.exchange(
      archive.group("surfaces"), [&] { list_on_surfaces(); }, pool);
}

void SceneContacts::exchange_of_structures(const geometry::StateArchive& archive,
                                           geometry::ThreadPool& pool) {
  cell_neighbours_.exchange(archive.group("cell_neighbours"), pool);
  between_structures_.exchange(archive.group("structures"), [&] {
    between_structures_.rebuild(cell_neighbours_.pairs(), materials_);
  });
}

void SceneContacts::exchange_of_planes(const geometry::StateArchive& archive,
                                       std::span<const Plane> planes) {
  plane_neighbours_.exchange(archive.group("plane_neighbours"), spheres_.size(), planes.size());
  with_planes_.exchange(archive.group("planes"), planes.size(), [&] {
    with_planes_.rebuild(plane_neighbours_.pairs(), spheres_, planes, materials_.pairs);
  });
  if (archive.is_reading())
    with_planes_.share_out(spheres_, {&with_spheres_.blocks(), {}, nullptr});
}

void SceneContacts::exchange_start(const geometry::StateArchive& archive) {
  Start start = start_;
  archive("start", start);
  archive.require(start == Start::ahead || start == Start::now || start == Start::over, "start");
  const bool has_ended = start == Start::over && start_ != Start::over;
  start_ = start;
  if (has_ended && materials_.pairs.end_start()) between_structures_.take_parameters(materials_);
}

// Another scene, with some of the same bodies.

namespace {

/// Whether places are those of as many bodies, each where it was.
bool are_same(std::span<const std::int32_t> places, std::size_t count) {
  if (places.size() != count) return false;
  for (std::size_t i = 0; i < count; ++i)
    if (places[i] != static_cast<std::int32_t>(i)) return false;
  return true;
}

}  // namespace

/// Lists of the same bodies, made as they were before, have the same pairs. What acts at a distance
/// is listed from further off or from nearer where its numbers are others.
bool SceneContacts::lists_same_spheres(const SceneContacts& before,
                                       const BodyPlaces& places) const {
  const bool same_reach = materials_hash_ == before.materials_hash_ ||
                          (!materials_.pairs.may_act_at_a_distance() &&
                           !before.materials_.pairs.may_act_at_a_distance());
  return same_reach && are_same(places.spheres, neighbours_.sphere_count()) &&
         are_same(places.nodes, surface_->node_count());
}

/// Of what met planes before among what meets them now, by node.
std::vector<std::int32_t> SceneContacts::places_at_planes(const SceneContacts& before,
                                                          const BodyPlaces& places) const {
  std::vector<std::int32_t> of_node(surface_->node_count(), -1);
  for (std::size_t i = 0; i < spheres_.size(); ++i)
    of_node[index_of(spheres_[i].node)] = static_cast<std::int32_t>(i);
  std::vector<std::int32_t> now;
  for (const SphereBody& sphere : before.spheres_) {
    const std::int32_t node = places.nodes[index_of(sphere.node)];
    now.push_back(node < 0 ? -1 : of_node[static_cast<std::size_t>(node)]);
  }
  return now;
}

void SceneContacts::take_over(Contacts& other, const BodyPlaces& places,
                              std::span<const Plane> planes, Positions x,
                              geometry::ThreadPool& pool) {
  auto& before = dynamic_cast<SceneContacts&>(other);
  geometry::StateTree tree;
  const auto writer = geometry::StateArchive::writer(tree);
  before.exchange_sums(writer);
  before.exchange_of_structures(writer, pool);
  const auto archive = geometry::StateArchive::reader(tree);
  exchange_sums(archive);
  exchange_of_structures(archive, pool);
  if (lists_same_spheres(before, places)) {
    before.exchange_of_spheres(writer, pool);
    exchange_of_spheres(archive, pool);
  } else {
    neighbours_.update(x, pool, std::numeric_limits<double>::infinity());
    with_spheres_.take_over(before.with_spheres_, places.spheres, [&] {
      with_spheres_.rebuild(neighbours_.sphere_pairs(), spheres_, materials_.pairs, pool, x);
    });
    with_surfaces_.take_over(
        before.with_surfaces_, places.spheres, [&] { list_on_surfaces(); }, pool);
    ++list_count_;
  }
  plane_neighbours_.expire(neighbours_.skin());
  plane_neighbours_.update(spheres_, planes, x);
  with_planes_.take_over(before.with_planes_, places_at_planes(before, places), places.planes, [&] {
    with_planes_.rebuild(plane_neighbours_.pairs(), spheres_, planes, materials_.pairs);
  });
  with_planes_.share_out(spheres_, {&with_spheres_.blocks(), {}, nullptr});
  with_planes_.add_up_actions(x, planes);
}

}  // namespace plekton::contact
