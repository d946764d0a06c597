// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/surface_contacts_state.hpp"

#include "contact/tracking/contact_state.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace plekton::contact {
namespace {

void exchange_contact(geometry::RowFields& row, SurfaceContactsState::Contact& kept,
                      const geometry::Surface& surface, SurfaceContactsState::LawOf law_of) {
  std::array<std::int32_t, 2> pair{kept.pair.a, kept.pair.b};
  row("pair", pair);
  kept.pair = {pair[0], pair[1]};
  PatchContact& contact = kept.contact;
  contact::exchange(row, contact.memory, law_of(kept.pair));
  row("foot", contact.foot);
  row("gap", contact.gap);
  row("elastic_force", contact.elastic_force);
  row("elastic_energy", contact.elastic_energy);
  row("id", contact.id);
  row("minima", kept.minima);
  row.require(std::all_of(kept.minima.begin(), kept.minima.end(),
                          [&](const geometry::Feature& minimum) { return has(surface, minimum); }),
              "minima");
}

/// But for its sphere and its pair, which follow from the contact.
void exchange_force(geometry::RowFields& row, SurfaceForce& record,
                    const geometry::Surface& surface) {
  contact::exchange(row, "core", record.core, surface);
  row("force", record.force);
  row("torque_a", record.torque_a);
  row("torque_b", record.torque_b);
  row("elastic", record.elastic);
  double share = record.share;
  row("share", share);
  record.share = static_cast<float>(share);
}

}  // namespace

void SurfaceContactsState::exchange(const geometry::StateArchive& archive,
                                    const geometry::Surface& surface, LawOf law_of) {
  archive("largest_overlap_ratio", largest_overlap_ratio);
  archive.rows("contacts", contacts, [&](geometry::RowFields& row, Contact& kept) {
    exchange_contact(row, kept, surface, law_of);
  });
  archive.rows("forces", forces, [&](geometry::RowFields& row, Force& kept) {
    row("contact", kept.contact);
    row.require(kept.contact < contacts.size(), "contact");
    exchange_force(row, kept.record, surface);
  });
}

}  // namespace plekton::contact
