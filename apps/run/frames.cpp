// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/frames.hpp"

#include "apps/run/output_folder.hpp"
#include "dynamics/output/contact_fields.hpp"
#include "dynamics/output/file.hpp"
#include "dynamics/structure/bonds_along.hpp"

#include <fmt/format.h>

#include <array>
#include <numeric>
#include <string_view>
#include <system_error>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> kParts = {"grains", "membranes", "contacts"};

/// Whether a file name is one that write_part makes.
bool is_frame(const std::string& name) {
  for (const std::string_view part : kParts) {
    if (!name.starts_with(part) || !name.ends_with(".vtp")) continue;
    const std::string_view middle =
        std::string_view(name).substr(part.size(), name.size() - part.size() - 4);
    if (middle.starts_with('_') &&
        middle.find_first_not_of("0123456789", 1) == std::string_view::npos)
      return true;
  }
  return false;
}

/// What cannot be removed will be replaced, or its replacement fails with a message of its own.
void remove_earlier(const fs::path& folder) {
  std::error_code ignored;
  for (const std::string_view part : kParts)
    fs::remove(folder / fmt::format("{}.pvd", part), ignored);
  fs::remove(folder / "contacts.csv", ignored);
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder / "frames", ignored)) {
    if (is_frame(entry.path().filename().string())) old.push_back(entry.path());
  }
  for (const fs::path& file : old) fs::remove(file, ignored);
}

/// Of every cylinder that is left; 0 where no bond is along it.
std::vector<double> tensions_of(const dynamics::Simulation& simulation) {
  const dynamics::BeamBonds& bonds = simulation.bonds();
  std::vector<double> tensions;
  for (const std::size_t bond : dynamics::bonds_along(simulation.elements().cylinders, bonds))
    tensions.push_back(bond == dynamics::kNoBond ? 0.0 : bonds.axial_force(bond));
  return tensions;
}

/// Of every facet, 0 where it is none of a sheet; empty if there is no sheet. The facets of sheets
/// come in the order of all facets (build_scene.hpp).
std::vector<dynamics::PrincipalForces> membrane_forces_of(const dynamics::Simulation& simulation) {
  const dynamics::SheetFacets& sheets = simulation.sheet_facets();
  if (sheets.size() == 0) return {};
  const auto& facets = simulation.elements().facets;
  std::vector<dynamics::PrincipalForces> forces(facets.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < facets.size() && next < sheets.size(); ++i) {
    while (next < sheets.size() && sheets.is_broken(next)) ++next;
    if (next == sheets.size() || facets[i].nodes != sheets.nodes(next)) continue;
    forces[i] =
        dynamics::principal_forces(sheets.membrane_force(next++, simulation.state().position));
  }
  return forces;
}

/// Likewise, and of bonds that broke.
std::vector<dynamics::BondStress> stresses_of(const dynamics::Simulation& simulation) {
  std::vector<dynamics::BondStress> stresses;
  for (const std::size_t bond :
       dynamics::bonds_along(simulation.elements().cylinders, simulation.bonds()))
    stresses.push_back(bond == dynamics::kNoBond || simulation.bonds().is_broken(bond)
                           ? dynamics::BondStress{}
                           : simulation.bond_stress(bond));
  return stresses;
}

}  // namespace

Frames::Frames(const fs::path& folder, const OutputSettings& settings,
               const dynamics::Simulation& simulation, const BodyTables& bodies)
    : folder_(folder),
      settings_(settings),
      bodies_(bodies),
      sphere_ids_(simulation.elements().spheres.size()),
      grains_(folder / "grains.pvd"),
      membranes_(folder / "membranes.pvd"),
      contacts_(folder / "contacts.pvd") {
  std::iota(sphere_ids_.begin(), sphere_ids_.end(), 0);
  settings_.grains = settings_.grains && !simulation.elements().spheres.empty();
  settings_.membranes = settings_.membranes && (!simulation.elements().cylinders.empty() ||
                                                !simulation.elements().facets.empty());
  make_output_folder(folder_ / "frames");
  remove_earlier(folder_);
  if (settings_.contact_list) {
    contact_list_.emplace(folder_ / "contacts.csv", dynamics::contact_columns(),
                          dynamics::CsvWriter::Flush::on_request);
  }
}

std::vector<Vec3> Frames::node_forces(const dynamics::Simulation& simulation) const {
  std::vector<Vec3> forces = simulation.forces().force;
  for (std::size_t i = 0; i < forces.size(); ++i)
    forces[i] += simulation.properties().mass[i] * simulation.gravity();
  return forces;
}

void Frames::write_part(const std::string& name, dynamics::PvdSeries& series,
                        const dynamics::PolyData& data) {
  const fs::path file = folder_ / "frames" / fmt::format("{}_{:05}.vtp", name, count_);
  dynamics::write_vtp(file, data);
  series.add({{data.time, name, file}});
}

void Frames::write_membranes(dynamics::Simulation& simulation, const dynamics::NodesView& nodes) {
  const std::vector<double> tensions = tensions_of(simulation);
  const auto membrane_forces = membrane_forces_of(simulation);
  const auto stresses = stresses_of(simulation);
  const auto tractions = simulation.facet_tractions();
  const auto& elements = simulation.elements();
  write_part("membranes", membranes_,
             dynamics::surface_frame({nodes, elements.cylinders, tensions, elements.facets,
                                      membrane_forces, stresses, tractions},
                                     simulation.time()));
}

std::vector<dynamics::ContactLabels> Frames::labels_of(
    const std::vector<contact::ContactRow>& contacts) const {
  std::vector<dynamics::ContactLabels> labels;
  labels.reserve(contacts.size());
  for (const contact::ContactRow& contact : contacts) {
    const BodyTable a = bodies_.table_of(contact.a);
    const BodyTable b = bodies_.table_of(contact.b);
    labels.push_back({static_cast<std::int32_t>(a.number), static_cast<std::int32_t>(b.number),
                      static_cast<std::int32_t>(bodies_.material_of(a)),
                      static_cast<std::int32_t>(bodies_.material_of(b))});
  }
  return labels;
}

void Frames::write_contacts(dynamics::Simulation& simulation) {
  const std::vector<contact::ContactRow> contacts = simulation.list_contacts();
  const std::vector<dynamics::ContactLabels> labels = labels_of(contacts);
  const double time = simulation.time();
  if (settings_.contacts)
    write_part("contacts", contacts_, dynamics::contacts_frame(contacts, time, labels));
  if (!contact_list_) return;
  std::vector<double> row;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    dynamics::fill_contact_row(time, contacts[i], labels[i], row);
    contact_list_->add(row);
  }
  contact_list_->flush();
}

void Frames::write(dynamics::Simulation& simulation) {
  const dynamics::NodeState& state = simulation.state();
  const std::vector<Vec3> forces = node_forces(simulation);
  const dynamics::NodesView nodes{state.position, state.velocity,   state.angular_velocity,
                                  forces,         bodies_.groups(), bodies_.materials()};
  if (settings_.grains) {
    write_part("grains", grains_,
               dynamics::grains_frame({nodes, simulation.elements().spheres, sphere_ids_},
                                      simulation.time()));
  }
  if (settings_.membranes) write_membranes(simulation, nodes);
  if (settings_.contacts || settings_.contact_list) write_contacts(simulation);
  ++count_;
}

}  // namespace plekton::apps
