// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/problems.hpp"

#include "geometry/base/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace plekton::apps {

std::string to_string(const Place& place) {
  if (place.line == 0) return place.source;
  return fmt::format("{}:{}:{}", place.source, place.line, place.column);
}

void Problems::add(const Place& place, const std::string& text) {
  problems_.push_back({place, text, ""});
}

void Problems::add_of_stage(const std::string& path, const Problems& of_stage) {
  const auto is_at = [](const Place& place) {
    return [&place](const Problem& other) { return to_string(other.place) == to_string(place); };
  };
  for (const Problem& problem : of_stage.problems_) {
    const bool is_known =
        std::any_of(problems_.begin(), problems_.end(), [&](const Problem& other) {
          return other.text == problem.text && is_at(problem.place)(other);
        });
    // The duration of a stage is that of its scenario too: one fault, one message.
    const bool is_said = problem.text.starts_with("simulation.duration") &&
                         std::count_if(of_stage.problems_.begin(), of_stage.problems_.end(),
                                       is_at(problem.place)) > 1;
    if (is_known || is_said) continue;
    const bool names_it = path.empty() || problem.text.starts_with("stages");
    problems_.push_back({problem.place, problem.text, names_it ? "" : path + ": "});
  }
}

std::vector<std::string> Problems::lines() const {
  std::vector<Problem> sorted = problems_;
  const auto key = [](const Problem& p) {
    return std::tie(p.place.source, p.place.line, p.place.column);
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Problem& a, const Problem& b) { return key(a) < key(b); });
  std::vector<std::string> lines;
  lines.reserve(sorted.size());
  for (const Problem& problem : sorted)
    lines.push_back(
        geometry::printable(to_string(problem.place) + ": " + problem.stage + problem.text));
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

void Problems::throw_if_any() const {
  if (problems_.empty()) return;
  const std::vector<std::string> all = lines();
  throw InputError(fmt::format("{}", fmt::join(all, "\n")));
}

}  // namespace plekton::apps
