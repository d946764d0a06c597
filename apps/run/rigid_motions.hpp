// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/history_file.hpp"
#include "apps/scene/build_scene.hpp"
#include "dynamics/simulation.hpp"

#include <filesystem>
#include <span>
#include <vector>

namespace plekton::apps {

/// What rigid_bodies.csv has of every rigid body, behind its name and a dot.
std::span<const dynamics::OutputField> rigid_fields();

/// Writes rigid_bodies.csv, if there are rigid bodies: how they move and what acts on them.
class RigidMotions : public HistoryFile {
 public:
  /// @throws dynamics::OutputError
  RigidMotions(const std::filesystem::path& folder, const BuiltScene& built,
               const WrittenFiles* before = nullptr);

  /// Appends a row. @throws dynamics::OutputError
  void add(const dynamics::Simulation& simulation);

 private:
  std::vector<geometry::NodeId> references_;
  std::vector<geometry::Quat> starts_;  // orientations, of the principal axes
  std::vector<bool> are_absent_;        // by body, in this stage
};

}  // namespace plekton::apps
