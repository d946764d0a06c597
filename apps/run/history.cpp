// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/history.hpp"

#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/sheet_facets.hpp"

#include <array>
#include <string>
#include <vector>

namespace plekton::apps {
namespace {

constexpr std::array<dynamics::OutputField, 22> kFields = {{
    {"time", "s", "simulated"},
    {"kinetic", "J", "energy of motion of free nodes"},
    {"contact_elastic", "J", "energy stored in contacts"},
    {"bond_elastic", "J", "energy stored in beams, bars and ties"},
    {"sheet_elastic", "J", "energy stored in sheets"},
    {"gravity", "J", "energy of weight, from the start"},
    {"friction", "J", "dissipated by contacts"},
    {"tracking", "J",
     "lost, or below 0 made, where contacts are handed on: from patch to patch, and with elements "
     "that break"},
    {"bond_dissipated", "J",
     "dissipated by bonds that yield or break, by sheets that tear, and by ties"},
    {"damping", "J", "dissipated by numerical and viscous damping"},
    {"external_work", "J",
     "done by loads and by what is moved, less what springs to ground and an enclosed gas have "
     "stored"},
    {"closure_error", "J", "by which these do not add up"},
    {"grain_grain_contacts", "", "how many"},
    {"grain_membrane_contacts", "", "how many"},
    {"membrane_membrane_contacts", "", "how many"},
    {"plane_contacts", "", "how many"},
    {"broken_bonds", "", "how many so far"},
    {"torn_facets", "", "of sheets, how many so far"},
    {"largest_overlap_ratio", "",
     "overlap over the radius of the grain, of two grains the smaller one; between membranes, and "
     "of "
     "them with planes, over half the thickness, the smaller one"},
    {"time_step", "s", "chosen or given; the last 64 steps of a run may be shorter"},
    {"lost_grains", "", "how many"},
    {"unbalanced_force_ratio", "",
     "mean resultant force on free nodes over the mean force that contacts, bonds and sheets "
     "carry; inf where nothing is carried"},
}};

std::vector<dynamics::CsvColumn> columns() {
  std::vector<dynamics::CsvColumn> columns;
  for (const dynamics::OutputField& field : kFields)
    columns.push_back({std::string(field.name), std::string(field.unit)});
  return columns;
}

}  // namespace

std::size_t broken_bonds(const dynamics::Simulation& simulation) {
  const dynamics::BeamBonds& bonds = simulation.bonds();
  std::size_t count = 0;
  for (std::size_t i = 0; i < bonds.size(); ++i) count += bonds.is_broken(i) ? 1U : 0U;
  return count;
}

std::size_t torn_facets(const dynamics::Simulation& simulation) {
  const dynamics::SheetFacets& sheets = simulation.sheet_facets();
  std::size_t count = 0;
  for (std::size_t i = 0; i < sheets.size(); ++i) count += sheets.is_broken(i) ? 1U : 0U;
  return count;
}

std::span<const dynamics::OutputField> history_fields() {
  return kFields;
}

History::History(const std::filesystem::path& folder, const WrittenFiles* before) {
  open(folder, kHistoryFile, columns(), before);
}

void History::add(const dynamics::Simulation& simulation, const dynamics::Energy& energy,
                  const LostGrains& lost) {
  const contact::ContactCounts counts = simulation.contacts().counts();
  add_row({simulation.time(),
           energy.kinetic,
           energy.contact_elastic,
           energy.bond_elastic,
           energy.sheet_elastic,
           energy.gravity + 0.0,  // not -0, where there is no gravity
           energy.friction,
           energy.tracking,
           energy.bond_dissipated,
           energy.damping,
           energy.external_work,
           energy.closure_error(),
           static_cast<double>(counts.sphere_sphere),
           static_cast<double>(counts.sphere_surface),
           static_cast<double>(counts.between_structures),
           static_cast<double>(counts.with_planes),
           static_cast<double>(broken_bonds(simulation)),
           static_cast<double>(torn_facets(simulation)),
           simulation.contacts().largest_overlap_ratio(),
           simulation.time_step(),
           static_cast<double>(lost.total()),
           simulation.unbalanced_force_ratio()});
}

}  // namespace plekton::apps
