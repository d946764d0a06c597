// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contacts.hpp"
#include "dynamics/model/scene.hpp"
#include "dynamics/state/nodal_stiffness.hpp"
#include "dynamics/time_step/coming_partner.hpp"
#include "geometry/primitives/elements.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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
  ComingPartner partner;    ///< whose normal stiffness this is

  void take(double other_normal, double other_tangential, const ComingPartner& with) noexcept {
    if (other_normal > normal) partner = with;
    normal = std::max(normal, other_normal);
    tangential = std::max(tangential, other_tangential);
  }
};

class ExpectedContacts {
 public:
  ExpectedContacts(const Scene& scene, const geometry::Surface& surface,
                   const contact::Contacts& contacts)
      : scene_(scene), surface_(surface), contacts_(contacts) {
    collect_structures();
    collect_kinds();
    collect_extents();
  }

  /// By NodeId. Spheres as if packed densely among the hardest they can meet, nodes of surfaces as
  /// if touched by the hardest.
  std::vector<IsotropicStiffness> of_nodes() const {
    std::vector<IsotropicStiffness> stiffness(surface_.node_count());
    for (std::size_t i = 0; i < scene_.elements.spheres.size(); ++i) {
      const geometry::Sphere& sphere = scene_.elements.spheres[i];
      const ExpectedStiffness k = hardest_partner({scene_.sphere_materials[i], sphere.radius});
      stiffness[index_of(sphere.nodes[0])] =
          in_dense_packing(k.normal, k.tangential, sphere.radius);
    }
    for (std::size_t n = 0; n < surface_.node_count(); ++n) {
      const auto node = geometry::id_at<NodeId>(n);
      if (surface_.structure_of(node) != geometry::StructureId{-1}) stiffness[n] = of_touch(node);
    }
    return stiffness;
  }

  /// By NodeId, of structures: with another one, or itself, that lies on all that is around a node.
  std::vector<IsotropicStiffness> of_structures() const {
    std::vector<IsotropicStiffness> stiffness(surface_.node_count());
    for (std::size_t n = 0; n < surface_.node_count(); ++n) {
      const geometry::StructureId own = surface_.structure_of(geometry::id_at<NodeId>(n));
      if (own == geometry::StructureId{-1}) continue;
      ExpectedStiffness hardest;
      for (std::size_t i = 0; i < structures_.size(); ++i)
        take_structure(geometry::id_at<NodeId>(n), i, hardest);
      stiffness[n] = from_all_sides(2.0 * hardest.normal, 2.0 * hardest.tangential,
                                    structures_[index_of(own)].radius);
    }
    return stiffness;
  }

  /// A step (s) that follows collisions of all spheres that are free: min sqrt(m / (8 k)), k the
  /// stiffness of the hardest contact with one of its size, a structure or a plane. One of two
  /// equal spheres takes 6 such steps, one with a wall 9: the energy that a leapfrog is off by as a
  /// contact begins and ends is (omega dt)² / 4 of that of the collision at most. Infinite without
  /// free spheres.
  double collision_step() const {
    double shortest = std::numeric_limits<double>::infinity();
    const RigidNodes rigid(scene_.rigid_bodies, scene_.state, scene_.properties);
    for (std::size_t i = 0; i < scene_.elements.spheres.size(); ++i) {
      const geometry::Sphere& sphere = scene_.elements.spheres[i];
      const double lightness = lightness_of(sphere.nodes[0], rigid);
      if (lightness == 0.0) continue;
      const double k = hardest_partner({scene_.sphere_materials[i], sphere.radius}).normal;
      if (k > 0.0) shortest = std::min(shortest, std::sqrt(1.0 / (8.0 * k * lightness)));
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
      if (sphere.nodes[0] == node)
        return hardest_partner({scene_.sphere_materials[i], sphere.radius}).partner;
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
  };
  /// Of so many contacts of two kinds side by side.
  contact::PairStiffness stiffness(const Kind& a, const Kind& b, double count = 1.0) const {
    const double gap = -kExpectedOverlap * std::min(a.radius, b.radius);
    return contacts_.stiffness({.material = a.material, .radius = a.radius, .shape = a.shape},
                               {.material = b.material, .radius = b.radius, .shape = b.shape}, gap,
                               count);
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
    const auto [normal, tangential] = stiffness(a, b);
    hardest.take(normal, tangential, with);
  }

  void collect_structures() {
    structures_.resize(surface_.structure_count());
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
  }

  /// The smallest and the largest spheres of each material.
  void collect_kinds() {
    std::vector<Kind> smallest(scene_.materials.size());
    std::vector<Kind> largest(scene_.materials.size());
    for (std::size_t i = 0; i < scene_.elements.spheres.size(); ++i) {
      const auto material = scene_.sphere_materials[i];
      const double radius = scene_.elements.spheres[i].radius;
      Kind& least = smallest[static_cast<std::size_t>(material)];
      Kind& most = largest[static_cast<std::size_t>(material)];
      if (least.radius == 0.0 || radius < least.radius) least = {material, radius};
      if (radius > most.radius) most = {material, radius};
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
    for (std::size_t i = 0; i < structures_.size(); ++i) {
      if (geometry::id_at<geometry::StructureId>(i) != surface_.structure_of(node))
        take_structure(node, i, hardest);
    }
    return hardest;
  }
  void take_structure(NodeId node, std::size_t i, ExpectedStiffness& hardest) const {
    const Kind& own = structures_[index_of(surface_.structure_of(node))];
    const Kind& other = structures_[i];
    const double range = own.radius + other.radius;
    const double count =
        1.0 + length_[index_of(node)] / range + area_[index_of(node)] / (range * range);
    const auto [normal, tangential] = stiffness(own, other, count);
    hardest.take(normal, tangential, structure(i));
  }

  ExpectedStiffness hardest_partner(const Kind& sphere) const {
    ExpectedStiffness hardest;
    // Of spheres, one as large as itself: in_dense_packing says why this covers other sizes.
    for (const Kind& other : kinds_) {
      const Kind equal{other.material, sphere.radius};
      take(sphere, equal, balls(equal), hardest);
    }
    for (std::size_t i = 0; i < structures_.size(); ++i)
      take(sphere, structures_[i], structure(i), hardest);
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
      take({own.material, own.radius}, plane_under(i, own.radius), plane(i), touch.plane);
    touch.structure = hardest_structure(node);
    return touch;
  }

  /// The hardest grain, with its full weight, from one side, another structure, and a plane from
  /// the other. More grains on the same node come one after the other: the step is looked at again
  /// before they have arrived.
  IsotropicStiffness of_touch(NodeId node) const {
    const auto [grain, plane, other] = touch_of(node);
    return from_all_sides(2.0 * (grain.normal + other.normal) + plane.normal,
                          2.0 * (grain.tangential + other.tangential) + plane.tangential,
                          structures_[index_of(surface_.structure_of(node))].radius);
  }

  const Scene& scene_;
  const geometry::Surface& surface_;
  const contact::Contacts& contacts_;
  std::vector<Kind> structures_;
  std::vector<Kind> kinds_;
  std::vector<double> length_;  ///< m, of cylinders, by node
  std::vector<double> area_;    ///< m², of facets, by node
};

}  // namespace plekton::dynamics
