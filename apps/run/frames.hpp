// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/body_tables.hpp"
#include "apps/scenario/scenario.hpp"
#include "dynamics/output/csv_writer.hpp"
#include "dynamics/output/pvd_series.hpp"
#include "dynamics/output/scene_frame.hpp"
#include "dynamics/output/vtk_writer.hpp"
#include "dynamics/simulation.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plekton::apps {

/// Writes what a simulation looks like for ParaView: the time series grains.pvd, membranes.pvd and
/// contacts.pvd in a folder, their data sets in its folder frames. The series are valid after every
/// frame. If it is asked for, contacts.csv has the contacts of every frame too.
class Frames {
 public:
  /// Removes the series and frames that an earlier run left under the same names.
  /// @param bodies  have to stay as long as this
  /// @throws dynamics::OutputError
  Frames(const std::filesystem::path& folder, const OutputSettings& settings,
         const dynamics::Simulation& simulation, const BodyTables& bodies);

  /// Writes the state of now. @throws dynamics::OutputError
  void write(dynamics::Simulation& simulation);

  std::size_t count() const noexcept { return count_; }

 private:
  void write_part(const std::string& name, dynamics::PvdSeries& series,
                  const dynamics::PolyData& data);
  /// Sum of contacts, bonds, loads and gravity on each node (N).
  std::vector<Vec3> node_forces(const dynamics::Simulation& simulation) const;
  std::vector<dynamics::ContactLabels> labels_of(
      const std::vector<contact::ContactRow>& contacts) const;
  void write_membranes(dynamics::Simulation& simulation, const dynamics::NodesView& nodes);
  void write_contacts(dynamics::Simulation& simulation);

  std::filesystem::path folder_;
  OutputSettings settings_;
  const BodyTables& bodies_;
  std::vector<std::int64_t> sphere_ids_;
  dynamics::PvdSeries grains_;
  dynamics::PvdSeries membranes_;
  dynamics::PvdSeries contacts_;
  std::optional<dynamics::CsvWriter> contact_list_;
  std::size_t count_ = 0;
};

}  // namespace plekton::apps
