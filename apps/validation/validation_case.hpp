// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/validation/figure.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps {

/// A number that a case comes to, and what it should be.
struct Finding {
  std::string what;
  double value = 0.0;
  double reference = 0.0;
  double tolerance = 0.0;  ///< largest difference, in the unit of both
  std::string unit;
  std::string source;  ///< where the reference comes from

  bool passes() const noexcept;
};

struct CaseReport {
  std::vector<Finding> findings;
  std::vector<Figure> figures;
};

/// Part of the suite that shows a user that this program, on this machine, comes to what is known.
struct ValidationCase {
  std::string_view name;
  std::string_view what;
  /// @param full  with more steps, elements or surfaces
  CaseReport (*run)(bool full);
};

std::span<const ValidationCase> validation_cases();

// The cases, a source each.
CaseReport validate_sphere_over_sheet(bool full);
CaseReport validate_rolling(bool full);
CaseReport validate_facet_probes(bool full);
CaseReport validate_fold(bool full);
CaseReport validate_cantilever(bool full);
CaseReport validate_cable(bool full);
CaseReport validate_wire_net(bool full);
CaseReport validate_tube(bool full);
CaseReport validate_bounce(bool full);
CaseReport validate_pull_out(bool full);
CaseReport validate_conservation(bool full);
CaseReport validate_determinism(bool full);

}  // namespace plekton::apps
