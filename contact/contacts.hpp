// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/balls/ball_contacts.hpp"
#include "contact/plane_contacts.hpp"
#include "contact/plane_neighbours.hpp"
#include "contact/structure_contacts.hpp"
#include "contact/surface_contacts.hpp"
#include "geometry/cell_neighbours.hpp"
#include "geometry/neighbours.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace plekton::contact {

/// How many contacts of each kind there are.
struct ContactCounts {
  std::size_t sphere_sphere = 0;
  std::size_t sphere_surface = 0;
  std::size_t between_structures = 0;
  std::size_t with_planes = 0;
};

/// All contacts of a scene: spheres with spheres, spheres with surfaces, structures with each other
/// and with themselves, spheres and nodes of
/// surfaces with planes.
template <ContactLaw Law>
class Contacts {
 public:
  /// @param spheres, surface  must outlive this
  /// @param skin  m, how far a pair may be apart when it is listed as a candidate
  /// @param meets_planes  by NodeId: which nodes of the surface touch planes; empty: all of them
  /// @param rest  m, of all nodes, for structures that may touch themselves; empty: they do not
  Contacts(std::span<const geometry::Sphere> spheres, const geometry::Surface& surface,
           ContactMaterials<Law> materials, double skin, const std::vector<bool>& meets_planes = {},
           Positions rest = {});

  /// From now on the spheres' lists choose their skin by themselves (geometry/neighbours.hpp).
  /// @param radius  m, > 0, of a usual sphere
  void tune_skin(double radius) noexcept { neighbours_.tune_skin(radius); }

  /// From now on the lists of structures choose their skin by themselves
  /// (geometry/cell_neighbours.hpp).
  void choose_skin_of_structures() { cell_neighbours_.choose_skin(); }

  /// One step: finds who touches whom, carries histories over, asks the law, and sets the forces of
  /// all nodes to those of contacts.
  void advance(const Motion& motion, std::span<const Plane> planes, double dt,
               geometry::ThreadPool& pool, NodeForces& forces);

  /// Goes on with what is left of the surface after some of its elements have broken away
  /// (geometry::Surface::left_with). Contacts go on where a feature they touch is left, those far
  /// from the change to the last bit. Nodes go on touching planes, also those that have lost their
  /// last element. To be called where advance() would be, before it; linear in the lists.
  /// @param change  to the surface as it is now, which outlives this
  /// @param motion  of this step
  /// @param at      m, where the nodes were half a drift ago: to compare elastic energies there
  ///                loses nothing to second order (trapezoidal rule)
  void follow(const geometry::SurfaceChange& change, const Motion& motion, Positions at,
              geometry::ThreadPool& pool);

  ContactCounts counts() const noexcept {
    return {with_spheres_.touching(), with_surfaces_.touching(), between_structures_.touching(),
            with_planes_.touching()};
  }

  /// Energy (J) stored at the positions of the last step.
  double elastic_energy() const {
    return with_spheres_.elastic_energy() + with_surfaces_.elastic_energy() +
           between_structures_.elastic_energy() + with_planes_.elastic_energy();
  }
  /// Energy (J) dissipated since the beginning, by the law and with contacts that are over.
  double dissipated() const noexcept { return dissipated_; }
  /// Energy (J) lost since the beginning, or below 0 made, where contacts go on as others: where
  /// histories are handed from patch to patch, on lists that change, and with elements that break.
  double tracking_loss() const noexcept { return tracking_loss_; }

  /// Largest overlap of the last step over the radius of the smaller ball.
  double largest_overlap_ratio() const noexcept {
    return std::max({with_spheres_.largest_overlap_ratio(), with_surfaces_.largest_overlap_ratio(),
                     between_structures_.largest_overlap_ratio(),
                     with_planes_.largest_overlap_ratio()});
  }

  /// Numbers the contacts of the last step that have no number yet, from 1 on, in a fixed order:
  /// the same numbers for any number of threads, and none given twice. A contact keeps its number
  /// as long as it lasts, from element to element, whoever asks for it in between. Where a patch
  /// splits, the part that pushes most keeps it; where some merge, the one that pushed most.
  void number() {
    with_spheres_.number(last_number_);
    with_surfaces_.number(last_number_);
    between_structures_.number(last_number_);
    with_planes_.number(last_number_);
  }

  /// Calls visit(ContactRow) for every contact of the last step, in a fixed order. Together the
  /// rows hold all that contacts did to the nodes.
  /// @param x  m, where the nodes were in that step
  template <class Visit>
  void for_each_row(Positions x, Visit&& visit) const {
    with_spheres_.for_each_row(x, visit);
    with_surfaces_.for_each_row(x, visit);
    between_structures_.for_each_row(x, visit);
    with_planes_.for_each_row(x, *surface_, visit);
  }

  /// Adds what contacts did in the last step to the nodes of surfaces: forces of spheres on each
  /// other are left out.
  void add_surface_forces(NodeForces& forces, geometry::ThreadPool& pool) const {
    with_surfaces_.add_forces(forces, pool);
    between_structures_.add_forces(forces);
    with_planes_.add_forces(forces, pool);
  }

  const BallContacts<Law>& with_spheres() const noexcept { return with_spheres_; }
  const SurfaceContacts<Law>& with_surfaces() const noexcept { return with_surfaces_; }
  const StructureContacts<Law>& between_structures() const noexcept { return between_structures_; }
  const PlaneContacts<Law>& with_planes() const noexcept { return with_planes_; }
  /// How often a list of pairs that may touch was made: what is not in one cannot touch before the
  /// next.
  std::int64_t list_count() const noexcept { return list_count_; }

  const geometry::Neighbours& neighbours() const noexcept { return neighbours_; }
  const geometry::CellNeighbours& cell_neighbours() const noexcept { return cell_neighbours_; }

 private:
  double list_on_surfaces();
  void add(const EnergyLoss& loss) noexcept {
    dissipated_ += loss.dissipated;
    tracking_loss_ += loss.tracking;
  }
  void end_start(std::span<const Plane> planes, Positions x, geometry::ThreadPool& pool);

  ContactMaterials<Law> materials_;
  std::vector<Ball> balls_;  ///< the spheres, then the nodes of the surface
  geometry::Neighbours neighbours_;
  geometry::CellNeighbours cell_neighbours_;
  PlaneNeighbours plane_neighbours_;
  BallContacts<Law> with_spheres_;
  SurfaceContacts<Law> with_surfaces_;
  StructureContacts<Law> between_structures_;
  PlaneContacts<Law> with_planes_;
  const geometry::Surface* surface_;
  double dissipated_ = 0.0;
  double tracking_loss_ = 0.0;
  std::int64_t last_number_ = 0;
  std::int64_t list_count_ = 0;
  enum class Start { ahead, now, over } start_ = Start::ahead;
};

/// Structures are thinner than grains are wide: with the grains' skin a net would list half of
/// itself.
inline double skin_of_structures(const geometry::Surface& surface, double skin) {
  for (std::size_t i = 0; i < surface.structure_count(); ++i) {
    skin = std::min(skin, 0.5 * surface.radius(geometry::id_at<geometry::StructureId>(i)));
  }
  return skin;
}

/// m, over which bodies of a scene may stick to each other; of laws whose reach grows with the
/// radii of both bodies, or with the smaller one's.
template <ContactLaw Law>
double largest_reach(std::span<const geometry::Sphere> spheres, const geometry::Surface& surface,
                     const ContactMaterials<Law>& materials) {
  if constexpr (!HasReach<Law>) return 0.0;
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
        reach = std::max(reach, reach_of<Law>(materials.pairs.combine({material_a, radius_a},
                                                                      {material_b, radius})));
      }
    }
  }
  return reach;
}

template <ContactLaw Law>
Contacts<Law>::Contacts(std::span<const geometry::Sphere> spheres, const geometry::Surface& surface,
                        ContactMaterials<Law> materials, double skin,
                        const std::vector<bool>& meets_planes, Positions rest)
    : materials_(std::move(materials)),
      neighbours_(spheres, surface, skin, largest_reach(spheres, surface, materials_)),
      cell_neighbours_(surface, rest, skin_of_structures(surface, skin), !rest.empty()),
      plane_neighbours_(skin, largest_reach(spheres, surface, materials_)),
      with_surfaces_(surface),
      between_structures_(surface),
      surface_(&surface) {
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const NodeId node = spheres[i].nodes[0];
    balls_.push_back({node, spheres[i].radius, materials_.of_spheres[i], materials_.mass_of(node)});
  }
  for (std::size_t n = 0; n < surface.node_count(); ++n) {
    const auto structure = surface.structure_of(geometry::id_at<NodeId>(n));
    if (structure == geometry::StructureId{-1} || (!meets_planes.empty() && !meets_planes[n]))
      continue;
    const NodeId node = geometry::id_at<NodeId>(n);
    balls_.push_back({node, surface.radius(structure),
                      materials_.of_structures[index_of(structure)], materials_.mass_of(node)});
  }
}

template <ContactLaw Law>
void Contacts<Law>::advance(const Motion& motion, std::span<const Plane> planes, double dt,
                            geometry::ThreadPool& pool, NodeForces& forces) {
  if (start_ == Start::now) end_start(planes, motion.position, pool);
  if (start_ == Start::ahead) start_ = Start::now;
  if (neighbours_.update(motion.position, pool, motion.way)) {
    tracking_loss_ += with_spheres_.rebuild(neighbours_.sphere_pairs(), balls_, materials_.pairs,
                                            pool, motion.position);
    tracking_loss_ += list_on_surfaces();
    plane_neighbours_.expire(neighbours_.skin());
    ++list_count_;
  }
  if (cell_neighbours_.update(motion.position, pool, motion.way)) {
    tracking_loss_ += between_structures_.rebuild(cell_neighbours_.pairs(), materials_);
    ++list_count_;
  }
  if (plane_neighbours_.update(balls_, planes, motion.position)) {
    tracking_loss_ +=
        with_planes_.rebuild(plane_neighbours_.pairs(), balls_, planes, materials_.pairs);
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
template <ContactLaw Law>
void Contacts<Law>::end_start(std::span<const Plane> planes, Positions x,
                              geometry::ThreadPool& pool) {
  start_ = Start::over;
  if (!materials_.pairs.end_start()) return;
  ++list_count_;
  with_spheres_.rebuild(neighbours_.sphere_pairs(), balls_, materials_.pairs, pool, x);
  list_on_surfaces();
  between_structures_.take_parameters(materials_);
  with_planes_.rebuild(plane_neighbours_.pairs(), balls_, planes, materials_.pairs);
}

/// @returns the energy (J) lost with contacts that left the list
template <ContactLaw Law>
double Contacts<Law>::list_on_surfaces() {
  return with_surfaces_.rebuild(neighbours_.sphere_structures(), neighbours_.near_cells(),
                                neighbours_.cells(), balls_, materials_.of_structures,
                                materials_.pairs);
}

template <ContactLaw Law>
void Contacts<Law>::follow(const geometry::SurfaceChange& change, const Motion& motion,
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

}  // namespace plekton::contact
