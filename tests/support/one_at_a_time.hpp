// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contact_law.hpp"

namespace plekton::test {

/// A law as it would be written for one contact at a time: the plain twin of one for contacts side
/// by side.
template <contact::ContactLaw Law>
struct OneAtATime {
  static constexpr std::string_view name = Law::name;
  using Parameters = typename Law::Parameters;
  using History = typename Law::History;

  static Parameters combine(const contact::Body& a, const contact::Body& b) {
    return Law::combine(a, b);
  }
  static Parameters multiplied(const Parameters& p, double count) {
    return Law::multiplied(p, count);
  }
  static double elastic_normal_force(const Parameters& p, double gap) {
    return Law::elastic_normal_force(p, gap);
  }
  static double elastic_normal_energy(const Parameters& p, double gap) {
    return Law::elastic_normal_energy(p, gap);
  }
  static contact::ContactForce force(const Parameters& p, const contact::RelativeMotion& motion,
                                     History& history, double dt) {
    return Law::force(p, motion, history, dt);
  }
  static double history_energy(const Parameters& p, const History& history) {
    return Law::history_energy(p, history);
  }
  static double normal_stiffness(const Parameters& p, double gap) {
    return Law::normal_stiffness(p, gap);
  }
  static double tangential_stiffness(const Parameters& p, double gap) {
    return Law::tangential_stiffness(p, gap);
  }
  static void rotate(History& history, const contact::FrameRotation& rotation) {
    Law::rotate(history, rotation);
  }
  static void add_share(History& history, const History& other, double share) {
    Law::add_share(history, other, share);
  }
};

}  // namespace plekton::test
