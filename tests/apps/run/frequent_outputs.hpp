// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <vector>

/// A run that writes often, so that what happens to it happens while it writes; and its files.
namespace plekton::test::frequent_outputs {

namespace fs = std::filesystem;

/// Frames, rows and checkpoints every few steps.
inline std::vector<std::string> arguments(const std::string& out) {
  return {"run",
          "tests/same_bits/scenes/catch.toml",
          "--quiet",
          "--out",
          out,
          "--set",
          "simulation.duration=\"30 ms\"",
          "--set",
          "output.interval=\"0.3 ms\"",
          "--set",
          "output.history_interval=\"0.05 ms\"",
          "--set",
          "output.checkpoint_interval=\"0.4 ms\"",
          "--set",
          "output.contact_list=true"};
}

/// Everything but run.json, by its path in the folder.
inline std::map<std::string, std::string> contents_of(const fs::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    if (entry.is_regular_file() && name != "run.json") contents[name] = bytes_of(entry.path());
  }
  return contents;
}

/// Names of the files that differ, or are in one of the folders alone.
inline std::vector<std::string> differences(const std::map<std::string, std::string>& a,
                                            const std::map<std::string, std::string>& b) {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : a) {
    const auto other = b.find(name);
    if (other == b.end() || other->second != bytes) names.push_back(name);
  }
  for (const auto& [name, bytes] : b)
    if (!a.contains(name)) names.push_back(name);
  return names;
}

/// Rows end, and series name frames that are there whole.
inline void expect_whole_files(const fs::path& folder) {
  for (const auto& [name, bytes] : contents_of(folder)) {
    if (name.ends_with(".csv")) {
      EXPECT_TRUE(bytes.ends_with('\n')) << name;
    }
    if (!name.ends_with(".pvd")) continue;
    const std::regex listed("file=\"([^\"]*)\"");
    for (std::sregex_iterator it(bytes.begin(), bytes.end(), listed), end; it != end; ++it) {
      const std::string frame = bytes_of(folder / (*it)[1].str());
      EXPECT_NE(frame.find("</VTKFile>"), std::string::npos) << name << ": " << (*it)[1];
    }
  }
}

}  // namespace plekton::test::frequent_outputs
