// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

/// Slopes of energies and changes of forces along a way, of what is smooth there, and of what is
/// not.
namespace plekton::geometry_check {

/// How an energy is looked at along a way.
struct Differences {
  double largest_step;  ///< m
  double rounding;      ///< J, of the energy
  double tolerance;     ///< N, what a slope may be off
};

struct Slope {
  double value;      ///< N
  double step;       ///< m, the energy is smooth as far as twice of it on either side
  double tolerance;  ///< N, to which it is
};

/// Slope of an energy along a way at 0, of differences of the fourth order,
///
///     D(h) = (8 (E(h) - E(-h)) - (E(2 h) - E(-2 h))) / (12 h),
///
/// which have an error of h^4 where the energy is smooth. Where a feature comes into range within
/// 2 h the stiffness jumps there, and D has an error of h; a smaller step sees less of it, until
/// energies are rounded, each by e, and D by (2 * 8 + 2) / 12 e / h = 1.5 e / h.
///
/// Which step is believed is decided by the energies alone: the first one, each a tenth of the one
/// before, where D(h), D(h / 2) and D(h / 4) agree to a quarter of the tolerance, and where
///
///     2 K(h / 4) - K(h / 2),    K(h) = (E(h) - 2 E(0) + E(-h)) / h,
///
/// the slope ahead less that behind, is as small: D does not see a kink at 0 itself. Then D(h / 4)
/// is right to that: of an error of h^4 it has 1 / 240 of the difference of the
/// first two, of one of h all of the difference of the last two. Rounding stays below that: it moves
/// D(h / 2) and D(h / 4) by 3 and 6 e / h, 2 K(h / 4) and K(h / 2) by 32 and 8 e / h, and steps of
/// less than 48 e over the tolerance are not looked at. None where no such step is smooth.
template <class Energy>
std::optional<Slope> slope_at(const Energy& energy_at, const Differences& by) {
  const double here = energy_at(0.0);
  for (double step = by.largest_step;; step *= 0.1) {
    if (!(48.0 * by.rounding / step < by.tolerance)) return std::nullopt;
    double last = 0.0, last_kink = 0.0;
    bool is_smooth = true;
    for (const double h : {step, 0.5 * step, 0.25 * step}) {
      const double ahead = energy_at(h), behind = energy_at(-h);
      const double slope =
          (8.0 * (ahead - behind) - (energy_at(2.0 * h) - energy_at(-2.0 * h))) / (12.0 * h);
      const double kink = (ahead - 2.0 * here + behind) / h;
      if (h < step) is_smooth = is_smooth && std::abs(slope - last) < 0.25 * by.tolerance;
      if (h < 0.5 * step) is_smooth = is_smooth && std::abs(2.0 * kink - last_kink) < by.tolerance;
      if (!is_smooth) break;
      last = slope;
      last_kink = kink;
    }
    if (is_smooth) return Slope{last, step, by.tolerance};
  }
}

/// Of a step in its thousandth: 2^10 parts.
inline constexpr int kHalvings = 10;

using Forces = std::vector<geometry::Vec3>;

inline double size_of(const Forces& forces) {
  double sum = 0.0;
  for (const geometry::Vec3& force : forces) sum += force.norm();
  return sum;
}

/// times * a - b.
inline Forces difference(const Forces& a, const Forces& b, double times = 1.0) {
  Forces result;
  for (std::size_t i = 0; i < a.size(); ++i) result.push_back(times * a[i] - b[i]);
  return result;
}

/// Whether a tenth of a step makes a tenth of the change of forces, and a hundredth a hundredth, to
/// a tenth of it or of what one contact changes by, 1 N/m: of a wire that the way hardly turns the
/// change begins with the square of the step.
/// @param tolerance  N, besides
/// @param rounding   N, of the sum of all forces
template <class ForcesAt>
bool is_proportional_within(const ForcesAt& forces_at, double step, double tolerance,
                            double rounding) {
  constexpr std::array<double, 2> kParts{10.0, 100.0};
  const Forces here = forces_at(0.0);
  const Forces whole = difference(forces_at(step), here);
  return std::all_of(kParts.begin(), kParts.end(), [&](double times) {
    const Forces part = difference(forces_at(step / times), here);
    // Rounding at both ends, as often as the change is taken.
    const double off = 0.1 * std::max(size_of(whole), step) + tolerance + 4.0 * times * rounding;
    return size_of(difference(part, whole, times)) < off;
  });
}

/// Largest change (N, sum of all forces) in a step, in a thousandth of it, and in a millionth (all
/// but for 2^10 in place of 1000), as bisection finds it: of two halves it goes on with the one that
/// changes forces more, which is the one with the jump, if there is any that is larger than what
/// else there is.
template <class ForcesAt>
std::array<double, 3> steepest_changes(const ForcesAt& forces_at, double step) {
  double from = 0.0, to = step;
  Forces at_from = forces_at(from), at_to = forces_at(to);
  std::array<double, 3> changes{size_of(difference(at_to, at_from)), 0.0, 0.0};
  for (std::size_t size = 1; size < changes.size(); ++size) {
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (from + to);
      Forces at_middle = forces_at(middle);
      const bool is_behind =
          size_of(difference(at_middle, at_from)) > size_of(difference(at_to, at_middle));
      (is_behind ? to : from) = middle;
      (is_behind ? at_to : at_from) = std::move(at_middle);
    }
    changes[size] = size_of(difference(at_to, at_from));
  }
  return changes;
}

/// Whether forces change in proportion to the step along a way on which the energy is smooth, to
/// what the energies cannot tell: a contact that begins within the step bends them by no more. What
/// is smooth for differences of the fourth order may still bend much within their step, and forces
/// across the way may where the energy along it does not: a tenth of the step is looked at, and
/// where that bends, but no thousandth of it changes by as much as may be off, a tenth and a
/// hundredth of that. So a leap anywhere in the first one shows, and so does a change by another
/// power of the step.
/// @param rounding  N, of the sum of all forces
template <class ForcesAt>
bool is_proportional(const ForcesAt& forces_at, const Slope& smooth, double rounding) {
  const double step = 0.1 * smooth.step;
  if (is_proportional_within(forces_at, step, smooth.tolerance, rounding)) return true;
  const auto [whole, thousandth, millionth] = steepest_changes(forces_at, step);
  if (!(thousandth < 0.1 * std::max(whole, step) + smooth.tolerance)) return false;
  constexpr std::array<double, 2> kParts{0.1, 0.01};
  return std::any_of(kParts.begin(), kParts.end(), [&](double part) {
    return is_proportional_within(forces_at, part * step, part * smooth.tolerance, rounding);
  });
}

}  // namespace plekton::geometry_check
