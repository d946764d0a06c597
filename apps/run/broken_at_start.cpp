// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/broken_at_start.hpp"

#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/sheet_facets.hpp"

#include <fmt/format.h>

namespace plekton::apps {
namespace {

/// How many of a range of elements are broken.
template <class Elements>
std::size_t count_broken(const Elements& elements, std::size_t first, std::size_t count) {
  std::size_t broken = 0;
  for (std::size_t i = first; i < first + count; ++i) broken += elements.is_broken(i) ? 1U : 0U;
  return broken;
}

}  // namespace

std::vector<std::string> warnings_about_breaks(const BuiltScene& built,
                                               const dynamics::Simulation& simulation) {
  std::vector<std::string> warnings;
  std::size_t beams = 0, facets = 0;
  for (const BuiltMembrane& membrane : built.membranes) {
    const auto warn = [&](const char* what, const auto& elements, std::size_t first,
                          std::size_t count) {
      const std::size_t broken = count_broken(elements, first, count);
      if (broken == 0) return;
      warnings.push_back(fmt::format(
          "{} of the {} {} of \"{}\" break at the start: prestrain, or where its nodes are, "
          "strains "
          "them beyond their strength; expected less of it, or a higher strength or longer wire "
          "curve",
          broken, count, what, membrane.name));
    };
    warn("bars", simulation.bonds(), beams, membrane.beams);
    warn("facets", simulation.sheet_facets(), facets, membrane.sheet_facets);
    beams += membrane.beams;
    facets += membrane.sheet_facets;
  }
  return warnings;
}

}  // namespace plekton::apps
