// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/cohesive_frictional.hpp"
#include "contact/law/dmt_adhesion.hpp"
#include "contact/law/hertz_mindlin.hpp"
#include "contact/law/linear_frictional.hpp"
#include "contact/law/restitution.hpp"
#include "contact/with_parts.hpp"

#include <ostream>
#include <vector>

/// Contact laws with properties, for scenes that run under each of them.
namespace plekton::test {

struct NamedLaw {
  const char* name;
  contact::PropertiesOf<contact::AnyLaw> properties;

  friend void PrintTo(const NamedLaw& law, std::ostream* out) { *out << law.name; }
};
template <class Law>
contact::PropertiesOf<contact::AnyLaw> with(
    const contact::PropertiesOf<Law>& properties,
    const contact::RollingTwisting::Properties& rolling = {},
    const contact::Dashpot::Properties& dashpot = {}) {
  return contact::with_parts<Law>(properties, rolling, dashpot);
}

/// One of every kind, for stiffnesses of some 1e5 N/m and bodies of some kg.
inline const std::vector<NamedLaw> kLaws{
    {"LinearFrictional", with<contact::LinearFrictional>({})},
    {"Rolling", with<contact::LinearFrictional>({}, {0.3, 0.3, 0.1, 0.1})},
    {"HertzMindlin", with<contact::HertzMindlin>({})},
    {"DmtAdhesion", with<contact::DmtAdhesion>({1.0})},
    {"Cohesive", with<contact::CohesiveFrictional>({2e4, 2e4, 0.0})},
    {"CohesiveDuctile", with<contact::CohesiveFrictional>({2e4, 2e4, 5e-3})},
    {"Damped",
     with<contact::HertzMindlin>({}, {0.3, 0.3, 0.1, 0.1},
                                 {contact::damping_ratio(contact::SpringKind::hertz, 0.5)})}};

}  // namespace plekton::test
