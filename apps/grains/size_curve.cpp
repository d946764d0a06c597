// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/grains/size_curve.hpp"

#include "apps/grains/random.hpp"
#include "geometry/base/elementary.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numbers>

namespace plekton::apps {
namespace {

constexpr double kSphere =
    std::numbers::pi / 6.0;  // volume of a ball over the cube of its diameter

}  // namespace

SizeCurve::SizeCurve(double diameter) : bins_{{diameter, diameter, 1.0}} {
  mean_volume_ = kSphere * elementary::pow(diameter, 3);
}

SizeCurve::SizeCurve(std::span<const Sieve> sieves, PassingBy by) : by_(by) {
  assert(sieves.size() >= 2);
  for (std::size_t i = 0; i + 1 < sieves.size(); ++i) {
    const auto& [low, passing_low] = sieves[i];
    const auto& [high, passing_high] = sieves[i + 1];
    const double share = passing_high - passing_low;
    if (share <= 0.0) continue;
    // By mass: share / (high - low) per metre and over kBall d³ for the number; its integral over
    // the bin.
    const double per_volume = (low + high) / (2.0 * low * low * high * high) / kSphere;
    bins_.push_back({low, high, by == PassingBy::mass ? share * per_volume : share});
  }
  normalise();
}

void SizeCurve::normalise() {
  double total = 0.0;
  for (const Bin& bin : bins_) total += bin.share;
  for (Bin& bin : bins_) {
    bin.share /= total;
    const double a = bin.low, b = bin.high;
    // Mean of d³ with a uniform density of d, or with one proportional to d^-3.
    const double mean_cube =
        by_ == PassingBy::number ? 0.25 * (a + b) * (a * a + b * b) : 2.0 * a * a * b * b / (a + b);
    mean_volume_ += bin.share * kSphere * mean_cube;
  }
}

double SizeCurve::largest_diameter() const noexcept {
  return bins_.back().high;
}

double SizeCurve::diameter_at(double share_by_number) const noexcept {
  if (share_by_number >= 1.0)
    return largest_diameter();  // the sum of the shares is 1 but for rounding
  double below = 0.0;
  const Bin* bin = &bins_.front();
  for (const Bin& candidate : bins_) {
    bin = &candidate;
    if (share_by_number <= below + candidate.share) break;
    below += candidate.share;
  }
  const double t = std::clamp((share_by_number - below) / bin->share, 0.0, 1.0);
  const double a = bin->low, b = bin->high;
  if (by_ == PassingBy::number) return a + t * (b - a);
  // With density d^-3 the share below d is (a^-2 - d^-2) / (a^-2 - b^-2).
  const double inverse_square = (1.0 - t) / (a * a) + t / (b * b);
  return std::clamp(1.0 / std::sqrt(inverse_square), a, b);
}

std::vector<double> SizeCurve::draw(std::size_t count, Random& random) const {
  std::vector<double> diameters(count);
  for (std::size_t i = 0; i < count; ++i) {
    diameters[i] =
        diameter_at((static_cast<double>(i) + random.unit()) / static_cast<double>(count));
  }
  std::sort(diameters.begin(), diameters.end(), std::greater<>());
  return diameters;
}

}  // namespace plekton::apps
