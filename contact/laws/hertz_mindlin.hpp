// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contact_law.hpp"
#include "contact/curvature.hpp"
#include "contact/laws/tangential_spring.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::contact {

/// Elastic bodies. With the overlap d, the radius R of their curvature against each other
/// (curvature.hpp) and the moduli 1/E* = (1 - nu_a^2)/E_a + (1 - nu_b^2)/E_b,
/// 1/G* = (2 - nu_a)/G_a + (2 - nu_b)/G_b: normal force 4/3 E* sqrt(R) d^(3/2), tangential
/// stiffness 8 G* sqrt(R d) without slip inside the contact area, limited to tan(phi) times the
/// normal force. Johnson, Contact Mechanics (1985), sections 4.2 and 7.2.
///
/// Of an ellipse the ratio of both stiffnesses is taken as that of a circle: it depends on the
/// direction of the slip, little unless the ellipse is long (Johnson, section 7.2).
struct HertzMindlin {
  static constexpr std::string_view name = "hertz_mindlin";

  struct Parameters {
    double modulus;        ///< Pa, E*
    double shear_modulus;  ///< Pa, G*
    double radius;         ///< m, R: hertz_radius()
    double friction;       ///< tan(phi), of the smoother body
  };
  struct History {
    TangentialSpring spring;
  };

  static Parameters combine(const Body& a, const Body& b) noexcept {
    const Material &m = a.material, &n = b.material;
    const auto in_series = [](double x, double y) { return x * y > 0.0 ? x * y / (x + y) : 0.0; };
    const auto plane_modulus = [](const Material& of) {
      return of.young_modulus / (1.0 - of.poisson_ratio * of.poisson_ratio);
    };
    const auto slip_modulus = [](const Material& of) {
      return 0.5 * of.young_modulus / ((1.0 + of.poisson_ratio) * (2.0 - of.poisson_ratio));
    };
    return {in_series(plane_modulus(m), plane_modulus(n)),
            in_series(slip_modulus(m), slip_modulus(n)), hertz_radius(relative_radii(a, b)),
            std::min(m.friction, n.friction)};
  }

  static Parameters multiplied(const Parameters& p, double count) noexcept {
    return {count * p.modulus, count * p.shear_modulus, p.radius, p.friction};
  }

  static double elastic_normal_force(const Parameters& p, double gap) noexcept {
    return 4.0 / 3.0 * p.modulus * contact_radius(p, gap) * overlap(gap);
  }
  static double elastic_normal_energy(const Parameters& p, double gap) noexcept {
    const double d = overlap(gap);
    return 8.0 / 15.0 * p.modulus * contact_radius(p, gap) * d * d;
  }

  static ContactForce force(const Parameters& p, const RelativeMotion& motion, History& history,
                            double dt) noexcept {
    const double limit = p.friction * motion.elastic_normal_force;
    const double dissipated = history.spring.advance(dt * motion.slip_velocity,
                                                     tangential_stiffness(p, motion.gap), limit);
    return {motion.elastic_normal_force * motion.normal + history.spring.force, dissipated};
  }

  /// See TellsTangentialLimit.
  static double tangential_limit(const Parameters& p, double elastic_force,
                                 const History&) noexcept {
    return p.friction * elastic_force;
  }

  static double history_energy(const Parameters&, const History& history) noexcept {
    return history.spring.energy();
  }

  static double normal_stiffness(const Parameters& p, double gap) noexcept {
    return 2.0 * p.modulus * contact_radius(p, gap);
  }
  static double tangential_stiffness(const Parameters& p, double gap) noexcept {
    return 8.0 * p.shear_modulus * contact_radius(p, gap);
  }

  static void rotate(History& history, const FrameRotation& rotation) noexcept {
    history.spring.force = rotation(history.spring.force);
  }
  static void add_share(History& history, const History& other, double share) noexcept {
    history.spring.add_share(other.spring, share);
  }

 private:
  static double overlap(double gap) noexcept { return std::max(0.0, -gap); }
  /// m, of the circle in which the bodies touch.
  static double contact_radius(const Parameters& p, double gap) noexcept {
    return std::sqrt(p.radius * overlap(gap));
  }
};

static_assert(ContactLaw<HertzMindlin>);

}  // namespace plekton::contact
