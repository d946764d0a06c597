// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace plekton::apps {

/// Where something in the input comes from.
struct Place {
  std::string source;  ///< file name, or an option of the command line
  int line = 0;        ///< from 1; 0 where lines mean nothing
  int column = 0;      ///< from 1
};

/// "catch.toml:12:8", or the source alone.
std::string to_string(const Place& place);

/// Input that cannot be used. The message lists every problem, a line each.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Collects the problems of an input, so that all of them are reported at once.
class Problems {
 public:
  void add(const Place& place, const std::string& text);
  /// Those of a later stage: what has been found in an earlier one is not said again, and of the rest
  /// it is said which stage has it.
  /// @param path  of the stage, as in "stages.shear"
  void add_of_stage(const std::string& path, const Problems& of_stage);

  std::size_t count() const noexcept { return problems_.size(); }
  bool empty() const noexcept { return problems_.empty(); }

  /// Every problem once, by source, line and column.
  std::vector<std::string> lines() const;

  /// @throws InputError with all problems, if there are any.
  void throw_if_any() const;

 private:
  struct Problem {
    Place place;
    std::string text;
    std::string stage;  ///< in front of the text
  };
  std::vector<Problem> problems_;
};

}  // namespace plekton::apps
