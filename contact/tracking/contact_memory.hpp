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

/// How body b moved relative to body a in the step that ends their contact.
struct LastDisplacement {
  Vec3 translation = Vec3::Zero();  ///< m, at the contact point
  Vec3 rotation = Vec3::Zero();     ///< rad
};

/// The energy (J) that is lost with a contact: what its history still held, less what its last force
/// and moment do. In a leapfrog these go on for half of the step that ends it. The elastic normal
/// force does too, but has a potential, which is 0 then.
template <ContactLaw Law>
double loss_at_end(const typename Law::Parameters& parameters, const ContactMemory<Law>& memory,
                   const LastDisplacement& last) noexcept {
  const Vec3 force = other_force<Law>(parameters, memory.normal, memory.history);
  const Vec3 moment = moment_of<Law>(memory.history, memory.normal);
  return Law::history_energy(parameters, memory.history) -
         0.5 * (force.dot(last.translation) + moment.dot(last.rotation));
}

/// Ends a contact. @returns the energy (J) that is lost
template <ContactLaw Law>
double forget(const typename Law::Parameters& parameters, ContactMemory<Law>& memory,
              const LastDisplacement& last) noexcept {
  if (memory.is_new()) return 0.0;
  const double lost = loss_at_end<Law>(parameters, memory, last);
  memory = {};
  return lost;
}

}  // namespace plekton::contact
