// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/sphere_sphere/ball_contacts.hpp"
#include "contact/contact_model.hpp"
#include "contact/law/any_law.hpp"
#include "contact/law/linear_frictional.hpp"
#include "contact/sphere_plane/plane_contacts.hpp"
#include "contact/sphere_plane/plane_neighbours.hpp"
#include "contact/surface_surface/structure_contacts.hpp"
#include "contact/sphere_surface/surface_contacts.hpp"
#include "geometry/neighbor/cell_neighbours.hpp"
#include "geometry/neighbor/neighbours.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace plekton::contact {

/// Contacts under a law that is known as a type. Laws of one's own need none: models.hpp.
template <ContactLaw Law>
class ContactsUnder final : public Contacts {
 public:
  /// @param spheres, surface  must outlive this
  /// @param skin  m, how far a pair may be apart when it is listed as a candidate
  /// @param meets_planes  by NodeId: which nodes of the surface touch planes; empty: all of them
  /// @param rest  m, of all nodes, for structures that may touch themselves; empty: they do not
  ContactsUnder(std::span<const geometry::Sphere> spheres, const geometry::Surface& surface,
                ContactMaterials<Law> materials, double skin,
                const std::vector<bool>& meets_planes = {}, Positions rest = {});

  void tune_skin(double radius) noexcept override { neighbours_.tune_skin(radius); }
  void choose_skin_of_structures() override { cell_neighbours_.choose_skin(); }

  void advance(const Motion& motion, std::span<const Plane> planes, double dt,
               geometry::ThreadPool& pool, NodeForces& forces) override;
  void follow(const geometry::SurfaceChange& change, const Motion& motion, Positions at,
              geometry::ThreadPool& pool) override;

  ContactCounts counts() const noexcept override {
    return {with_spheres_.touching(), with_surfaces_.touching(), between_structures_.touching(),
            with_planes_.touching()};
  }
  double elastic_energy() const override {
    return with_spheres_.elastic_energy() + with_surfaces_.elastic_energy() +
           between_structures_.elastic_energy() + with_planes_.elastic_energy();
  }
  double dissipated() const noexcept override { return dissipated_; }
  double tracking_loss() const noexcept override { return tracking_loss_; }
  double largest_overlap_ratio() const noexcept override {
    return std::max({with_spheres_.largest_overlap_ratio(), with_surfaces_.largest_overlap_ratio(),
                     between_structures_.largest_overlap_ratio(),
                     with_planes_.largest_overlap_ratio()});
  }
  std::int64_t pass_throughs() const noexcept override { return with_surfaces_.pass_throughs(); }
  std::size_t crossings() const noexcept override { return between_structures_.crossings(); }

  void number() override {
    with_spheres_.number(last_number_);
    with_surfaces_.number(last_number_);
    between_structures_.number(last_number_);
    with_planes_.number(last_number_);
  }
  void for_each_row(Positions x, Visit<const ContactRow&> visit) const override {
    with_spheres_.for_each_row(x, visit);
    with_surfaces_.for_each_row(x, visit);
    between_structures_.for_each_row(x, visit);
    with_planes_.for_each_row(x, *surface_, visit);
  }
  void for_each_plane_row(Positions x, Visit<const ContactRow&> visit) const override {
    with_planes_.for_each_row(x, *surface_, visit);
  }
  void for_each_structure_row_on(
      NodeId node, Positions x,
      Visit<const ContactRow&, const Vec3&, const Vec3&> visit) const override {
    between_structures_.for_each_row_on(node, x, visit);
  }

  void add_surface_forces(NodeForces& forces, geometry::ThreadPool& pool) const override {
    with_surfaces_.add_forces(forces, pool);
    between_structures_.add_forces(forces);
    with_planes_.add_forces(forces, pool);
  }
  void add_sphere_surface_forces(NodeForces& forces, geometry::ThreadPool& pool) const override {
    with_surfaces_.add_forces(forces, pool);
  }
  Vec3 force_on_plane(std::size_t plane) const override { return with_planes_.force_on(plane); }
  void for_each_plane_force(Visit<std::size_t, const Vec3&> visit) const override {
    with_planes_.for_each_force(visit);
  }
  std::size_t structure_bond_count() const override { return between_structures_.bond_count(); }

  void for_each_sphere_pair(VisitSpheres visit) const override {
    with_spheres_.for_each_touching(with_springs(visit));
  }
  void for_each_near_sphere_pair(double margin, Positions x, VisitSpheres visit) const override {
    with_spheres_.for_each_near(margin, x, with_springs(visit));
  }
  void for_each_surface_term(VisitSphereOnSurface visit) const override {
    with_surfaces_.for_each_touching(
        [&](NodeId ball, const geometry::CorePoint& core, const auto& parameters, double range,
            double force) { visit(ball, core, springs(parameters), range, force); });
  }
  void for_each_coming_surface_term(double margin, Positions x,
                                    VisitSphereOnSurface visit) const override {
    with_surfaces_.for_each_coming(
        margin, neighbours_.cells(), x,
        [&](NodeId ball, const geometry::CorePoint& core, const auto& parameters, double range) {
          visit(ball, core, springs(parameters), range, 0.0);
        });
  }
  void add_elastic_forces(Positions x, NodeForces& forces, PatchFinder& finder,
                          geometry::FunctionRef<bool(NodeId)> of) const override {
    with_surfaces_.add_elastic_forces(neighbours_.cells(), x, forces, finder, of);
  }
  void for_each_structure_stiffness(Visit<NodeId, double, double, double> visit) const override {
    between_structures_.for_each_stiffness(visit);
  }
  void for_each_near_cell_pair(double margin,
                               Visit<const geometry::CellPair&> visit) const override {
    between_structures_.for_each_near(margin, visit);
  }
  void for_each_plane_pair(VisitPlane visit) const override {
    with_planes_.for_each_touching(with_springs(visit));
  }
  void for_each_near_plane_pair(double margin, std::span<const Plane> planes, Positions x,
                                VisitPlane visit) const override {
    with_planes_.for_each_near(margin, planes, x, with_springs(visit));
  }
  PairStiffness stiffness(const BodyPart& a, const BodyPart& b, double gap,
                          double count) const override {
    const auto parameters = Law::multiplied(materials_.pairs.combine(a, b), count);
    return {Law::normal_stiffness(parameters, gap), Law::tangential_stiffness(parameters, gap)};
  }

  std::int64_t list_count() const noexcept override { return list_count_; }
  const geometry::Neighbours& neighbours() const noexcept override { return neighbours_; }
  const geometry::CellNeighbours& cell_neighbours() const noexcept override {
    return cell_neighbours_;
  }

  const BallContacts<Law>& with_spheres() const noexcept { return with_spheres_; }
  const SurfaceContacts<Law>& with_surfaces() const noexcept { return with_surfaces_; }
  const StructureContacts<Law>& between_structures() const noexcept { return between_structures_; }
  const PlaneContacts<Law>& with_planes() const noexcept { return with_planes_; }

 private:
  using Parameters = typename Law::Parameters;

  static PairSprings springs(const Parameters& parameters) noexcept {
    return PairSprings::under<Law>(parameters);
  }
  /// A visit that gets the parameters' springs in their place.
  template <class A, class B>
  static auto with_springs(const Visit<A, B, const PairSprings&, double>& visit) {
    return [&visit](A a, B b, const Parameters& parameters, double gap) {
      visit(a, b, springs(parameters), gap);
    };
  }
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
ContactsUnder<Law>::ContactsUnder(std::span<const geometry::Sphere> spheres,
                                  const geometry::Surface& surface, ContactMaterials<Law> materials,
                                  double skin, const std::vector<bool>& meets_planes,
                                  Positions rest)
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
void ContactsUnder<Law>::advance(const Motion& motion, std::span<const Plane> planes, double dt,
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
void ContactsUnder<Law>::end_start(std::span<const Plane> planes, Positions x,
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
double ContactsUnder<Law>::list_on_surfaces() {
  return with_surfaces_.rebuild(neighbours_.sphere_structures(), neighbours_.near_cells(),
                                neighbours_.cells(), balls_, materials_.of_structures,
                                materials_.pairs);
}

template <ContactLaw Law>
void ContactsUnder<Law>::follow(const geometry::SurfaceChange& change, const Motion& motion,
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

/// @param properties  of pairs of materials
/// @param others      of those that have none of their own
template <ContactLaw Law>
ContactModel model_under(const PairProperties<Law>& properties,
                         const PropertiesOf<Law>& others = {}) {
  return [properties, others](ContactScene scene) -> std::unique_ptr<Contacts> {
    return std::make_unique<ContactsUnder<Law>>(
        scene.spheres, scene.surface,
        ContactMaterials<Law>{MaterialPairs<Law>(std::move(scene.materials), properties, others),
                              std::move(scene.of_spheres), std::move(scene.of_structures),
                              std::move(scene.masses)},
        scene.skin, scene.meets_planes, scene.rest);
  };
}

/// Compiled once, in the library.
extern template class ContactsUnder<LinearFrictional>;
extern template class ContactsUnder<AnyLaw>;

}  // namespace plekton::contact
