// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/sphere_surface/patch_contacts.hpp"
#include "contact/sphere_surface/sphere_surface_pair.hpp"
#include "contact/tracking/contact_record.hpp"
#include "contact/tracking/force_records.hpp"
#include "contact/tracking/slip_state.hpp"
#include "geometry/neighbor/broad_phase.hpp"

#include <span>

namespace plekton::contact {

/// A contact of a sphere (a) with a surface (b) as it is reported: the sum of what its terms do, so
/// that all rows together do what has been done to the nodes.
/// @param key      sphere and structure
/// @param records  of the contact; the first is that of the deepest minimum
/// @param x        m, of all nodes
inline ContactRecord row_of(const SphereSurfacePair& pair, const geometry::IndexPair& key,
                            const PatchContact& contact, std::span<const SurfaceForce> records,
                            Positions x) {
  Vec3 force = Vec3::Zero();
  Vec3 torque = Vec3::Zero();  // on the sphere, about its centre
  for (const SurfaceForce& record : records) {
    force += record.force;
    torque += record.torque_a;
  }
  const double distance = pair.range + contact.gap;
  const Vec3 lever = distance > 0.0
                         ? Vec3((pair.radius + 0.5 * contact.gap) / distance * contact.foot)
                         : Vec3(Vec3::Zero());
  const Vec3& centre = x[index_of(pair.node)];
  ContactRecord row;
  row.id = contact.id;
  row.a = {BodyKind::sphere, key.a, Feature(pair.node)};
  row.b = {BodyKind::structure, key.b, records.front().core.feature};
  row.point_a = centre;
  row.point_b = centre + contact.foot;
  row.point = centre + lever;
  row.normal = contact.memory.normal;
  row.gap = contact.gap;
  set_force(row, force);
  row.moment = records.size() > 1 ? Vec3(-torque - lever.cross(force))
                                  : AnyLaw::moment(contact.memory.history, row.normal);
  set_state<AnyLaw>(row, pair.parameters, contact.memory.history, contact.elastic_force);
  return row;
}

}  // namespace plekton::contact
