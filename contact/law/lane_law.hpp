// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/contact_law.hpp"
#include "geometry/base/pack.hpp"

#include <concepts>

namespace plekton::contact {

using geometry::Pack;

/// A law written for any Real: it may be asked about contacts side by side. Its ParametersOf and
/// HistoryOf consist of Reals and Vec3Of<Real> only, and nothing in them branches. What it answers
/// to lanes that do not touch may be any number, also none. One with a reach (HasInteractionRange)
/// tells that side by side as well, and who holds: hold(history) is positive where bodies stick to
/// each other.
///
/// All numbers of a new history are 0, and one turned from the normal 0 stays new: rotate() is
/// linear in what it turns.
template <class Law>
concept LaneLaw = ContactLaw<Law> && requires(
        const typename Law::template ParametersOf<Pack<2>>& parameters,
        const RelativeMotionOf<Pack<2>>& motion, typename Law::template HistoryOf<Pack<2>>& history,
        const FrameRotationOf<Pack<2>>& rotation, const Pack<2>& gap) {
  requires std::same_as < typename Law::template ParametersOf<double>,
  typename Law::Parameters > ;
  requires std::same_as < typename Law::template HistoryOf<double>,
  typename Law::History > ;
  requires sizeof(parameters) == 2 * sizeof(typename Law::Parameters);
  requires sizeof(history) == 2 * sizeof(typename Law::History);
  { Law::elastic_normal_force(parameters, gap) } -> std::same_as<Pack<2>>;
  { Law::force(parameters, motion, history, 1.0) } -> std::same_as<ContactForceOf<Pack<2>>>;
  { Law::history_energy(parameters, history) } -> std::same_as<Pack<2>>;
  Law::rotate(history, rotation);
  requires !HasInteractionRange<Law> || requires {
    { Law::interaction_range(parameters) } -> std::same_as<Pack<2>>;
    { Law::hold(history) } -> std::same_as<Pack<2>>;
  };
};

/// goes_on() side by side: positive where a contact with this history goes on at a gap (m) that is
/// not negative.
template <LaneLaw Law, class Real>
requires HasInteractionRange<Law> PLEKTON_INLINE Real
goes_on_side_by_side(const typename Law::template ParametersOf<Real>& parameters,
                     const typename Law::template HistoryOf<Real>& history, const Real& gap)
noexcept {
  return geometry::smaller_of(Real(Law::interaction_range(parameters) - gap), Law::hold(history));
}

/// A law whose parameters follow from materials and radii (m) alone, of spheres whose materials
/// have no properties as a pair; for many contacts side by side as well.
template <class Law>
concept CombinesRadii = LaneLaw<Law> && requires(const Material& material, const Pack<2>& radius) {
  {
    Law::combine(material, radius, material, radius)
    } -> std::same_as<typename Law::template ParametersOf<Pack<2>>>;
  { Law::combine(material, 1.0, material, 1.0) } -> std::same_as<typename Law::Parameters>;
};

}  // namespace plekton::contact
