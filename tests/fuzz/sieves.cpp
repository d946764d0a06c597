// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target of sieve tables. The first byte says what passing counts and whether the rows are
// put in order; each row is the 8 bytes of a size (m) and 2 of what passes. A table is refused with
// an InputError, or gives a curve whose grains have sizes of the table.
#include "apps/grains/random.hpp"
#include "apps/scenario/scenario_reader.hpp"
#include "tests/fuzz/require.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace {

using namespace plekton::apps;
using plekton::fuzz::require;

constexpr std::size_t kRowBytes = 10;
constexpr std::size_t kMostRows = 50;

std::vector<Sieve> rows_of(const std::uint8_t* data, std::size_t size, bool in_order) {
  std::vector<Sieve> rows(std::min(size / kRowBytes, kMostRows));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::uint16_t passing = 0;
    std::memcpy(&rows[i].size, data + i * kRowBytes, sizeof rows[i].size);
    std::memcpy(&passing, data + i * kRowBytes + sizeof rows[i].size, sizeof passing);
    rows[i].passing = passing / 65535.0;
  }
  if (!in_order || rows.empty()) return rows;
  for (Sieve& row : rows) row.size = std::isfinite(row.size) ? std::abs(row.size) : 1.0;
  const auto by_size = [](const Sieve& a, const Sieve& b) { return a.size < b.size; };
  std::sort(rows.begin(), rows.end(), by_size);
  std::vector<double> passing;
  for (const Sieve& row : rows) passing.push_back(row.passing);
  std::sort(passing.begin(), passing.end());
  passing.front() = 0.0;
  passing.back() = 1.0;
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].passing = passing[i];
  return rows;
}

std::string scenario_with(const std::vector<Sieve>& rows, bool by_number) {
  std::string text =
      "[simulation]\nduration = 1\n[materials.stone]\ndensity = 2650\nyoung_modulus = 1e7\n"
      "friction_angle = 0.5\n[[grains]]\nmaterial = \"stone\"\ncount = 10\n"
      "box = { min = [0, 0, 0], max = [1, 1, 1] }\n";
  text += fmt::format("passing_by = \"{}\"\nsieves = [", by_number ? "number" : "mass");
  for (const Sieve& row : rows)
    text += fmt::format("{{ sieve = {:.17e}, passing = {:.17e} }}, ", row.size, row.passing);
  return text + "]\n";
}

void require_sound(const SizeCurve& curve, const std::vector<Sieve>& rows) {
  const double volume = curve.mean_volume();
  require(std::isfinite(volume) && volume > 0.0, "a mean volume that is none");
  const double least = rows.front().size, most = rows.back().size;
  double before = 0.0;
  for (int i = 0; i <= 16; ++i) {
    const double diameter = curve.diameter_at(i / 16.0);
    require(diameter >= least && diameter <= most, "a grain of no size of the table");
    require(diameter >= before, "smaller grains for a larger share");
    before = diameter;
  }
  Random random(1);
  for (const double diameter : curve.draw(20, random))
    require(diameter >= least && diameter <= most, "a drawn grain of no size of the table");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::vector<Sieve> rows = rows_of(data + 1, size - 1, (data[0] & 2U) != 0);
  try {
    const Scenario scenario =
        parse_scenario(scenario_with(rows, (data[0] & 1U) != 0), "/nonexistent/fuzzed.toml");
    require_sound(scenario.grains.at(0).sizes, rows);
  } catch (const InputError& error) {
    require(error.what()[0] != '\0', "a refusal without a message");
  }
  return 0;
}
