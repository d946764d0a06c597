// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/laws/contact_part.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::contact {

/// A dashpot along the normal, as strong as a restitution wants it: c = 2 xi sqrt(m k), with the
/// reduced mass m of both bodies, the present stiffness k, and the damping ratio xi of
/// restitution.hpp. It never makes the contact pull.
///
/// A surface that a ball meets counts as held: of a light free membrane the restitution is lower.
struct Dashpot {
  static constexpr std::string_view name = "dashpot";

  struct Properties {
    double damping_ratio = 0.0;  ///< xi >= 0; damping_ratio() gives that of a restitution
  };
  struct Parameters {
    double damping_ratio;
    double strength;  ///< sqrt(kg), 2 xi sqrt(m); 0 without mass
  };
  struct History {
    double push = 0.0;  ///< N, of the last step, along the normal
  };

  static Parameters combine(const Properties& properties, const Body& a, const Body& b) noexcept {
    const double mass = reduced_mass(a, b);
    const double xi = properties.damping_ratio;
    return {xi, std::isfinite(mass) ? 2.0 * xi * std::sqrt(mass) : 0.0};
  }
  /// Springs side by side carry one mass.
  static Parameters multiplied(const Parameters& p, double) noexcept { return p; }

  /// The dashpot is one for a contact as a whole, not for its bonds.
  static Parameters of_bond(const Parameters& p) noexcept { return {p.damping_ratio, 0.0}; }

  static ContactForce force(const Parameters& p, const RelativeMotion& motion,
                            const ContactStiffness& stiffness, History& history,
                            double dt) noexcept {
    const double before = history.push;
    const double push = -p.strength * std::sqrt(stiffness.normal) * motion.gap_rate;
    history.push = std::max(push, -motion.elastic_normal_force);
    return {history.push * motion.normal, -0.5 * (before + history.push) * motion.gap_rate * dt};
  }

  static double history_energy(const Parameters&, const History&) noexcept { return 0.0; }

  /// The step of the leapfrog with a damping that lags behind by half a step is shorter by
  /// sqrt(1 + xi^2) - xi. Belytschko, Liu & Moran, Nonlinear Finite Elements (2000), section 6.2.
  static ContactStiffness effective(const Parameters& p,
                                    const ContactStiffness& stiffness) noexcept {
    const double shorter = std::sqrt(1.0 + p.damping_ratio * p.damping_ratio) - p.damping_ratio;
    return {stiffness.normal / (shorter * shorter), stiffness.tangential};
  }

  static void rotate(History&, const FrameRotation&) noexcept {}
  static void add_share(History& history, const History& other, double share) noexcept {
    history.push += share * other.push;
  }
};

static_assert(ContactPart<Dashpot>);

}  // namespace plekton::contact
