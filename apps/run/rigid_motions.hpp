// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/written_files.hpp"
#include "apps/scene/build_scene.hpp"
#include "dynamics/output/csv_writer.hpp"
#include "dynamics/output/output_field.hpp"
#include "dynamics/simulation.hpp"

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace plekton::apps {

/// What rigid_bodies.csv has of every rigid body, behind its name and a dot.
std::span<const dynamics::OutputField> rigid_fields();

/// Writes rigid_bodies.csv, if there are rigid bodies: how they move and what acts on them.
class RigidMotions {
 public:
  /// Removes the file of an earlier run, unless that goes on. @throws dynamics::OutputError
  RigidMotions(const std::filesystem::path& folder, const BuiltScene& built,
               const WrittenFiles* before = nullptr);

  /// Appends a row; rows reach the file in blocks, at flush() and at close(). @throws
  /// dynamics::OutputError
  void add(const dynamics::Simulation& simulation);
  void flush();
  void close();
  /// After a flush.
  void tell(WrittenFiles& written) const;

 private:
  std::vector<geometry::NodeId> references_;
  std::vector<geometry::Quat> starts_;  // orientations, of the principal axes
  std::unique_ptr<dynamics::CsvWriter> writer_;
};

}  // namespace plekton::apps
