// SPDX-License-Identifier: GPL-3.0-or-later
// What is wrong with the properties of the laws that come with the library.
#include "contact/law/cohesive_frictional.hpp"
#include "contact/law/dashpot.hpp"
#include "contact/law/dmt_adhesion.hpp"
#include "contact/law/linear_frictional.hpp"
#include "contact/law/rolling_twisting.hpp"

#include <cmath>
#include <ostream>
#include <string_view>

namespace plekton::contact {
namespace {

void expect_finite(std::string_view what, double value, std::ostream& out) {
  if (value >= 0.0 && std::isfinite(value)) return;
  out << what << " is " << value << "; it must be finite and not negative\n";
}

void expect_stiffness(std::string_view what, double value, std::ostream& out) {
  if (value >= 0.0 && std::isfinite(value)) return;
  out << what << " is " << value
      << " N/m; it must be finite and positive, or 0 for that of the materials\n";
}

/// Strengths and limits, which may be infinite.
void expect_limit(std::string_view what, double value, std::ostream& out) {
  if (value >= 0.0) return;
  out << what << " is " << value << "; it must not be negative\n";
}

}  // namespace

void LinearFrictional::list_problems(const Properties& given, std::ostream& out) {
  expect_stiffness("normal_stiffness", given.normal_stiffness, out);
  expect_stiffness("tangential_stiffness", given.tangential_stiffness, out);
}

void DmtAdhesion::list_problems(const Properties& given, std::ostream& out) {
  expect_finite("work_of_adhesion", given.work_of_adhesion, out);
}

void CohesiveFrictional::list_problems(const Properties& given, std::ostream& out) {
  LinearFrictional::list_problems(given.elastic, out);
  expect_finite("tensile_strength", given.tensile_strength, out);  // which is how far bonds reach
  expect_limit("shear_strength", given.shear_strength, out);
  expect_finite("rupture_distance", given.rupture_distance, out);
}

void RollingTwisting::list_problems(const Properties& given, std::ostream& out) {
  expect_finite("rolling_stiffness", given.rolling_stiffness, out);
  expect_finite("twisting_stiffness", given.twisting_stiffness, out);
  expect_limit("rolling_limit", given.rolling_limit, out);
  expect_limit("twisting_limit", given.twisting_limit, out);
}

void Dashpot::list_problems(const Properties& given, std::ostream& out) {
  expect_finite("damping_ratio", given.damping_ratio, out);
}

}  // namespace plekton::contact
