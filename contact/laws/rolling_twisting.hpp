// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/laws/contact_part.hpp"
#include "contact/laws/tangential_spring.hpp"

#include <algorithm>
#include <limits>

namespace plekton::contact {

/// Resistance to rolling and twisting: springs with sliders between the rotations of both bodies.
///
/// Stiffness alpha R_a R_b k_s (N m/rad), with the tangential stiffness k_s of the contact; the
/// moment is limited to eta min(R_a, R_b) times the normal force. Bourrier, Kneib, Chareyre &
/// Fourcaud, Ecological Engineering 61 (2013) 646-657.
struct RollingTwisting {
  static constexpr std::string_view name = "rolling_twisting";
  static constexpr bool has_moments = true;

  struct Properties {
    double rolling_stiffness = 0.0;                                   ///< alpha of rolling, >= 0
    double twisting_stiffness = 0.0;                                  ///< alpha of twisting, >= 0
    double rolling_limit = std::numeric_limits<double>::infinity();   ///< eta of rolling, >= 0
    double twisting_limit = std::numeric_limits<double>::infinity();  ///< eta of twisting, >= 0
  };
  struct Parameters {
    double rolling_arms;   ///< m², alpha R_a R_b
    double twisting_arms;  ///< m²
    double rolling_arm;    ///< m, eta min(R_a, R_b)
    double twisting_arm;   ///< m
    double radius;         ///< m, the smaller one
  };
  struct History {
    TangentialSpring rolling;   ///< N m
    TangentialSpring twisting;  ///< N m; its force is (moment about the normal, 0, 0)
  };

  static Parameters combine(const Properties& properties, const Body& a, const Body& b) noexcept {
    const double arms = a.radius * b.radius;
    const double smaller = std::min(a.radius, b.radius);
    return {properties.rolling_stiffness * arms, properties.twisting_stiffness * arms,
            properties.rolling_limit * smaller, properties.twisting_limit * smaller, smaller};
  }
  /// The stiffness that comes with the contact is multiplied already.
  static Parameters multiplied(const Parameters& p, double) noexcept { return p; }

  /// Beside bonds that carry all but a part; infinity times 0 is no number.
  static Parameters beside_bonds(const Parameters& p, double part) noexcept {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    const auto limit = [&](double arm) { return arm < kNone ? part * arm : arm; };
    return {p.rolling_arms, p.twisting_arms, limit(p.rolling_arm), limit(p.twisting_arm), p.radius};
  }

  static ContactForce force(const Parameters& p, const RelativeMotion& motion,
                            const ContactStiffness& stiffness, History& history,
                            double dt) noexcept {
    const Vec3 turned = dt * motion.spin_velocity;
    const double twist = turned.dot(motion.normal);
    const auto limit = [&](double arm) {  // infinity times 0 is no number
      return arm < std::numeric_limits<double>::infinity() ? arm * motion.elastic_normal_force
                                                           : arm;
    };
    double dissipated =
        history.rolling.advance(turned - twist * motion.normal,
                                p.rolling_arms * stiffness.tangential, limit(p.rolling_arm));
    dissipated += history.twisting.advance(
        {twist, 0.0, 0.0}, p.twisting_arms * stiffness.tangential, limit(p.twisting_arm));
    return {Vec3::Zero(), dissipated, moment(history, motion.normal)};
  }

  /// See HasMoments.
  static Vec3 moment(const History& history, const Vec3& normal) noexcept {
    return history.rolling.force + history.twisting.force[0] * normal;
  }

  static double history_energy(const Parameters&, const History& history) noexcept {
    return history.rolling.energy() + history.twisting.energy();
  }

  /// A spring between rotations counts as one of the slip that has an arm of the smaller radius:
  /// never softer than it is.
  static ContactStiffness effective(const Parameters& p,
                                    const ContactStiffness& stiffness) noexcept {
    const double arms = std::max(p.rolling_arms, p.twisting_arms);
    return {stiffness.normal, (1.0 + arms / (p.radius * p.radius)) * stiffness.tangential};
  }

  static void rotate(History& history, const FrameRotation& rotation) noexcept {
    history.rolling.force = rotation(history.rolling.force);
  }
  static void add_share(History& history, const History& other, double share) noexcept {
    history.rolling.add_share(other.rolling, share);
    history.twisting.add_share(other.twisting, share);
  }
};

static_assert(ContactPart<RollingTwisting>);

}  // namespace plekton::contact
