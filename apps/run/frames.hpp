// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/body_tables.hpp"
#include "apps/run/history_file.hpp"
#include "apps/scenario/scenario.hpp"
#include "dynamics/output/csv_writer.hpp"
#include "dynamics/output/pvd_series.hpp"
#include "dynamics/output/scene_frame.hpp"
#include "dynamics/output/vtk_writer.hpp"
#include "dynamics/simulation.hpp"

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps {

/// One of the data sets of a frame.
struct FramePart {
  std::string name;  ///< of its series: "grains", "membranes" or "contacts"
  dynamics::PolyData data;
};

/// Whether a file of this name in the folder of frames is one of them.
bool is_frame(std::string_view name);

/// What is asked for and of which there is something in a simulation that begins; contacts always.
OutputSettings settings_for(OutputSettings settings, const dynamics::Simulation& simulation);

/// What a simulation looks like now: the data sets that are asked for.
/// @param contacts  those of the last step, where they are asked for
std::vector<FramePart> frame_of(const OutputSettings& settings, dynamics::Simulation& simulation,
                                const BodyTables& bodies,
                                const std::vector<contact::ContactRecord>& contacts);

/// Writes what a simulation looks like for ParaView: the time series grains.pvd, membranes.pvd and
/// contacts.pvd in a folder, their data sets in its folder frames. The series are valid after every
/// frame. If it is asked for, contacts.csv has the contacts of every frame too.
class Frames {
 public:
  /// Removes the series and frames that an earlier run left under the same names, or those that
  /// came after what a run goes on from.
  /// @param settings  settings_for() the simulation as it began
  /// @param bodies    have to stay as long as this
  /// @throws dynamics::OutputError
  Frames(const std::filesystem::path& folder, const OutputSettings& settings,
         const BodyTables& bodies, const WrittenFiles* before = nullptr);

  /// Writes the state of now. @throws dynamics::OutputError
  void write(dynamics::Simulation& simulation);

  std::size_t count() const noexcept { return times_.size(); }
  /// After a write.
  void tell(WrittenFiles& written) const;

 private:
  std::filesystem::path file_of(std::string_view part, std::size_t frame) const;
  void go_on(const WrittenFiles& before);
  void list_contacts(double time, const std::vector<contact::ContactRecord>& contacts);

  std::filesystem::path folder_;
  OutputSettings settings_;
  const BodyTables& bodies_;
  std::map<std::string, dynamics::PvdSeries> series_;  ///< by name
  HistoryFile contact_list_;
  std::vector<double> times_;  ///< s, by frame
};

}  // namespace plekton::apps
