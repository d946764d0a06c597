// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/geometry_check/check.hpp"

#include "tests/geometry_check/invariant_check.hpp"

#include <atomic>
#include <stdexcept>
#include <thread>

namespace plekton::geometry_check {
namespace {

/// A seed of its own for every row (SplitMix64, Steele, Lea & Flood, OOPSLA 2014).
std::uint64_t seed_of(std::uint64_t seed, std::size_t row) {
  std::uint64_t z = seed + (row + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

std::uint64_t share_of(std::uint64_t queries, std::uint64_t rows) {
  return (queries + rows - 1) / rows;
}

/// A row of the table, by its place among all.
struct Row {
  std::size_t place;
  std::string name;
};

std::vector<Row> all_rows(const Report& report) {
  std::vector<Row> rows;
  for (const PairTally& row : report.pairs)
    rows.push_back({rows.size(), std::string(row.pair) + ' ' + row.family});
  for (const InvariantTally& row : report.invariants) rows.push_back({rows.size(), row.name});
  return rows;
}

std::vector<Row> rows_with(const std::string& text, const Report& report) {
  std::vector<Row> rows = all_rows(report);
  std::string names;
  for (const Row& row : rows) names += "\n  " + row.name;
  std::erase_if(rows, [&](const Row& row) { return row.name.find(text) == std::string::npos; });
  if (rows.empty())
    throw std::invalid_argument("no row has \"" + text + "\" in its name; the rows are" + names);
  return rows;
}

}  // namespace

Report check(const CheckOptions& options, const Kernel& kernel) {
  Report report{pair_rows(), invariant_rows(), {}};
  const std::size_t pair_count = report.pairs.size();
  const std::vector<Row> rows = rows_with(options.only, report);
  const std::uint64_t for_pairs = options.queries - options.queries / 5;
  const auto count = [&](std::uint64_t by_queries) {
    return options.trials > 0 ? options.trials : by_queries;
  };
  std::vector<std::vector<std::string>> examples(rows.size());
  std::atomic<std::size_t> next = 0, done = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < rows.size(); i = next++) {
      const std::size_t row = rows[i].place;
      const std::uint64_t seed = seed_of(options.seed, row);
      if (row < pair_count) {
        check_pairs(report.pairs[row], count(share_of(for_pairs, pair_count)), seed, kernel,
                    examples[i]);
      } else {
        InvariantTally& invariant = report.invariants[row - pair_count];
        check_invariant(invariant, count(share_of(options.queries, 40 * invariant.cost)), seed,
                        examples[i]);
      }
      if (options.progress)
        options.progress(static_cast<double>(++done) / static_cast<double>(rows.size()));
    }
  };
  std::vector<std::jthread> others;
  for (int i = 1; i < options.threads; ++i) others.emplace_back(work);
  work();
  others.clear();  // joins
  for (const auto& of_row : examples)
    report.examples.insert(report.examples.end(), of_row.begin(), of_row.end());
  return report;
}

}  // namespace plekton::geometry_check
