// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contacts.hpp"
#include "contact/surface_surface/mean_node_masses.hpp"
#include "dynamics/model/scene.hpp"
#include "dynamics/model/scene_figures.hpp"
#include "dynamics/stiffness/nodal_stiffness.hpp"
#include "dynamics/time_step/coming_partner.hpp"
#include "geometry/primitives/elements.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <vector>

/// Contacts that a scene may come to have, for a time step that stays safe when they begin: a light
/// sheet on which a stiff grain lands needs a much shorter step than the sheet alone.
namespace plekton::dynamics {

/// Overlap over the smaller radius at which contacts to come are taken to be as stiff as they get.
/// Those that get stiffer with the overlap are looked at again when they are there.
inline constexpr double kExpectedOverlap = 0.02;

/// The hardest contact of a kind.
struct ExpectedStiffness {
  double normal = 0.0;      ///< N/m
  double tangential = 0.0;  ///< N/m
  double damping = 0.0;     ///< N s/m, along the normal
  ComingPartner partner;    ///< whose normal stiffness this is

  void take(const contact::PairStiffness& other, const ComingPartner& with) noexcept {
    if (other.normal > normal) partner = with;
    normal = std::max(normal, other.normal);
    tangential = std::max(tangential, other.tangential);
    damping = std::max(damping, other.normal_damping);
  }
};

/// What may come to hold a node.
struct ExpectedOfNode {
  IsotropicStiffness stiffness;
  double damping = 0.0;  ///< N s/m, of its translation

  /// @param rate  1/s, dashpot_rate()
  IsotropicStiffness with_dashpots(double rate) const noexcept {
    return {stiffness.translation + rate * damping, stiffness.rotation};
  }
};

class ExpectedContacts {
 public:
  ExpectedContacts(const Scene& scene, const geometry::Surface& surface,
                   const contact::Contacts& contacts)
      : scene_(scene), surface_(surface), contacts_(contacts), masses_(contact_masses(scene)) {
    collect_structures();
    collect_kinds();
    collect_extents();
  }

  /// By NodeId. Spheres as if packed densely among the hardest they can meet, nodes of surfaces as
  /// if touched by the hardest.
  std::vector<ExpectedOfNode> of_nodes() const {
    std::vector<ExpectedOfNode> expected(surface_.node_count());
    for (std::size_t i = 0; i < scene_.elements.spheres.size(); ++i) {
      const double radius = scene_.elements.spheres[i].radius;
      const ExpectedStiffness k = hardest_partner(kind_of_sphere(i));
      expected[index_of(scene_.elements.spheres[i].nodes[0])] = {
          in_dense_packing(k.normal, k.tangential, radius),
          in_dense_packing(k.damping, 0.0, radius).translation};
    }
    for (std::size_t n = 0; n < surface_.node_count(); ++n) {
      const auto node = geometry::id_at<NodeId>(n);
      if (surface_.structure_of(node) != geometry::StructureId{-1}) expected[n] = of_touch(node);
    }
    return expected;
  }

  /// By NodeId, of structures: with another one, or itself, that lies on all that is around a node.
  std::vector<ExpectedOfNode> of_structures() const {
    std::vector<ExpectedOfNode> expected(surface_.node_count());
    for (std::size_t n = 0; n < surface_.node_count(); ++n) {
      const geometry::StructureId own = surface_.structure_of(geometry::id_at<NodeId>(n));
      if (own == geometry::StructureId{-1}) continue;
      ExpectedStiffness hardest;
      for (const Alike& alike : alike_)
        take_structure(geometry::id_at<NodeId>(n), alike.first, hardest);
      const double radius = structures_[index_of(own)].radius;
      expected[n] = {from_all_sides(2.0 * hardest.normal, 2.0 * hardest.tangential, radius),
                     from_all_sides(2.0 * hardest.damping, 0.0, radius).translation};
    }
    return expected;
  }

  /// A step (s) that follows collisions of all spheres that are free: min sqrt(m / (8 k)), k the
  /// stiffness of the hardest contact with one of its size, a structure or a plane. One of two
  /// equal spheres takes 6 such steps, one with a wall 9: the energy that a leapfrog is off by as a
  /// contact begins and ends is (omega dt)² / 4 of that of the collision at most. Shorter with a
  /// dashpot, by as much as a stable step is. Infinite without free spheres.
  double collision_step() const {
    double shortest = std::numeric_limits<double>::infinity();
    const RigidNodes rigid(scene_.rigid_bodies, scene_.state, scene_.properties);
    for (std::size_t i = 0; i < scene_.elements.spheres.size(); ++i) {
      const geometry::Sphere& sphere = scene_.elements.spheres[i];
      const double lightness = lightness_of(sphere.nodes[0], rigid);
      if (lightness == 0.0) continue;
      const ExpectedStiffness k = hardest_partner(kind_of_sphere(i));
      if (!(k.normal > 0.0)) continue;
      const double xi = 0.5 * k.damping * std::sqrt(lightness / k.normal);
      const double shorter = std::sqrt(1.0 + xi * xi) - xi;
      shortest = std::min(shortest, shorter * std::sqrt(1.0 / (8.0 * k.normal * lightness)));
    }
    return shortest;
  }

  /// The stiffest contact that a node may come to have. Linear in the number of spheres.
  ComingPartner partner_of(NodeId node) const {
    if (surface_.structure_of(node) != geometry::StructureId{-1}) {
      const auto [grain, plane, other] = touch_of(node);
      if (2.0 * std::max(grain.normal, other.normal) <= plane.normal) return plane.partner;
      return grain.normal >= other.normal ? grain.partner : other.partner;
    }
    for (std::size_t i = 0; i < scene_.elements.spheres.size(); ++i) {
      const geometry::Sphere& sphere = scene_.elements.spheres[i];
      if (sphere.nodes[0] == node) return hardest_partner(kind_of_sphere(i)).partner;
    }
    return {};
  }

 private:
  /// 1/kg, one over the mass that a push on a sphere moves; of a rigid body the mean of all
  /// directions. 0 where it is held.
  double lightness_of(NodeId node, const RigidNodes& rigid) const {
    if (const std::int32_t body = rigid.body_followed_by(node); body >= 0)
      return rigid.point_mobility(body, rigid.lever_of(node)).trace() / 3.0;
    const std::size_t i = index_of(node);
    return holds_translation(scene_.properties.held[i]) ? 0.0 : 1.0 / scene_.properties.mass[i];
  }

  struct Kind {
    contact::MaterialId material;
    double radius;
    contact::Shape shape = contact::Shape::sphere;
    double mass = std::numeric_limits<double>::infinity();  ///< kg, see contact::Body

    contact::BodyPart part() const noexcept { return {material, radius, mass, shape}; }
  };
  Kind kind_of_sphere(std::size_t i) const {
    const geometry::Sphere& sphere = scene_.elements.spheres[i];
    return {scene_.sphere_materials[i], sphere.radius, contact::Shape::sphere,
            masses_[index_of(sphere.nodes[0])]};
  }
  /// Of so many contacts of two kinds side by side.
  contact::PairStiffness stiffness(const Kind& a, const Kind& b, double count = 1.0) const {
    const double gap = -kExpectedOverlap * std::min(a.radius, b.radius);
    return contacts_.stiffness(a.part(), b.part(), gap, count);
  }
  /// To a contact a plane has the radius of what meets it.
  Kind plane_under(std::size_t id, double radius) const {
    return {scene_.planes[id].material, radius, contact::Shape::flat};
  }

  static ComingPartner balls(const Kind& kind) {
    return {ComingPartner::Kind::balls, kind.material, kind.radius, 0};
  }
  ComingPartner structure(std::size_t id) const {
    return {ComingPartner::Kind::structure, structures_[id].material, structures_[id].radius, id};
  }
  ComingPartner plane(std::size_t id) const {
    return {ComingPartner::Kind::plane, scene_.planes[id].material, 0.0, id};
  }

  /// @param with  what b is
  void take(const Kind& a, const Kind& b, const ComingPartner& with,
            ExpectedStiffness& hardest) const {
    hardest.take(stiffness(a, b), with);
  }

  void collect_structures() {
    structures_.resize(surface_.structure_count());
    structure_masses_ = contact::structure::mean_node_masses(surface_, masses_);
    const auto set = [&](NodeId node, contact::MaterialId material, double radius) {
      const geometry::StructureId structure = surface_.structure_of(node);
      structures_[index_of(structure)] = {material, radius, contact::shape_of(surface_, structure)};
    };
    for (std::size_t i = 0; i < scene_.elements.facets.size(); ++i) {
      const auto& facet = scene_.elements.facets[i];
      set(facet.nodes[0], scene_.facet_materials[i], facet.radius);
    }
    for (std::size_t i = 0; i < scene_.elements.cylinders.size(); ++i) {
      const auto& cylinder = scene_.elements.cylinders[i];
      set(cylinder.nodes[0], scene_.cylinder_materials[i], cylinder.radius);
    }
    collect_alike();
  }

  /// Structures to which all that is asked here is the same: the first and another one, or the first
  /// again.
  struct Alike {
    std::size_t first;
    std::size_t second;
  };
  /// In the order of the first of each.
  void collect_alike() {
    const auto key_of = [&](std::size_t i) {
      const Kind& kind = structures_[i];
      return std::tuple(kind.material, kind.radius, kind.shape, structure_masses_[i]);
    };
    std::map<decltype(key_of(0)), std::size_t> places;
    for (std::size_t i = 0; i < structures_.size(); ++i) {
      const auto [place, is_new] = places.emplace(key_of(i), alike_.size());
      if (is_new)
        alike_.push_back({i, i});
      else if (Alike& alike = alike_[place->second]; alike.second == alike.first)
        alike.second = i;
    }
  }

  /// The smallest and the largest spheres of each material.
  void collect_kinds() {
    std::vector<Kind> smallest(scene_.materials.size());
    std::vector<Kind> largest(scene_.materials.size());
    for (std::size_t i = 0; i < scene_.elements.spheres.size(); ++i) {
      const Kind kind = kind_of_sphere(i);
      Kind& least = smallest[static_cast<std::size_t>(kind.material)];
      Kind& most = largest[static_cast<std::size_t>(kind.material)];
      if (least.radius == 0.0 || kind.radius < least.radius) least = kind;
      if (kind.radius > most.radius) most = kind;
    }
    for (const auto& kinds : {smallest, largest}) {
      for (const Kind& kind : kinds) {
        if (kind.radius > 0.0) kinds_.push_back(kind);
      }
    }
  }

  /// What of its structure lies around each node.
  void collect_extents() {
    length_.assign(surface_.node_count(), 0.0);
    area_.assign(surface_.node_count(), 0.0);
    const auto& x = scene_.state.position;
    for (std::size_t f = 0; f < surface_.face_count(); ++f) {
      const auto& nodes = surface_.nodes_of(geometry::id_at<geometry::FaceId>(f));
      const Vec3 side = x[index_of(nodes[1])] - x[index_of(nodes[0])];
      const double area = 0.5 * side.cross(x[index_of(nodes[2])] - x[index_of(nodes[0])]).norm();
      for (const NodeId node : nodes) area_[index_of(node)] += area / 3.0;
    }
    for (const auto& cylinder : scene_.elements.cylinders) {
      const Vec3 along = x[index_of(cylinder.nodes[1])] - x[index_of(cylinder.nodes[0])];
      for (const NodeId node : cylinder.nodes) length_[index_of(node)] += 0.5 * along.norm();
    }
  }

  /// Of another structure that lies on all that is around the node (surface_surface/extended.hpp).
  ExpectedStiffness hardest_structure(NodeId node) const {
    ExpectedStiffness hardest;
    for (const Alike& alike : alike_) {
      if (geometry::id_at<geometry::StructureId>(alike.first) != surface_.structure_of(node))
        take_structure(node, alike.first, hardest);
      else if (alike.second != alike.first)
        take_structure(node, alike.second, hardest);
    }
    return hardest;
  }
  void take_structure(NodeId node, std::size_t i, ExpectedStiffness& hardest) const {
    const std::size_t its = index_of(surface_.structure_of(node));
    Kind own = structures_[its];
    Kind other = structures_[i];
    own.mass = structure_masses_[its];
    other.mass = structure_masses_[i];
    const double range = own.radius + other.radius;
    const double count =
        1.0 + length_[index_of(node)] / range + area_[index_of(node)] / (range * range);
    hardest.take(stiffness(own, other, count), structure(i));
  }

  ExpectedStiffness hardest_partner(const Kind& sphere) const {
    ExpectedStiffness hardest;
    // Of spheres, one as large as itself: in_dense_packing says why this covers other sizes.
    for (const Kind& other : kinds_) {
      const Kind equal{other.material, sphere.radius, contact::Shape::sphere, sphere.mass};
      take(sphere, equal, balls(equal), hardest);
    }
    for (const Alike& alike : alike_)
      take(sphere, structures_[alike.first], structure(alike.first), hardest);
    for (std::size_t i = 0; i < scene_.planes.size(); ++i)
      take(sphere, plane_under(i, sphere.radius), plane(i), hardest);
    return hardest;
  }

  /// What may touch a node of a structure.
  struct Touch {
    ExpectedStiffness grain;
    ExpectedStiffness plane;
    ExpectedStiffness structure;
  };
  Touch touch_of(NodeId node) const {
    const Kind& own = structures_[index_of(surface_.structure_of(node))];
    Touch touch;
    for (const Kind& kind : kinds_) take(kind, own, balls(kind), touch.grain);
    for (std::size_t i = 0; i < scene_.planes.size(); ++i)
      take({own.material, own.radius, contact::Shape::sphere, masses_[index_of(node)]},
           plane_under(i, own.radius), plane(i), touch.plane);
    touch.structure = hardest_structure(node);
    return touch;
  }

  /// The hardest grain, with its full weight, from one side, another structure, and a plane from
  /// the other. More grains on the same node come one after the other: the step is looked at again
  /// before they have arrived.
  ExpectedOfNode of_touch(NodeId node) const {
    const auto [grain, plane, other] = touch_of(node);
    const double radius = structures_[index_of(surface_.structure_of(node))].radius;
    const double damping = 2.0 * (grain.damping + other.damping) + plane.damping;
    return {from_all_sides(2.0 * (grain.normal + other.normal) + plane.normal,
                           2.0 * (grain.tangential + other.tangential) + plane.tangential, radius),
            from_all_sides(damping, 0.0, radius).translation};
  }

  const Scene& scene_;
  const geometry::Surface& surface_;
  const contact::Contacts& contacts_;
  std::vector<double> masses_;            ///< kg, by node
  std::vector<Kind> structures_;          ///< a surface that a sphere meets counts as held
  std::vector<Alike> alike_;              ///< of the structures
  std::vector<double> structure_masses_;  ///< kg, mean of their nodes: where two of them meet
  std::vector<Kind> kinds_;
  std::vector<double> length_;  ///< m, of cylinders, by node
  std::vector<double> area_;    ///< m², of facets, by node
};

}  // namespace plekton::dynamics
