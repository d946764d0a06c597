// SPDX-License-Identifier: GPL-3.0-or-later
#include <plekton/contact/law_list.hpp>
#include <plekton/dynamics/output/csv_writer.hpp>
#include <plekton/dynamics/simulation.hpp>
#include <plekton/geometry/mesh/io/import.hpp>

#include <array>
#include <filesystem>
#include <iostream>

using namespace plekton;

namespace {

/// Members with a usual value need not be named.
dynamics::Scene scene() {
  dynamics::Scene result{.materials = {{1e7, 0.3, 0.5}}};
  result.add_sphere({0, 0, 0.06}, 0.05, 2650.0, contact::MaterialId{0});
  result.loads = {.forces = {{.nodes = {geometry::NodeId{0}}, .force = {0, 0, 1}}}};
  return result;
}

bool refuses_a_file_that_is_not_there() {
  dynamics::Simulation simulation(scene(), {.time_step = 1e-5});
  try {
    simulation.load("none.h5");
  } catch (const dynamics::CheckpointError& error) {
    std::cout << error.what() << '\n';
    return true;
  }
  return false;
}

}  // namespace

int main() {
  const geometry::ImportOptions import{.scale = 0.001};
  const geometry::Elements elements{.spheres = {{{geometry::NodeId{0}}, 1.0}}};
  const contact::ContactSettings contact{.restitution = 0.5};
  if (import.repair.wrap || !elements.facets.empty() || contact.law != 0) return 1;
  if (!refuses_a_file_that_is_not_there()) return 1;

  const std::filesystem::path file = "history.csv";
  const std::array<plekton::dynamics::CsvColumn, 2> columns{{{"time", "s"}, {"height", "m"}}};

  plekton::dynamics::CsvWriter history(file, columns);
  history.add({0.0, 1.0});
  history.close();

  const auto size = std::filesystem::file_size(file);
  std::filesystem::remove(file);
  std::cout << size << " bytes of history written\n";
  return size > 0 ? 0 : 1;
}
