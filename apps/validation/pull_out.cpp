// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/pull_out_bed.hpp"
#include "apps/validation/recorded.hpp"
#include "apps/validation/validation_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace plekton::apps::pull_out {
namespace {

constexpr std::uint64_t kFirstSeed = 3;

std::string_view name_of(Kind kind) {
  return kind == Kind::membrane ? "membrane" : "grid";
}

/// The mean of some beds.
PullOut mean_of(const std::vector<PullOut>& pulls) {
  PullOut mean = pulls.front();
  mean.mean = mean.pressure = 0.0;
  for (const PullOut& pull : pulls) {
    const double part = 1.0 / static_cast<double>(pulls.size());
    mean.mean += part * pull.mean;
    mean.pressure += part * pull.pressure;
    mean.largest = std::max(mean.largest, pull.largest);
  }
  return mean;
}

/// @param beds  how many, one after the other
PullOut pulled(Kind kind, int beds, Figure& figure) {
  std::vector<PullOut> pulls;
  for (int i = 0; i < beds; ++i) {
    pulls.push_back(pulled_out(kind, kFirstSeed + static_cast<std::uint64_t>(i)));
    figure.curves.push_back(
        {fmt::format("{}{}", name_of(kind), beds > 1 ? fmt::format(", bed {}", i + 1) : ""),
         CurveStyle::line, pulls.back().out, pulls.back().shares});
  }
  return mean_of(pulls);
}

/// Of the mean of the last half.
constexpr double kLeastMembrane = 0.18, kLeastGrid = 0.35, kMostGrid = 0.65;

Curve bound(const char* name, double share) {
  return {name, CurveStyle::dashed, {0.5 * kPull, kPull}, {share, share}};
}

Curve recorded_of(Kind kind) {
  Curve curve = recorded_curve(fmt::format("yade_pull_out_{}", name_of(kind)));
  curve.name += fmt::format(", {}", name_of(kind));
  return curve;
}

}  // namespace

/// Grains that slide on a membrane hold it with at most their friction; those that interlock with a
/// grid of the same lattice hold it better.
CaseReport validate(bool full) {
  const int beds = full ? 3 : 1;
  Figure figure{"Pull-out at 20 kPa", "way of the front edge (m)", "pull over 2 sigma A", {}};
  const PullOut membrane = pulled(Kind::membrane, beds, figure);
  const PullOut grid = pulled(Kind::grid, beds, figure);
  const double phi = kFriction;
  figure.curves.push_back(
      {"tan of the friction angle", CurveStyle::dashed, {0.0, kPull}, {phi, phi}});
  figure.curves.push_back(bound("membrane, at least", kLeastMembrane));
  figure.curves.push_back(bound("grid, at least", kLeastGrid));
  figure.curves.push_back(bound("grid, at most", kMostGrid));
  figure.curves.push_back(recorded_of(Kind::membrane));
  figure.curves.push_back(recorded_of(Kind::grid));
  const double middle = 0.5 * (kLeastMembrane + phi);
  constexpr double kScatter = 0.02;  // standard deviation over three beds
  CaseReport report;
  report.findings = {
      {"pull on a membrane over 2 sigma A, mean of the last half", membrane.mean, middle,
       phi - middle, "", "grains slide on it, and roll too: 0.18 to tan(20 deg)"},
      {"largest pull on a membrane over 2 sigma A", membrane.largest, 0.51 * phi, 0.51 * phi, "",
       "grains slide on it: at most 1.02 tan(20 deg)"},
      {"pull on a grid over 2 sigma A, mean of the last half", grid.mean,
       0.5 * (kLeastGrid + kMostGrid), 0.5 * (kMostGrid - kLeastGrid), "",
       "grains interlock with it: 0.35 to 0.65; YADE 2023.02a: 0.477"},
      {"that of the grid over that of the membrane, less two scatters of both",
       grid.mean - membrane.mean - 4.0 * kScatter, 0.25, 0.25, "", "above 0"},
      {"pressure of the plates on the membrane's bed", membrane.pressure, kPressure,
       0.05 * kPressure, "Pa", "what the servos are told"},
      {"pressure of the plates on the grid's bed", grid.pressure, kPressure, 0.05 * kPressure, "Pa",
       "what the servos are told"}};
  report.figures.push_back(std::move(figure));
  return report;
}

}  // namespace plekton::apps::pull_out
