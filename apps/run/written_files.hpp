// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace plekton::apps {

// The histories of a run.
inline constexpr const char* kHistoryFile = "energy.csv";
inline constexpr const char* kReactionsFile = "reactions.csv";
inline constexpr const char* kPressuresFile = "pressures.csv";
inline constexpr const char* kRigidBodiesFile = "rigid_bodies.csv";
inline constexpr const char* kTiesFile = "ties.csv";
inline constexpr const char* kPlanesFile = "planes.csv";
inline constexpr const char* kMeasuresFolder = "measures";  ///< a file for each
inline constexpr const char* kContactsFile = "contacts.csv";

/// What a run has written at a moment: where it goes on from a checkpoint.
struct WrittenFiles {
  std::map<std::string, std::uint64_t> sizes;  ///< bytes, of histories by their names
  std::vector<double> frames;                  ///< s, the time of each
};

}  // namespace plekton::apps
