// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/validation_case.hpp"

#include <array>
#include <cmath>

namespace plekton::apps {

bool Finding::passes() const noexcept {
  return std::abs(value - reference) <= tolerance;  // not for what is no number
}

std::span<const ValidationCase> validation_cases() {
  static constexpr std::array<ValidationCase, 12> kCases = {{
      {"sphere_over_sheet", "a sphere is dragged over a flat sheet of irregular facets, pressed in",
       sphere_over_sheet::validate},
      {"facet_probes", "spheres touch a facet from above and from beside it",
       facet_probes::validate},
      {"fold", "a sphere goes over a ridge and through a valley of facets", fold::validate},
      {"rolling", "a sphere rolls and slides down a sheet of facets", rolling::validate},
      {"cantilever", "beams in a row bend under a load at their end", cantilever::validate},
      {"cable", "a chain of links hangs between two supports", cable::validate},
      {"wire_net", "a double-twisted net of wire is pulled between two grips until it tears",
       wire_net::validate},
      {"tube", "a tube of a lattice of beams buckles between rings that come together",
       tube::validate},
      {"bounce", "a hollow sphere bounces on a wall and on an incline", bounce::validate},
      {"pull_out", "a membrane and a grid are pulled out of a bed of grains between two plates",
       pull_out::validate},
      {"conservation", "a spinning sphere collides with a free facet on beams, with friction",
       conservation::validate},
      {"determinism", "grains fall on a membrane, with 1, 2 and 4 threads", determinism::validate},
  }};
  return kCases;
}

}  // namespace plekton::apps
