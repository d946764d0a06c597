// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/tie_histories.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace plekton::apps {
namespace {

constexpr std::array<dynamics::OutputField, 6> kTieFields = {{
    {"largest_tension", "N", "of any of them, in the last step; below 0: all of them push"},
    {"mean_tension", "N", "of those that are whole"},
    {"largest_slip", "m", "way along the cable so far, or what the brake has paid out"},
    {"elastic", "J", "energy stored in them"},
    {"dissipated", "J", "taken so far by friction, by brakes and as they broke"},
    {"broken", "", "how many so far"},
}};

constexpr std::array<dynamics::OutputField, 3> kSingleFields = {{
    {"tension", "N", "in the last step; below 0: it pushes"},
    {"slip", "m", "way along the cable so far, or what the brake has paid out"},
    {"broken", "", "1 once it is broken"},
}};

/// The numbers of kTieFields.
std::array<double, kTieFields.size()> numbers_of(const BuiltTies& table,
                                                 const dynamics::Ties& ties) {
  double largest = 0.0, sum = 0.0, slip = 0.0, elastic = 0.0, dissipated = 0.0;
  std::size_t whole = 0;
  for (std::size_t i = table.first; i < table.first + table.count; ++i) {
    slip = std::max(slip, ties.slip(i));
    dissipated += ties.dissipated(i);
    if (ties.is_broken(i)) continue;
    largest = whole == 0 ? ties.pull(i) : std::max(largest, ties.pull(i));
    sum += ties.pull(i);
    elastic += ties.elastic_energy(i);
    ++whole;
  }
  const double mean = whole > 0 ? sum / static_cast<double>(whole) : 0.0;
  return {largest, mean, slip, elastic, dissipated, static_cast<double>(table.count - whole)};
}

}  // namespace

std::span<const dynamics::OutputField> tie_fields() {
  return kTieFields;
}

std::span<const dynamics::OutputField> single_tie_fields() {
  return kSingleFields;
}

TieHistories::TieHistories(const std::filesystem::path& folder, const BuiltScene& built,
                           const WrittenFiles* before)
    : tables_(built.ties) {
  HistoryColumns columns;
  for (const BuiltTies& table : tables_) {
    columns.add(table.name, kTieFields);
    for (std::size_t i = 0; table.lists_each && i < table.count; ++i)
      columns.add(table.name + "[" + std::to_string(i) + "]", kSingleFields);
  }
  open(folder, kTiesFile, columns, before);
}

void TieHistories::add(const dynamics::Simulation& simulation) {
  if (!is_open()) return;
  const dynamics::Ties& ties = simulation.ties();
  std::vector<double> row{simulation.time()};
  for (const BuiltTies& table : tables_) {
    const auto numbers = numbers_of(table, ties);
    row.insert(row.end(), numbers.begin(), numbers.end());
    for (std::size_t i = table.first; table.lists_each && i < table.first + table.count; ++i)
      row.insert(row.end(), {ties.pull(i), ties.slip(i), ties.is_broken(i) ? 1.0 : 0.0});
  }
  add_row(row);
}

}  // namespace plekton::apps
