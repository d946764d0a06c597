// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/history.hpp"

#include <array>

namespace plekton::apps {
namespace {

const std::array<dynamics::CsvColumn, 19> kColumns = {{{"time", "s"},
                                                       {"kinetic", "J"},
                                                       {"contact_elastic", "J"},
                                                       {"bond_elastic", "J"},
                                                       {"sheet_elastic", "J"},
                                                       {"gravity", "J"},
                                                       {"friction", "J"},
                                                       {"bond_dissipated", "J"},
                                                       {"damping", "J"},
                                                       {"external_work", "J"},
                                                       {"closure_error", "J"},
                                                       {"grain_grain_contacts", ""},
                                                       {"grain_membrane_contacts", ""},
                                                       {"membrane_membrane_contacts", ""},
                                                       {"plane_contacts", ""},
                                                       {"broken_bonds", ""},
                                                       {"largest_overlap_ratio", ""},
                                                       {"time_step", "s"},
                                                       {"lost_grains", ""}}};

}  // namespace

std::size_t broken_bonds(const Simulation& simulation) {
  const dynamics::BeamBonds& bonds = simulation.bonds();
  std::size_t count = 0;
  for (std::size_t i = 0; i < bonds.size(); ++i) count += bonds.is_broken(i) ? 1U : 0U;
  return count;
}

History::History(const std::filesystem::path& folder)
    : writer_(folder / "energy.csv", kColumns, dynamics::CsvWriter::Flush::on_request) {}

void History::add(const Simulation& simulation, const LostGrains& lost) {
  const dynamics::Energy energy = simulation.energy();
  const contact::ContactCounts counts = simulation.contact_counts();
  writer_.add(
      {simulation.time(), energy.kinetic, energy.contact_elastic, energy.bond_elastic,
       energy.sheet_elastic, energy.gravity, energy.friction, energy.bond_dissipated,
       energy.damping, energy.external_work, energy.closure_error(),
       static_cast<double>(counts.sphere_sphere), static_cast<double>(counts.sphere_surface),
       static_cast<double>(counts.between_structures), static_cast<double>(counts.with_planes),
       static_cast<double>(broken_bonds(simulation)), simulation.present_overlap_ratio(),
       simulation.time_step(), static_cast<double>(lost.total())});
}

}  // namespace plekton::apps
