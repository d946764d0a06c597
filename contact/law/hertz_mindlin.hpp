// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/curvature.hpp"
#include "contact/law/contact_law.hpp"
#include "contact/law/tangential_spring.hpp"

#include <algorithm>
#include <type_traits>

namespace plekton::contact {

/// Elastic bodies. With the overlap d, the radius R of their curvature against each other
/// (curvature.hpp) and the moduli 1/E* = (1 - nu_a^2)/E_a + (1 - nu_b^2)/E_b,
/// 1/G* = (2 - nu_a)/G_a + (2 - nu_b)/G_b: normal force 4/3 E* sqrt(R) d^(3/2), tangential
/// stiffness 8 G* sqrt(R d) without slip inside the contact area, limited to tan(phi) times the
/// normal force. Johnson, Contact Mechanics (1985), sections 4.2 and 7.2.
///
/// Of an ellipse the ratio of both stiffnesses is taken as that of a circle: it depends on the
/// direction of the slip, little unless the ellipse is long (Johnson, section 7.2).
struct HertzMindlin : LawDefaults {
  static constexpr std::string_view name = "hertz_mindlin";

  template <class Real>
  struct ParametersOf {
    Real modulus;        ///< Pa, E*
    Real shear_modulus;  ///< Pa, G*
    Real radius;         ///< m, R: hertz_radius()
    Real friction;       ///< tan(phi), of the smoother body
  };
  using Parameters = ParametersOf<double>;

  template <class Real>
  struct HistoryOf {
    TangentialSpringOf<Real> spring;
  };
  using History = HistoryOf<double>;

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

  static Parameters scaled(const Parameters& p, double count) noexcept {
    return {count * p.modulus, count * p.shear_modulus, p.radius, p.friction};
  }

  template <class Real>
  PLEKTON_INLINE static Real elastic_normal_force(const ParametersOf<Real>& p,
                                                  const std::type_identity_t<Real>& gap) noexcept {
    return Real(4.0 / 3.0) * p.modulus * contact_radius(p, gap) * overlap(gap);
  }
  static double elastic_normal_energy(const Parameters& p, double gap) noexcept {
    const double d = overlap(gap);
    return 8.0 / 15.0 * p.modulus * contact_radius(p, gap) * d * d;
  }

  template <class Real>
  PLEKTON_INLINE static ContactForceOf<Real> force(const ParametersOf<Real>& p,
                                                   const RelativeMotionOf<Real>& motion,
                                                   HistoryOf<Real>& history, double dt) noexcept {
    const Real limit = p.friction * motion.elastic_normal_force;
    const Vec3Of<Real> slip = Real(dt) * motion.slip_velocity;
    const Real dissipated =
        history.spring.advance(slip, tangential_stiffness(p, motion.gap), limit);
    return {motion.elastic_normal_force * motion.normal + history.spring.force, dissipated};
  }

  /// See TellsForce.
  static Vec3 force_of_state(const Parameters& p, double gap, const Vec3& normal,
                             const History& history) noexcept {
    return elastic_normal_force(p, gap) * normal + history.spring.force;
  }

  static double tangential_limit(const Parameters& p, double elastic_force,
                                 const History&) noexcept {
    return p.friction * elastic_force;
  }

  template <class Real>
  PLEKTON_INLINE static Real history_energy(const ParametersOf<Real>&,
                                            const HistoryOf<Real>& history) noexcept {
    return history.spring.energy();
  }

  template <class Real>
  PLEKTON_INLINE static Real normal_stiffness(const ParametersOf<Real>& p,
                                              const std::type_identity_t<Real>& gap) noexcept {
    return Real(2.0) * p.modulus * contact_radius(p, gap);
  }
  template <class Real>
  PLEKTON_INLINE static Real tangential_stiffness(const ParametersOf<Real>& p,
                                                  const std::type_identity_t<Real>& gap) noexcept {
    return Real(8.0) * p.shear_modulus * contact_radius(p, gap);
  }

  template <class Real>
  PLEKTON_INLINE static void rotate(HistoryOf<Real>& history,
                                    const FrameRotationOf<Real>& rotation) noexcept {
    history.spring.force = rotation(history.spring.force);
  }
  static void scale_history(History& history, double factor) noexcept {
    history.spring.scale_history(factor);
  }
  static void accumulate_history(History& history, const History& other, double share) noexcept {
    history.spring.accumulate_history(other.spring, share);
  }

 private:
  template <class Real>
  PLEKTON_INLINE static Real overlap(const Real& gap) noexcept {
    return geometry::positive_part(Real(-gap));
  }
  /// m, of the circle in which the bodies touch.
  template <class Real>
  PLEKTON_INLINE static Real contact_radius(const ParametersOf<Real>& p,
                                            const std::type_identity_t<Real>& gap) noexcept {
    return geometry::square_root(Real(p.radius * overlap(gap)));
  }
};

static_assert(ContactLaw<HertzMindlin>);

}  // namespace plekton::contact
