// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/contact_law.hpp"

namespace plekton::contact {

/// What a contact keeps from one step to the next.
template <ContactLaw Law>
struct ContactMemory {
  typename Law::History history;
  Vec3 normal = Vec3::Zero();  ///< unit, of the last step; zero before the first

  bool is_new() const noexcept { return normal.isZero(0.0); }
};

/// The history of a contact, turned from its last normal into a new contact frame.
/// @param twist  rad, rotation of both bodies about the new normal during the step (mean)
template <ContactLaw Law>
typename Law::History carried_history(const ContactMemory<Law>& memory, const Vec3& normal,
                                      double twist) noexcept {
  if (memory.is_new()) return {};
  typename Law::History history = memory.history;
  Law::rotate(history, FrameRotation{memory.normal, normal, twist});
  return history;
}

/// Ends a contact. @returns the energy (J) its history still held, which is lost
/// @param parting  m, by how much the bodies parted along the normal of the last step since then
template <ContactLaw Law>
double forget(const typename Law::Parameters& parameters, ContactMemory<Law>& memory,
              double parting) noexcept {
  if (memory.is_new()) return 0.0;
  const double lost =
      Law::history_energy(parameters, memory.history) + loss_after<Law>(memory.history, parting);
  memory = {};
  return lost;
}

}  // namespace plekton::contact
