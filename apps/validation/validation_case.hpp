// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/validation/figure.hpp"

#include <cmath>
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

/// Keeps the largest of some deviations; one that is no number stays, and no finding passes with it.
inline void keep_largest(double& largest, double deviation) noexcept {
  if (!(deviation <= largest) && !std::isnan(largest)) largest = deviation;
}

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

// The cases, a source and a namespace each.
namespace sphere_over_sheet {
CaseReport validate(bool full);
}
namespace rolling {
CaseReport validate(bool full);
}
namespace facet_probes {
CaseReport validate(bool full);
}
namespace fold {
CaseReport validate(bool full);
}
namespace cantilever {
CaseReport validate(bool full);
}
namespace cable {
CaseReport validate(bool full);
}
namespace wire_net {
CaseReport validate(bool full);
}
namespace tube {
CaseReport validate(bool full);
}
namespace bounce {
CaseReport validate(bool full);
}
namespace pull_out {
CaseReport validate(bool full);
}
namespace conservation {
CaseReport validate(bool full);
}
namespace determinism {
CaseReport validate(bool full);
}

}  // namespace plekton::apps
