// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contact_law.hpp"
#include "geometry/pack.hpp"

#include <concepts>

namespace plekton::contact {

using geometry::Pack;

/// A law written for any Real: it may be asked about contacts side by side. Its ParametersOf and
/// HistoryOf consist of Reals and Vec3Of<Real> only, and nothing in them branches. It has no
/// moments and no reach.
///
/// A new history turned from the normal 0 stays new: rotate() is linear in what it turns.
template <class Law>
concept LaneLaw = ContactLaw<Law> && !HasMoments<Law> && !HasReach<Law> &&
                  requires(const typename Law::template ParametersOf<Pack<2>>& parameters,
                           const RelativeMotionOf<Pack<2>>& motion,
                           typename Law::template HistoryOf<Pack<2>>& history,
                           const FrameRotationOf<Pack<2>>& rotation, const Pack<2>& gap) {
  requires std::same_as < typename Law::template ParametersOf<double>,
  typename Law::Parameters > ;
  requires std::same_as < typename Law::template HistoryOf<double>,
  typename Law::History > ;
  { Law::elastic_normal_force(parameters, gap) } -> std::same_as<Pack<2>>;
  { Law::force(parameters, motion, history, 1.0) } -> std::same_as<ContactForceOf<Pack<2>>>;
  { Law::history_energy(parameters, history) } -> std::same_as<Pack<2>>;
  Law::rotate(history, rotation);
};

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
