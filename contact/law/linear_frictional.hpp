// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/contact_law.hpp"

#include <algorithm>
#include <cstdint>
#include <iosfwd>
#include <type_traits>

namespace plekton::contact {

/// Linear spring and Coulomb slider. Cundall & Strack, Geotechnique 29 (1979) 47-65.
///
/// Normal force k_n * overlap; tangential force k_s * elastic slip, limited to tan(phi) times the
/// normal force. Stiffness of a pair: springs E R of both bodies in series, k_n = 2 E_a R_a E_b R_b
/// / (E_a R_a + E_b R_b), and likewise k_s with E R times the stiffness ratio. Effeindzourou et
/// al., Geotextiles and Geomembranes 44 (2016), 2. R of a facet is half its thickness: a wall of
/// half thickness 1 mm is as soft as a grain of 1 mm, whatever touches it. Properties of a pair of
/// materials say otherwise.
struct LinearFrictional : LawDefaults {
  static constexpr std::string_view name = "linear_frictional";

  /// With what radius a sheet stands in E R.
  enum class StiffnessRadius : std::uint8_t {
    half_thickness,
    /// As flat as it is: with that of the sphere or cylinder that it meets, as a plane. On a sheet
    /// it stays half the thickness, that of the rims.
    curvature
  };
  struct Properties {
    double normal_stiffness = 0.0;      ///< N/m, of one contact; 0: from E R
    double tangential_stiffness = 0.0;  ///< N/m; 0: in the ratio to the normal one that E R gives
    StiffnessRadius radius = StiffnessRadius::half_thickness;

    friend bool operator==(const Properties&, const Properties&) = default;
  };

  static void list_problems(const Properties& given, std::ostream& out);

  template <class Real>
  struct ParametersOf {
    Real normal_stiffness;      ///< N/m
    Real tangential_stiffness;  ///< N/m
    Real friction;              ///< tan(phi), of the smoother body
  };
  using Parameters = ParametersOf<double>;

  template <class Real>
  struct HistoryOf {
    Vec3Of<Real> elastic_slip =
        Vec3Of<Real>::Zero();  ///< m, of b relative to a, tangent to the contact
  };
  using History = HistoryOf<double>;

  template <class Real>
  PLEKTON_INLINE static ParametersOf<Real> combine(
      const Material& a, const Real& radius_a, const Material& b,
      const std::type_identity_t<Real>& radius_b) noexcept {
    const Real normal_a = a.young_modulus * radius_a;
    const Real normal_b = b.young_modulus * radius_b;
    return {in_series<Real>(normal_a, normal_b),
            in_series<Real>(normal_a * a.stiffness_ratio, normal_b * b.stiffness_ratio),
            std::min(a.friction, b.friction)};
  }

  static Parameters combine(const Properties& given, const Body& a, const Body& b) noexcept {
    Parameters p = combine<double>(a.material, spring_radius(given, a, b), b.material,
                                   spring_radius(given, b, a));
    if (given.normal_stiffness > 0.0) {
      const double ratio =
          p.normal_stiffness > 0.0 ? p.tangential_stiffness / p.normal_stiffness : 0.0;
      p.normal_stiffness = given.normal_stiffness;
      p.tangential_stiffness = ratio * given.normal_stiffness;
    }
    if (given.tangential_stiffness > 0.0) p.tangential_stiffness = given.tangential_stiffness;
    return p;
  }
  /// Of materials that say no more.
  static Parameters combine(const Body& a, const Body& b) noexcept { return combine({}, a, b); }

  static Parameters scaled(const Parameters& p, double count) noexcept {
    return {count * p.normal_stiffness, count * p.tangential_stiffness, p.friction};
  }

  template <class Real>
  PLEKTON_INLINE static Real elastic_normal_force(const ParametersOf<Real>& p,
                                                  const std::type_identity_t<Real>& gap) noexcept {
    return p.normal_stiffness * geometry::positive_part(Real(-gap));
  }

  static double elastic_normal_energy(const Parameters& p, double gap) noexcept {
    const double overlap = std::max(0.0, -gap);
    return 0.5 * p.normal_stiffness * overlap * overlap;
  }

  /// The energy dissipated is that of the mean force over the step on the slip that is not elastic:
  /// what the leapfrog takes from the kinetic energy, to round-off, for any change of the normal
  /// force.
  template <class Real>
  PLEKTON_INLINE static ContactForceOf<Real> force(const ParametersOf<Real>& p,
                                                   const RelativeMotionOf<Real>& motion,
                                                   HistoryOf<Real>& history, double dt) noexcept {
    const Vec3Of<Real> before = history.elastic_slip;
    const Vec3Of<Real> trial = before + Real(dt) * motion.slip_velocity;
    const Real limit = p.friction * motion.elastic_normal_force;
    const Real trial_force = p.tangential_stiffness * trial.norm();
    const Real elastic_part =
        geometry::select(trial_force > limit, Real(limit / trial_force), Real(1.0));
    history.elastic_slip = elastic_part * trial;
    const Vec3Of<Real> plastic_slip = trial - history.elastic_slip;
    const Vec3Of<Real> twice_mean_slip = before + history.elastic_slip;
    return {elastic_force(p, motion.elastic_normal_force, motion.normal, history),
            Real(0.5) * p.tangential_stiffness * twice_mean_slip.dot(plastic_slip)};
  }

  /// See TellsForce.
  static Vec3 force_of_state(const Parameters& p, double gap, const Vec3& normal,
                             const History& history) noexcept {
    return elastic_force(p, elastic_normal_force(p, gap), normal, history);
  }

  static double tangential_limit(const Parameters& p, double elastic_force,
                                 const History&) noexcept {
    return p.friction * elastic_force;
  }

  template <class Real>
  PLEKTON_INLINE static Real history_energy(const ParametersOf<Real>& p,
                                            const HistoryOf<Real>& history) noexcept {
    return Real(0.5) * p.tangential_stiffness * history.elastic_slip.squaredNorm();
  }

  template <class Real>
  PLEKTON_INLINE static Real normal_stiffness(const ParametersOf<Real>& p,
                                              const std::type_identity_t<Real>&) noexcept {
    return p.normal_stiffness;
  }
  template <class Real>
  PLEKTON_INLINE static Real tangential_stiffness(const ParametersOf<Real>& p,
                                                  const std::type_identity_t<Real>&) noexcept {
    return p.tangential_stiffness;
  }

  template <class Real>
  PLEKTON_INLINE static void rotate(HistoryOf<Real>& history,
                                    const FrameRotationOf<Real>& rotation) noexcept {
    history.elastic_slip = rotation(history.elastic_slip);
  }

  static void accumulate_history(History& history, const History& other, double share) noexcept {
    history.elastic_slip += share * other.elastic_slip;
  }

 private:
  static double spring_radius(const Properties& given, const Body& of, const Body& with) noexcept {
    const bool is_as_flat = given.radius == StiffnessRadius::curvature && of.shape == Shape::flat &&
                            with.shape != Shape::flat;
    return is_as_flat ? with.radius : of.radius;
  }

  /// Twice the series stiffness, so that equal bodies give their own stiffness; 0 if one of them is
  /// 0.
  template <class Real>
  PLEKTON_INLINE static Real in_series(const Real& a, const Real& b) noexcept {
    const Real sum = a + b;
    return geometry::select(sum > Real(0.0), Real(Real(2.0) * a * b / sum), Real(0.0));
  }

  template <class Real>
  PLEKTON_INLINE static Vec3Of<Real> elastic_force(const ParametersOf<Real>& p,
                                                   const Real& normal_force,
                                                   const Vec3Of<Real>& normal,
                                                   const HistoryOf<Real>& history) noexcept {
    return normal_force * normal - p.tangential_stiffness * history.elastic_slip;
  }
};

static_assert(ContactLaw<LinearFrictional>);

}  // namespace plekton::contact
