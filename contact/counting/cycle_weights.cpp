// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/counting/cycle_weights.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::contact {
namespace {

/// Of the range. Levels of maxima that are as near are one, as rounding parts them in bodies that
/// are symmetric.
constexpr double kTie = 1e-12;

/// Of the overlap. Two vertices that are nearer to one distance have a link of this drop, which is
/// as good as none, whatever they do: what the rounding of energies makes of slopes by it stays
/// below eps / kLeastDrop.
constexpr double kLeastDrop = 1e-12;

/// In units of the deepest overlap: the power n + 1 of 1 / (o^2 - t^2) has to be a number. What is
/// left out so overlaps by 3e-12 of the deepest, or ends with a maximum that is as near to the
/// range.
constexpr double kLeastDifference = 1e-23;

/// n: the sharper, the less is given back beyond pieces and the less the force jumps where maxima
/// tie, and the faster it turns from saddle to saddle where two of these do.
constexpr int kSharpness = 12;

constexpr double power(double x, int n) noexcept {
  double result = 1.0;
  for (int i = 0; i < n; ++i) result *= x;
  return result;
}

/// (x^n - y^n) / (x - y)
constexpr double power_slope(double x, double y, int n) noexcept {
  double sum = 1.0;
  double last = 1.0;
  for (int i = 1; i < n; ++i) {
    last *= y;
    sum = sum * x + last;
  }
  return sum;
}

}  // namespace

std::span<const CycleWeights::Share> CycleWeights::find(const LevelComplex& complex, double range,
                                                        std::span<const double> energies) {
  complex_ = &complex;
  range_ = range;
  energies_ = energies;
  const auto distances = complex.distances();
  const auto count = static_cast<std::uint32_t>(distances.size());
  flows_.build(count, complex.links(), complex.fillings());
  slopes_.assign(count, 0.0);
  count_pieces();
  const auto fillers = flows_.basis().fillers();
  for (std::size_t i = 0; i < fillers.size();) {
    const std::uint32_t first = fillers[i];
    const double level = distances[first];
    while (i < fillers.size() && is_at(level, fillers[i])) ++i;
    end_holes({level, first, fillers[i - 1] + 1, maxima_at(level)});
  }
  end_holes({range, count, CycleBasis::kNone, {}});
  shares_.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    if (weights_[i] != 0.0 || slopes_[i] != 0.0) shares_.push_back({i, weights_[i], slopes_[i]});
  }
  return shares_;
}

/// As if every saddle joined pieces. In the order of the distances as they are rounded, so that
/// what is taken off here and what the holes give back agree about it.
void CycleWeights::count_pieces() {
  weights_.clear();
  for (const std::uint32_t branches : flows_.basis().branches()) weights_.push_back(1.0 - branches);
}

std::span<const std::uint32_t> CycleWeights::maxima_at(double level) const noexcept {
  const auto maxima = flows_.basis().maxima();
  const auto tied = [&](std::uint32_t maximum) { return is_at(level, maximum); };
  const auto first = std::find_if(maxima.begin(), maxima.end(), tied);
  return {first, std::find_if_not(first, maxima.end(), tied)};
}

bool CycleWeights::is_at(double level, std::uint32_t vertex) const noexcept {
  return std::abs(complex_->distances()[vertex] - level) <= kTie * range_;
}

void CycleWeights::end_holes(const End& end) {
  const CycleBasis& basis = flows_.basis();
  const bool is_maximum = !end.maxima.empty();
  const std::uint32_t filled = is_maximum ? end.first : CycleBasis::kNone;
  const std::size_t holes =
      is_maximum ? basis.shut_count(end.first, end.end) : basis.hole_count({end.first, filled});
  if (holes == 0) return;
  set_overlaps(end);
  // Vertices that tie with the level are left out, and the holes that begin with them.
  const ComplexPart below{static_cast<std::uint32_t>(overlaps_.size()), filled};
  set_resistances();
  const std::size_t flows = flows_.find(below, end.end, resistances_);
  if (flows > 0) {
    share_out();
    add_slopes(end);
  }
  // Holes that end as they begin.
  for (const std::uint32_t maximum : end.maxima)
    weights_[maximum] +=
        static_cast<double>(holes - flows) / static_cast<double>(end.maxima.size());
}

void CycleWeights::share_out() {
  values_.clear();
  for (std::size_t i = 0; i < resistances_.size(); ++i)
    values_.push_back(energies_[complex_->links()[i].a]);
  const auto shares = flows_.shares(values_);
  for (std::size_t i = 0; i < shares.size(); ++i) weights_[complex_->links()[i].a] += shares[i];
}

/// Of the vertices below a level.
void CycleWeights::set_overlaps(const End& end) {
  const auto distances = complex_->distances();
  const double unit = range_ - distances.front();
  level_overlap_ = (range_ - end.level) / unit;
  overlaps_.clear();
  inverses_.clear();
  for (const double distance : distances.first(end.first)) {
    const double below = end.level - distance;
    const double overlap = (range_ - distance) / unit;
    const double difference = below / unit * (overlap + level_overlap_);
    if (!(below > kLeastLife * range_ && difference > kLeastDifference)) break;
    overlaps_.push_back(overlap);
    inverses_.push_back(1.0 / difference);
  }
}

/// Of the links between them.
void CycleWeights::set_resistances() {
  const auto distances = complex_->distances();
  const double unit = range_ - distances.front();
  resistances_.clear();
  is_level_.clear();
  for (std::size_t i = 0; i < complex_->links().size(); ++i) {
    const Link& link = complex_->links()[i];
    if (link.a >= overlaps_.size()) break;
    const double least = kLeastDrop * overlaps_[link.a];
    const double drop = std::max((distances[link.a] - distances[link.b]) / unit, least);
    is_level_.push_back(drop == least);
    const double x = inverses_[link.a];
    const double y = inverses_[link.b];
    const double difference = drop * (overlaps_[link.a] + overlaps_[link.b]) * x * y;
    resistances_.push_back(difference * power_slope(x, y, kSharpness) /
                           complex_->multiplicities()[i]);
  }
}

void CycleWeights::add_slopes(const End& end) {
  const auto by_resistance = flows_.slopes(values_);
  const double per_metre = 2.0 * kSharpness / (range_ - complex_->distances().front());
  double of_level = 0.0;
  for (std::size_t i = 0; i < by_resistance.size(); ++i) {
    if (is_level_[i] != 0) continue;
    const Link& link = complex_->links()[i];
    const double slope = per_metre * by_resistance[i] / complex_->multiplicities()[i];
    // In this order, as the next power may overflow, and slopes be as small.
    const double upper = slope * power(inverses_[link.a], kSharpness) * inverses_[link.a];
    const double lower = slope * power(inverses_[link.b], kSharpness) * inverses_[link.b];
    slopes_[link.a] -= upper * overlaps_[link.a];
    slopes_[link.b] += lower * overlaps_[link.b];
    of_level += (upper - lower) * level_overlap_;
  }
  for (const std::uint32_t maximum : end.maxima)
    slopes_[maximum] += of_level / static_cast<double>(end.maxima.size());
}

}  // namespace plekton::contact
