// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/frames.hpp"

#include "apps/run/output_folder.hpp"
#include "dynamics/output/contact_fields.hpp"
#include "dynamics/output/file.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/bonds_along.hpp"
#include "dynamics/structure/sheet_facets.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <numeric>
#include <optional>
#include <string_view>
#include <system_error>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> kParts = {"grains", "membranes", "contacts"};

/// The number in the name of a file that Frames has written.
std::optional<std::size_t> frame_number(std::string_view name) {
  for (const std::string_view part : kParts) {
    if (!name.starts_with(part) || !name.ends_with(".vtp")) continue;
    const std::string_view middle = name.substr(part.size(), name.size() - part.size() - 4);
    if (!middle.starts_with('_')) continue;
    std::size_t number = 0;
    const auto [end, error] =
        std::from_chars(middle.data() + 1, middle.data() + middle.size(), number);
    if (error == std::errc() && end == middle.data() + middle.size()) return number;
  }
  return std::nullopt;
}

/// Frames from a number on. What cannot be removed will be replaced, or its replacement fails with
/// a message of its own.
void remove_frames(const fs::path& folder, std::size_t first) {
  std::error_code ignored;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder / "frames", ignored)) {
    const auto number = frame_number(entry.path().filename().string());
    if (number && *number >= first) old.push_back(entry.path());
  }
  for (const fs::path& file : old) fs::remove(file, ignored);
}

void remove_earlier(const fs::path& folder) {
  std::error_code ignored;
  for (const std::string_view part : kParts)
    fs::remove(folder / fmt::format("{}.pvd", part), ignored);
  fs::remove(folder / kContactsFile, ignored);
  remove_frames(folder, 0);
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
    while (next < sheets.size() &&
           (sheets.is_broken(next) || !simulation.scene().is_there(sheets.nodes(next)[0])))
      ++next;
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

/// Sum of contacts, bonds, loads and gravity on each node (N).
std::vector<Vec3> node_forces(const dynamics::Simulation& simulation) {
  std::vector<Vec3> forces = simulation.forces().force;
  for (std::size_t i = 0; i < forces.size(); ++i)
    forces[i] += simulation.properties().mass[i] * simulation.gravity();
  return forces;
}

std::vector<dynamics::ContactLabels> labels_of(const std::vector<contact::ContactRecord>& contacts,
                                               const BodyTables& bodies) {
  std::vector<dynamics::ContactLabels> labels;
  labels.reserve(contacts.size());
  for (const contact::ContactRecord& contact : contacts)
    labels.push_back(bodies.labels_of(contact));
  return labels;
}

dynamics::PolyData grains_of(const dynamics::Simulation& simulation,
                             const dynamics::NodesView& nodes) {
  const auto& spheres = simulation.elements().spheres;
  std::vector<std::int64_t> ids(spheres.size());
  std::iota(ids.begin(), ids.end(), 0);
  return dynamics::grains_frame({nodes, spheres, ids}, simulation.time());
}

dynamics::PolyData membranes_of(dynamics::Simulation& simulation,
                                const dynamics::NodesView& nodes) {
  const std::vector<double> tensions = tensions_of(simulation);
  const auto membrane_forces = membrane_forces_of(simulation);
  const auto stresses = stresses_of(simulation);
  const auto tractions = simulation.facet_tractions();
  const auto& elements = simulation.elements();
  return dynamics::surface_frame(
      {nodes, elements.cylinders, tensions, elements.facets, membrane_forces, stresses, tractions},
      simulation.time());
}

}  // namespace

bool is_frame(std::string_view name) {
  return frame_number(name).has_value();
}

OutputSettings settings_for(OutputSettings settings, const dynamics::Simulation& simulation) {
  const geometry::Elements& elements = simulation.elements();
  settings.grains = settings.grains && !elements.spheres.empty();
  settings.membranes =
      settings.membranes && (!elements.cylinders.empty() || !elements.facets.empty());
  return settings;
}

std::vector<FramePart> frame_of(const OutputSettings& settings, dynamics::Simulation& simulation,
                                const BodyTables& bodies,
                                const std::vector<contact::ContactRecord>& contacts) {
  const dynamics::NodeState& state = simulation.state();
  const std::vector<Vec3> forces = node_forces(simulation);
  const dynamics::NodesView nodes{state.position, state.velocity,  state.angular_velocity,
                                  forces,         bodies.groups(), bodies.materials()};
  std::vector<FramePart> parts;
  if (settings.grains) parts.push_back({"grains", grains_of(simulation, nodes)});
  if (settings.membranes) parts.push_back({"membranes", membranes_of(simulation, nodes)});
  if (settings.contacts)
    parts.push_back({"contacts", dynamics::contacts_frame(contacts, simulation.time(),
                                                          labels_of(contacts, bodies))});
  return parts;
}

Frames::Frames(const fs::path& folder, const OutputSettings& settings, const BodyTables& bodies,
               const WrittenFiles* before)
    : folder_(folder), settings_(settings), bodies_(bodies) {
  make_output_folder(folder_ / "frames");
  if (before == nullptr) remove_earlier(folder_);
  for (const std::string_view part : kParts)
    series_.try_emplace(std::string(part), folder_ / fmt::format("{}.pvd", part));
  if (settings_.contact_list)
    contact_list_.open(folder_, kContactsFile, dynamics::contact_columns(), before);
  if (before != nullptr) go_on(*before);
}

fs::path Frames::file_of(std::string_view part, std::size_t frame) const {
  return folder_ / "frames" / fmt::format("{}_{:05}.vtp", part, frame);
}

/// The series are written again, with the frames up to then: also those that from now on get none.
void Frames::go_on(const WrittenFiles& before) {
  times_ = before.frames;
  for (const std::string_view name : kParts) {
    const std::string part(name);
    std::vector<dynamics::SeriesEntry> entries;
    for (std::size_t frame = 0; frame < times_.size(); ++frame) {
      const fs::path file = file_of(part, frame);
      if (std::error_code ignored; fs::exists(file, ignored))
        entries.push_back({times_[frame], part, file});
    }
    std::error_code ignored;
    if (!entries.empty())
      series_.at(part).go_on(entries);
    else
      fs::remove(folder_ / fmt::format("{}.pvd", part), ignored);
  }
  // Not before the series name them no more.
  remove_frames(folder_, times_.size());
}

void Frames::tell(WrittenFiles& written) const {
  written.frames = times_;
  contact_list_.tell(written);
}

void Frames::list_contacts(double time, const std::vector<contact::ContactRecord>& contacts) {
  const std::vector<dynamics::ContactLabels> labels = labels_of(contacts, bodies_);
  std::vector<double> row;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    dynamics::fill_contact_row(time, contacts[i], labels[i], row);
    contact_list_.add_row(row);
  }
  contact_list_.flush();
}

void Frames::write(dynamics::Simulation& simulation) {
  std::vector<contact::ContactRecord> contacts;
  if (settings_.contacts || contact_list_.is_open()) contacts = simulation.list_contacts();
  for (const auto& [name, data] : frame_of(settings_, simulation, bodies_, contacts)) {
    const fs::path file = file_of(name, times_.size());
    dynamics::write_vtp(file, data);
    series_.at(name).add({{data.time, name, file}});
  }
  if (contact_list_.is_open()) list_contacts(simulation.time(), contacts);
  times_.push_back(simulation.time());
}

}  // namespace plekton::apps
