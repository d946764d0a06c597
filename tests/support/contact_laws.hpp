// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law_table.hpp"
#include "contact/law/cohesive_frictional.hpp"
#include "contact/law/dashpot.hpp"
#include "contact/law/dmt_adhesion.hpp"
#include "contact/law/hertz_mindlin.hpp"
#include "contact/law/linear_frictional.hpp"
#include "contact/law/rolling_twisting.hpp"
#include "contact/law/sum.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/weakening_slider.hpp"

#include <gtest/gtest.h>

#include <type_traits>

/// The contact laws that every test of a law runs through. A new law joins the list.
namespace plekton::test {

using namespace contact;
using RollingLinear = Sum<LinearFrictional, RollingTwisting>;
using DampedHertz = Sum<HertzMindlin, Dashpot>;
using Everything = Sum<Sum<HertzMindlin, RollingTwisting>, Dashpot>;

using AllLaws = ::testing::Types<LinearFrictional, HertzMindlin, DmtAdhesion, RollingLinear,
                                 DampedHertz, Everything, AnyLaw, WeakeningSlider>;

template <class Law>
using WithParts = Sum<Sum<Law, RollingTwisting>, Dashpot>;

/// Every law that is written for contacts side by side, alone, with each part and with both.
using LaneLaws =
    ::testing::Types<LinearFrictional, RollingLinear, Sum<LinearFrictional, Dashpot>,
                     WithParts<LinearFrictional>, HertzMindlin, Sum<HertzMindlin, RollingTwisting>,
                     DampedHertz, Everything, DmtAdhesion, WithParts<DmtAdhesion>,
                     CohesiveFrictional, Sum<CohesiveFrictional, RollingTwisting>,
                     WithParts<CohesiveFrictional>, WeakeningSlider>;

template <class Law>
inline constexpr bool kHasDashpot =
    std::is_same_v<Law, DampedHertz> || std::is_same_v<Law, Everything>;

/// Properties for a law or a part, at random.
template <class Law>
struct RandomProperties {
  static PropertiesOf<Law> from(Random&) { return {}; }
};
template <>
struct RandomProperties<LinearFrictional> {
  static LinearFrictional::Properties from(Random& random) {
    using Radius = LinearFrictional::StiffnessRadius;
    const auto given = [&] { return random.unit() < 0.3 ? random.uniform(1e4, 1e6) : 0.0; };
    return {given(), given(), random.unit() < 0.5 ? Radius::half_thickness : Radius::curvature};
  }
};
template <>
struct RandomProperties<DmtAdhesion> {
  static DmtAdhesion::Properties from(Random& random) { return {random.uniform(0.0, 1e-4)}; }
};
/// Fragile and ductile bonds, and none, that some 1e-5 to 1e-4 m stretch as far as they go.
template <>
struct RandomProperties<CohesiveFrictional> {
  static CohesiveFrictional::Properties from(Random& random) {
    const auto strength = [&] { return random.unit() < 0.2 ? 0.0 : random.uniform(1e4, 4e5); };
    return {strength(), strength(), random.coin() ? 0.0 : random.uniform(1e-5, 2e-4),
            random.unit() < 0.8 ? Bonds::new_contacts : Bonds::none};
  }
};
template <>
struct RandomProperties<RollingTwisting> {
  static RollingTwisting::Properties from(Random& random) {
    return {random.uniform(0.0, 0.5), random.uniform(0.0, 0.5), random.uniform(0.0, 0.3),
            random.uniform(0.0, 0.3)};
  }
};
template <>
struct RandomProperties<Dashpot> {
  static Dashpot::Properties from(Random& random) { return {random.uniform(0.0, 0.5)}; }
};
template <class Whole, class Part>
struct RandomProperties<Sum<Whole, Part>> {
  static typename Sum<Whole, Part>::Properties from(Random& random) {
    return {RandomProperties<Whole>::from(random), RandomProperties<Part>::from(random)};
  }
};
template <>
struct RandomProperties<AnyLaw> {
  static AnyLaw::Properties from(Random& random) {
    const double which = random.unit();
    if (which < 0.3) return AnyLaw::of<LinearFrictional>();
    if (which < 0.6) return AnyLaw::of<HertzMindlin>();
    return AnyLaw::of<RollingLinear>(RandomProperties<RollingLinear>::from(random));
  }
};

template <class Law>
PropertiesOf<Law> random_properties(Random& random) {
  return RandomProperties<Law>::from(random);
}

}  // namespace plekton::test
