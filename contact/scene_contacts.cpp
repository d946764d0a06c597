// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/scene_contacts.hpp"

#include "contact/surface_surface/mean_node_masses.hpp"
#include "geometry/base/state_archive.hpp"

#include <algorithm>
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
  materials_.structure_masses = structure::mean_node_masses(surface, materials_);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const NodeId node = spheres[i].nodes[0];
    spheres_.push_back(
        {node, spheres[i].radius, materials_.of_spheres[i], materials_.mass_of(node)});
  }
  for (std::size_t n = 0; n < surface.node_count(); ++n) {
    const auto structure = surface.structure_of(geometry::id_at<NodeId>(n));
    if (structure == geometry::StructureId{-1} || (!meets_planes.empty() && !meets_planes[n]))
      continue;
    const NodeId node = geometry::id_at<NodeId>(n);
    spheres_.push_back({node, surface.radius(structure),
                        materials_.of_structures[index_of(structure)], materials_.mass_of(node)});
  }
}

void SceneContacts::advance(const Motion& motion, std::span<const Plane> planes, double dt,
                            geometry::ThreadPool& pool, NodeForces& forces) {
  if (start_ == Start::now) end_start(planes, pool);
  if (start_ == Start::ahead) start_ = Start::now;
  if (neighbours_.update(motion.position, pool, motion.max_displacement)) {
    tracking_loss_ += with_spheres_.rebuild(neighbours_.sphere_pairs(), spheres_, materials_.pairs,
                                            pool, motion.position);
    tracking_loss_ += list_on_surfaces();
    plane_neighbours_.expire(neighbours_.skin());
    ++list_count_;
  }
  if (cell_neighbours_.update(motion.position, pool, motion.max_displacement)) {
    tracking_loss_ += between_structures_.rebuild(cell_neighbours_.pairs(), materials_);
    ++list_count_;
  }
  if (plane_neighbours_.update(spheres_, planes, motion.position)) {
    tracking_loss_ +=
        with_planes_.rebuild(plane_neighbours_.pairs(), spheres_, planes, materials_.pairs);
    ++list_count_;
  }
  dissipated_ += with_spheres_.advance(motion, dt, pool, forces);
  add(with_surfaces_.advance(motion, dt, pool));
  add(between_structures_.advance(motion, dt, pool));
  with_surfaces_.add_forces(forces, pool);
  between_structures_.add_forces(forces);
  dissipated_ += with_planes_.advance(motion, planes, dt, pool, forces);
}

/// The first step is over: the contacts listed go on with the parameters of later ones.
void SceneContacts::end_start(std::span<const Plane> planes, geometry::ThreadPool& pool) {
  start_ = Start::over;
  if (!materials_.pairs.end_start()) return;
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
  exchange_start(archive);
  archive("dissipated", dissipated_);
  archive("tracking_loss", tracking_loss_);
  archive("last_number", last_number_);
  archive("list_count", list_count_);
  neighbours_.exchange(archive.group("neighbours"), pool);
  cell_neighbours_.exchange(archive.group("cell_neighbours"), pool);
  with_spheres_.exchange(archive.group("spheres"), [&] {
    with_spheres_.rebuild(neighbours_.sphere_pairs(), spheres_, materials_.pairs, pool,
                          neighbours_.list_positions());
  });
  with_surfaces_.exchange(
      archive.group("surfaces"), [&] { list_on_surfaces(); }, pool);
  between_structures_.exchange(archive.group("structures"), [&] {
    between_structures_.rebuild(cell_neighbours_.pairs(), materials_);
  });
  plane_neighbours_.exchange(archive.group("plane_neighbours"), spheres_.size(), planes.size());
  with_planes_.exchange(
      archive.group("planes"),
      [&] { with_planes_.rebuild(plane_neighbours_.pairs(), spheres_, planes, materials_.pairs); },
      pool);
}

void SceneContacts::exchange_start(const geometry::StateArchive& archive) {
  Start start = start_;
  archive("start", start);
  const bool has_ended = start == Start::over && start_ != Start::over;
  start_ = start;
  if (has_ended && materials_.pairs.end_start()) between_structures_.take_parameters(materials_);
}

}  // namespace plekton::contact
