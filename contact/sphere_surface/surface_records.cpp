// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts of spheres with surfaces as they are reported.
#include "contact/sphere_surface/surface_contacts.hpp"
#include "contact/tracking/contact_state.hpp"
#include "contact/tracking/slip_state.hpp"

namespace plekton::contact {

void SurfaceContacts::assign_ids(std::int64_t& last) {
  for (Lists& lists : current_) {
    for (Contact& contact : lists.contacts) {
      if (contact.id == 0) contact.id = ++last;
    }
  }
}

void SurfaceContacts::for_each_record(Positions x, VisitRecord visit) const {
  for (std::size_t w = 0; w < records_.lists().size(); ++w) {
    const auto& list = records_.lists()[w];
    const std::span<const SurfaceForce> records{list.records.data(), list.count};
    for (std::size_t begin = 0; begin < records.size();) {
      const std::uint32_t contact = records[begin].contact;
      std::size_t end = begin + 1;
      while (end < records.size() && records[end].contact == contact) ++end;
      visit(row_of(records.subspan(begin, end - begin), current_[w].contacts[contact], x));
      begin = end;
    }
  }
}

/// The sum of what its terms do, so that all rows together do what has been done to the nodes.
/// @param records  of the contact; the first is that of the deepest minimum
ContactRecord SurfaceContacts::row_of(std::span<const SurfaceForce> records, const Contact& contact,
                                      Positions x) const {
  const SurfaceForce& deepest = records.front();
  const Pair& pair = pairs_[deepest.pair];
  const geometry::IndexPair& key = rekey_.key(deepest.pair);
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
  row.b = {BodyKind::structure, key.b, deepest.core.feature};
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
