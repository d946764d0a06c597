// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/history_file.hpp"
#include "apps/scene/build_scene.hpp"
#include "dynamics/simulation.hpp"

#include <filesystem>
#include <span>
#include <vector>

namespace plekton::apps {

/// What reactions.csv has of every reaction, for each of three axes, behind its name and a dot.
std::span<const dynamics::OutputField> reaction_fields();

/// What a reaction is in the last step.
struct ReactionValue {
  dynamics::ForceAndMoment value;
  Vec3 position;  ///< m, of the point of the plane, or the mean of the nodes
};

/// @param contacts  of the last step, for a reaction of kind contacts
ReactionValue reaction_in(const dynamics::Simulation& simulation, const BuiltReaction& reaction,
                          std::span<const contact::ContactRecord> contacts);

/// Writes reactions.csv, if any are asked for.
class Reactions : public HistoryFile {
 public:
  /// @throws dynamics::OutputError
  Reactions(const std::filesystem::path& folder, const std::vector<BuiltReaction>& reactions,
            const std::vector<std::string>& of_all_stages = {},
            const WrittenFiles* before = nullptr);

  bool empty() const noexcept { return reactions_.empty(); }

  /// Appends a row. @throws dynamics::OutputError
  void add(dynamics::Simulation& simulation);

 private:
  std::vector<BuiltReaction> reactions_;
  std::vector<std::string> names_;  ///< of all stages
  bool lists_contacts_ = false;     ///< one of them is of kind contacts
};

}  // namespace plekton::apps
