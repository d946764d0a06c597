// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/contact_part.hpp"

#include <type_traits>

namespace plekton::contact {

namespace detail {

/// Parameters and history of a law or a part for Real: those of a law that is not written for any
/// Real are for double alone.
template <class Law, class Real>
struct NumbersOf {};
template <class Law, class Real>
requires requires {
  typename Law::template ParametersOf<Real>;
}
struct NumbersOf<Law, Real> {
  using Parameters = typename Law::template ParametersOf<Real>;
  using History = typename Law::template HistoryOf<Real>;
};
template <class Law>
requires(!requires { typename Law::template ParametersOf<double>; }) struct NumbersOf<Law, double> {
  using Parameters = typename Law::Parameters;
  using History = typename Law::History;
};

template <class Law, class Real>
concept HasNumbersOf = requires {
  typename NumbersOf<Law, Real>::Parameters;
};

}  // namespace detail

/// A contact law with something added. A sum is a law: parts can be added one after the other. It
/// is written for any Real if both are.
template <ContactLaw Whole, ContactPart Part>
struct Sum {
  static constexpr std::string_view name = Whole::name;

  struct Properties {
    PropertiesOf<Whole> whole;
    PropertiesOf<Part> part;
  };

  static void list_problems(const Properties& properties, std::ostream& out) {
    Whole::list_problems(properties.whole, out);
    Part::list_problems(properties.part, out);
  }

  // Not by a requires-clause: clang 14 crashes on that of a template within a template.
  template <class Real, class = std::enable_if_t<detail::HasNumbersOf<Whole, Real> &&
                                                 detail::HasNumbersOf<Part, Real>>>
  struct ParametersOf {
    typename detail::NumbersOf<Whole, Real>::Parameters whole;
    typename detail::NumbersOf<Part, Real>::Parameters part;
  };
  using Parameters = ParametersOf<double>;

  template <class Real, class = std::enable_if_t<detail::HasNumbersOf<Whole, Real> &&
                                                 detail::HasNumbersOf<Part, Real>>>
  struct HistoryOf {
    typename detail::NumbersOf<Whole, Real>::History whole;
    typename detail::NumbersOf<Part, Real>::History part;
  };
  using History = HistoryOf<double>;

  static Parameters combine(const Properties& properties, const Body& a, const Body& b) noexcept {
    return {contact::combine<Whole>(properties.whole, a, b), Part::combine(properties.part, a, b)};
  }
  static Parameters scaled(const Parameters& p, double count) noexcept {
    return {Whole::scaled(p.whole, count), Part::scaled(p.part, count)};
  }

  template <class Real>
  PLEKTON_INLINE static Real elastic_normal_force(const ParametersOf<Real>& p,
                                                  const std::type_identity_t<Real>& gap) noexcept {
    return Whole::elastic_normal_force(p.whole, gap);
  }
  static double elastic_normal_energy(const Parameters& p, double gap) noexcept {
    return Whole::elastic_normal_energy(p.whole, gap);
  }

  template <class Real>
  PLEKTON_INLINE static Real interaction_range(const ParametersOf<Real>& p) requires
      HasInteractionRange<Whole> {
    return Whole::interaction_range(p.whole);
  }
  static bool holds(const History& history) requires HasInteractionRange<Whole> {
    return Whole::holds(history.whole);
  }
  template <class Real>
  PLEKTON_INLINE static Real hold(const HistoryOf<Real>& history) requires
      HasInteractionRange<Whole> {
    return Whole::hold(history.whole);
  }

  static double attraction(const Parameters& p) { return Whole::attraction(p.whole); }
  static Parameters without_attraction(const Parameters& p) {
    return {Whole::without_attraction(p.whole), p.part};
  }

  static bool end_start(Properties& properties) { return Whole::end_start(properties.whole); }
  static bool cements(const Parameters& p) { return Whole::cements(p.whole); }
  static void cement(const Parameters& p, History& history) {
    Whole::cement(p.whole, history.whole);
  }
  static Parameters of_bond(const Parameters& p) {
    return {Whole::of_bond(p.whole), Part::of_bond(p.part)};
  }
  static Parameters unbonded_part(const Parameters& p, double part) {
    return {Whole::unbonded_part(p.whole, part), Part::unbonded_part(p.part, part)};
  }

  template <class Real>
  PLEKTON_INLINE static ContactForceOf<Real> force(const ParametersOf<Real>& p,
                                                   const RelativeMotionOf<Real>& motion,
                                                   HistoryOf<Real>& history, double dt) noexcept {
    const ContactForceOf<Real> whole = Whole::force(p.whole, motion, history.whole, dt);
    const ContactForceOf<Real> part =
        Part::force(p.part, motion, stiffness(p, motion.gap), history.part, dt);
    return {whole.force + part.force, whole.dissipated + part.dissipated,
            whole.moment + part.moment};
  }

  static Vec3 force_of_state(const Parameters& p, double gap, const Vec3& normal,
                             const History& history) noexcept requires TellsForce<Whole> {
    return Whole::force_of_state(p.whole, gap, normal, history.whole) +
           Part::force_of_state(history.part, normal);
  }

  static Vec3 other_force(const Parameters& p, const Vec3& normal, const History& history) {
    return contact::other_force<Whole>(p.whole, normal, history.whole) +
           Part::force_of_state(history.part, normal);
  }

  static Vec3 moment(const History& history, const Vec3& normal) requires HasMoments<Whole> ||
      HasMoments<Part> {
    return moment_of<Whole>(history.whole, normal) + moment_of<Part>(history.part, normal);
  }

  static double tangential_limit(const Parameters& p, double elastic_force,
                                 const History& history) {
    return Whole::tangential_limit(p.whole, elastic_force, history.whole);
  }

  template <class Real>
  PLEKTON_INLINE static Real history_energy(const ParametersOf<Real>& p,
                                            const HistoryOf<Real>& history) noexcept {
    return Whole::history_energy(p.whole, history.whole) +
           Part::history_energy(p.part, history.part);
  }

  template <class Real>
  PLEKTON_INLINE static Real normal_stiffness(const ParametersOf<Real>& p,
                                              const std::type_identity_t<Real>& gap) noexcept {
    return effective(p, gap).normal;
  }
  template <class Real>
  PLEKTON_INLINE static Real tangential_stiffness(const ParametersOf<Real>& p,
                                                  const std::type_identity_t<Real>& gap) noexcept {
    return effective(p, gap).tangential;
  }

  static double normal_damping(const Parameters& p, double gap) noexcept {
    return Whole::normal_damping(p.whole, gap) + Part::normal_damping(p.part, stiffness(p, gap));
  }

  template <class Real>
  PLEKTON_INLINE static void rotate(HistoryOf<Real>& history,
                                    const FrameRotationOf<Real>& rotation) noexcept {
    Whole::rotate(history.whole, rotation);
    Part::rotate(history.part, rotation);
  }
  static void scale_history(History& history, double factor) noexcept {
    Whole::scale_history(history.whole, factor);
    Part::scale_history(history.part, factor);
  }
  static void accumulate_history(History& history, const History& other, double share) noexcept {
    Whole::accumulate_history(history.whole, other.whole, share);
    Part::accumulate_history(history.part, other.part, share);
  }

 private:
  /// Of the law without the part.
  template <class Real>
  PLEKTON_INLINE static ContactStiffnessOf<Real> stiffness(
      const ParametersOf<Real>& p, const std::type_identity_t<Real>& gap) noexcept {
    return {Whole::normal_stiffness(p.whole, gap), Whole::tangential_stiffness(p.whole, gap)};
  }
  template <class Real>
  PLEKTON_INLINE static ContactStiffnessOf<Real> effective(
      const ParametersOf<Real>& p, const std::type_identity_t<Real>& gap) noexcept {
    return Part::effective(p.part, stiffness(p, gap));
  }
};

}  // namespace plekton::contact
