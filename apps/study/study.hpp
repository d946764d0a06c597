// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/problems.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plekton::apps {

/// What is taken of the values in a column; change: the last less the first.
enum class Take : std::uint8_t { last, first, max, min, mean, change };

/// A number of each run that goes into the table of a study.
struct ResultSettings {
  std::string name;
  Place place;
  std::string report;          ///< path in run.json, as in "timing.steps"; or empty, and then
  std::string file;            ///< CSV file of the run
  std::string column;          ///< in it, without its unit
  Take take = Take::last;      ///< of the rows between from and to
  std::optional<double> at;    ///< s, instead: the value then, between two rows in proportion
  std::optional<double> from;  ///< s
  std::optional<double> to;    ///< s
};

/// One run of a study.
struct StudyPoint {
  Place place;  ///< what asks for it
  std::vector<std::string>
      values;  ///< by parameter, as --set takes them; empty: as in the scenario
};

/// Many runs of one scenario; apps/study.md documents the file.
struct Study {
  std::filesystem::path file;
  std::filesystem::path scenario;
  std::vector<std::string> common;      ///< "path=value" of all runs
  std::vector<std::string> parameters;  ///< paths, as --set takes them
  std::vector<StudyPoint> points;
  std::vector<ResultSettings> results;
  int jobs = 0;     ///< at a time; 0: as many as there are processors for
  int threads = 1;  ///< of each
};

/// "path=value" each, of a point (from 0).
std::vector<std::string> overrides_of(const Study& study, std::size_t point);

/// @throws InputError listing every problem of the file, each with its place
Study read_study(const std::filesystem::path& file);

}  // namespace plekton::apps
