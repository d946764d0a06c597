// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contact_kind.hpp"
#include "contact/contact_model.hpp"
#include "contact/sphere_plane/plane_contacts.hpp"
#include "contact/sphere_plane/plane_neighbours.hpp"
#include "contact/sphere_sphere/sphere_contacts.hpp"
#include "contact/sphere_surface/surface_contacts.hpp"
#include "contact/surface_surface/structure_contacts.hpp"
#include "geometry/neighbor/cell_neighbours.hpp"
#include "geometry/neighbor/neighbours.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace plekton::contact {

/// All contacts of a scene.
class SceneContacts final : public Contacts {
 public:
  /// @param spheres, surface  must outlive this
  /// @param skin  m, how far a pair may be apart when it is listed as a candidate
  /// @param meets_planes  by NodeId: which nodes of the surface touch planes; empty: all of them
  /// @param rest  m, of all nodes, for structures that may touch themselves; empty: they do not
  /// @param groups  nodes whose elements do not touch each other
  SceneContacts(std::span<const geometry::Sphere> spheres, const geometry::Surface& surface,
                ContactMaterials materials, double skin, const std::vector<bool>& meets_planes = {},
                Positions rest = {}, const geometry::ExclusionGroups& groups = {});

  /// From here on ranks share the work; to be called before the first step.
  void share_among(geometry::Ranks& ranks) {
    neighbours_.take_share(
        {static_cast<std::size_t>(ranks.rank()), static_cast<std::size_t>(ranks.count())});
    with_spheres_.share_among(ranks);
  }
  SharedMotion* shared_motion() noexcept override { return with_spheres_.shared_motion(); }
  std::vector<RankShare> shares_of_ranks() const { return with_spheres_.shares_of_ranks(); }
  bool makes_lists(const Motion& motion, std::span<const Plane> planes,
                   geometry::ThreadPool& pool) override;

  void tune_skin(double radius) noexcept override { neighbours_.tune_skin(radius); }
  void choose_skin_of_structures() override { cell_neighbours_.choose_skin(); }

  void advance(const Motion& motion, std::span<const Plane> planes, double dt,
               geometry::ThreadPool& pool, NodeForces& forces) override;
  void follow(const geometry::SurfaceChange& change, const Motion& motion, Positions at,
              geometry::ThreadPool& pool) override;

  void exchange(const geometry::StateArchive& archive, std::span<const Plane> planes,
                geometry::ThreadPool& pool) override;

  void take_over(Contacts& before, const BodyPlaces& places, std::span<const Plane> planes,
                 Positions x, geometry::ThreadPool& pool) override;

  ContactCounts counts() const noexcept override {
    return {with_spheres_.touching(), with_surfaces_.touching(), between_structures_.touching(),
            with_planes_.touching()};
  }
  double elastic_energy() const override {
    double energy = 0.0;
    for_each_kind([&](const ContactKind auto& kind) { energy += kind.elastic_energy(); });
    return energy;
  }
  double dissipated() const noexcept override { return dissipated_; }
  double tracking_loss() const noexcept override { return tracking_loss_; }
  double largest_overlap_ratio() const noexcept override {
    double largest = 0.0;
    for_each_kind([&](const ContactKind auto& kind) {
      largest = std::max(largest, kind.largest_overlap_ratio());
    });
    return largest;
  }
  std::int64_t pass_throughs() const noexcept override { return with_surfaces_.pass_throughs(); }
  std::size_t crossings() const noexcept override { return between_structures_.crossings(); }

  void assign_ids() override {
    for_each_kind([&](ContactKind auto& kind) { kind.assign_ids(last_number_); });
  }
  void for_each_balanced(Positions x, Visit<const ContactRecord&> visit) const override {
    between_structures_.for_each_balanced(x, visit);
  }
  void for_each_record(Positions x, Visit<const ContactRecord&> visit) const override {
    for_each_kind([&](const ContactKind auto& kind) { kind.for_each_record(x, visit); });
  }
  void for_each_structure_record_on(
      NodeId node, Positions x,
      Visit<const ContactRecord&, const Vec3&, const Vec3&> visit) const override {
    between_structures_.for_each_record_on(node, x, visit);
  }

  void add_surface_forces(NodeForces& forces, geometry::ThreadPool& pool) const override {
    with_surfaces_.add_forces(forces, pool);
    between_structures_.add_forces(forces);
    with_planes_.add_forces(forces);
  }
  void add_sphere_surface_forces(NodeForces& forces, geometry::ThreadPool& pool) const override {
    with_surfaces_.add_forces(forces, pool);
  }
  const PlaneAction& on_plane(std::size_t plane) const override {
    return with_planes_.action_on(plane);
  }
  std::size_t structure_bond_count() const override { return between_structures_.bond_count(); }

  void for_each_sphere_pair(VisitSpheres visit) const override {
    with_spheres_.for_each_touching(visit);
  }
  void for_each_near_sphere_pair(double margin, Positions x, VisitSpheres visit) const override {
    with_spheres_.for_each_near(margin, x, visit);
  }
  void for_each_surface_term(VisitSphereOnSurface visit) const override {
    with_surfaces_.for_each_touching(visit);
  }
  void for_each_coming_surface_term(double margin, Positions x,
                                    VisitSphereOnSurface visit) const override {
    with_surfaces_.for_each_coming(
        margin, neighbours_.cells(), x,
        [&](NodeId sphere, const geometry::CorePoint& core, const auto& parameters, double range) {
          visit(sphere, core, parameters, range, TermPart{});
        });
  }
  void add_elastic_forces(Positions x, NodeForces& forces, PatchFinder& finder,
                          geometry::FunctionRef<bool(NodeId)> of) const override {
    with_surfaces_.add_elastic_forces(neighbours_.cells(), x, forces, finder, of);
  }
  void for_each_structure_stiffness(
      Visit<NodeId, const PairStiffness&, double> visit) const override {
    between_structures_.for_each_stiffness(visit);
  }
  void probe_structures(StructureProbe& probe) const override { between_structures_.probe(probe); }
  void for_each_near_cell_pair(double margin,
                               Visit<const geometry::CellPair&> visit) const override {
    between_structures_.for_each_near(margin, visit);
  }
  void for_each_plane_pair(VisitPlane visit) const override {
    with_planes_.for_each_touching(visit);
  }
  void for_each_near_plane_pair(double margin, std::span<const Plane> planes, Positions x,
                                VisitPlane visit) const override {
    with_planes_.for_each_near(margin, planes, x, visit);
  }
  PairStiffness stiffness(const BodyPart& a, const BodyPart& b, double gap,
                          double count) const override {
    const auto parameters = AnyLaw::scaled(materials_.pairs.combine(a, b), count);
    return PairSprings(parameters).stiffness(gap);
  }

  std::int64_t list_count() const noexcept override { return list_count_; }
  const geometry::Neighbours& neighbours() const noexcept override { return neighbours_; }
  const geometry::CellNeighbours& cell_neighbours() const noexcept override {
    return cell_neighbours_;
  }

 private:
  /// In the order in which contacts have their numbers and are told of.
  template <class Visit>
  void for_each_kind(const Visit& visit) const {
    visit(with_spheres_);
    visit(with_surfaces_);
    visit(between_structures_);
    visit(with_planes_);
  }
  template <class Visit>
  void for_each_kind(const Visit& visit) {
    visit(with_spheres_);
    visit(with_surfaces_);
    visit(between_structures_);
    visit(with_planes_);
  }
  bool look_at_lists(const Motion& motion, geometry::ThreadPool& pool);
  double list_on_surfaces();
  void share_out();
  void add(const EnergyLoss& loss) noexcept {
    dissipated_ += loss.dissipated;
    tracking_loss_ += loss.tracking;
  }
  void end_start(std::span<const Plane> planes, geometry::ThreadPool& pool);
  void exchange_start(const geometry::StateArchive& archive);
  void exchange_sums(const geometry::StateArchive& archive);
  void exchange_of_spheres(const geometry::StateArchive& archive, geometry::ThreadPool& pool);
  void exchange_of_structures(const geometry::StateArchive& archive, geometry::ThreadPool& pool);
  void exchange_of_planes(const geometry::StateArchive& archive, std::span<const Plane> planes);
  bool lists_same_spheres(const SceneContacts& before, const BodyPlaces& places) const;
  std::vector<std::int32_t> places_at_planes(const SceneContacts& before,
                                             const BodyPlaces& places) const;

  ContactMaterials materials_;
  std::uint64_t materials_hash_;  ///< as they were at the start
  /// The spheres, then the nodes of the surface. These keep their structures when their last
  /// elements are gone.
  std::vector<SphereBody> spheres_;
  geometry::Neighbours neighbours_;
  geometry::CellNeighbours cell_neighbours_;
  PlaneNeighbours plane_neighbours_;
  SphereContacts with_spheres_;
  SurfaceContacts with_surfaces_;
  StructureContacts between_structures_;
  PlaneContacts with_planes_;
  const geometry::Surface* surface_;
  double dissipated_ = 0.0;
  double tracking_loss_ = 0.0;
  std::int64_t last_number_ = 0;
  std::int64_t list_count_ = 0;
  enum class Start { ahead, now, over } start_ = Start::ahead;
  bool is_shared_out_ = false;         ///< what is on the lists of spheres and planes now
  std::optional<bool> are_lists_due_;  ///< of spheres; nothing: was not asked in this step
};

}  // namespace plekton::contact
