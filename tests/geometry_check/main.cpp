// SPDX-License-Identifier: GPL-3.0-or-later
// plekton-geometry-check: puts the geometry kernel to adversarial queries, judged in exact rational
// arithmetic, and prints what it saw. Exit code 0: nothing wrong, 1: a violation, 2: a command line
// that cannot be understood.
#include "tests/geometry_check/check.hpp"

#include <CLI/CLI.hpp>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <mutex>
#include <stdexcept>

namespace {

using namespace plekton::geometry_check;

using Count = unsigned long long;  // what printf knows

void print_pairs(const Report& report) {
  std::printf("%-18s %-19s %10s %8s %9s %5s %9s %9s %6s %9s %11s %10s %10s %10s\n", "pair",
              "family", "queries", "wrong", "wrong", "NaN", "wrong", "one-", "jumps", "largest",
              "enumerated", "two-double", "interval", "exact");
  std::printf("%-18s %-19s %10s %8s %9s %5s %9s %9s %6s %9s %11s %10s %10s %10s\n", "", "", "",
              "region", "relation", "", "distance", "sided", "", "error", "", "signs", "signs",
              "signs");
  for (const PairTally& row : report.pairs) {
    if (row.queries == 0) continue;
    std::printf(
        "%-18s %-19s %10llu %8llu %9llu %5llu %9llu %9llu %6llu %9.1e %11llu %10llu %10llu "
        "%10llu\n",
        row.pair, row.family, Count{row.queries}, Count{row.wrong_regions},
        Count{row.wrong_relations}, Count{row.not_numbers}, Count{row.wrong_distances},
        Count{row.one_sided}, Count{row.jumps}, row.largest_error, Count{row.enumerated},
        Count{row.double_doubles}, Count{row.intervals}, Count{row.exact});
  }
}

void print_sums(const Report& report) {
  std::printf("\n%-40s %12s %12s %14s\n", "sum", "queries", "violations", "largest error");
  for (const PairKind& kind : kPairKinds) {
    PairTally sum{kind.name, ""};
    std::uint64_t violations = 0;
    for (const PairTally& row : report.pairs) {
      if (row.pair != kind.name) continue;
      sum.queries += row.queries;
      violations += row.violations();
      sum.largest_error = std::max(sum.largest_error, row.largest_error);
    }
    if (sum.queries == 0) continue;
    std::printf("%-40s %12llu %12llu %14.1e\n", kind.name, Count{sum.queries}, Count{violations},
                sum.largest_error);
  }
  for (const InvariantTally& row : report.invariants) {
    if (row.trials == 0) continue;
    std::printf("%-40s %12llu %12llu\n", row.name, Count{row.trials}, Count{row.violations});
  }
}

/// A line that is written over, on a terminal alone.
std::function<void(double)> progress_line() {
  if (isatty(STDERR_FILENO) == 0) return {};
  return [lock = std::make_shared<std::mutex>()](double done) {
    const std::scoped_lock guard(*lock);
    std::fprintf(stderr, "\r%3.0f %%%s", 100.0 * done, done < 1.0 ? "" : "\r     \r");
  };
}

}  // namespace

int main(int argc, char** argv) {
  CheckOptions options;
  CLI::App app{
      "Puts the geometry kernel to adversarial queries, each judged in exact rational arithmetic."};
  app.add_option("--queries", options.queries, "how many, over all pairs and invariants")
      ->capture_default_str()
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1000000000000}));
  app.add_option("--seed", options.seed, "of the random numbers")->capture_default_str();
  app.add_option("--threads", options.threads, "the report is the same for any number")
      ->capture_default_str()
      ->check(CLI::Range(1, 1024));
  app.add_option("--only", options.only, "rows with this in their names, as in \"structures\"")
      ->type_name("TEXT");
  app.add_option("--trials", options.trials, "of each row, whatever --queries says")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1000000000000}));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  options.progress = progress_line();

  const auto start = std::chrono::steady_clock::now();
  Report report;
  try {
    report = check(options, [](const plekton::geometry::Core& a, const plekton::geometry::Core& b) {
      return plekton::geometry::closest_points(a, b);
    });
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "plekton-geometry-check: --only: %s\n", error.what());
    return 2;
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;

  print_pairs(report);
  print_sums(report);
  for (const std::string& example : report.examples) std::printf("%s\n", example.c_str());
  std::printf("\n%llu queries, seed %llu, %.1f s: %llu violations\n", Count{report.queries()},
              Count{options.seed}, seconds.count(), Count{report.violations()});
  return report.violations() == 0 ? 0 : 1;
}
