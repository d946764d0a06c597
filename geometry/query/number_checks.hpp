// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/largest_coordinate.hpp"
#include "geometry/closest/primitive_pairs.hpp"

#include <ostream>
#include <span>
#include <string>

/// What keeps distances from being taken, in a line each.
namespace plekton::geometry {

/// Of many that are wrong alike as many get lines; of the others the last line tells how many.
inline constexpr std::size_t kMostListed = 8;

inline bool is_in_range(const Vec3& x) noexcept {
  return x.allFinite() && x.cwiseAbs().maxCoeff() < kLargestCoordinate;
}

/// Whether distances of a probe can be taken.
inline bool is_usable(const Probe& probe) noexcept {
  if (probe.core.count < 1 || probe.core.count > 3) return false;
  if (!(probe.radius >= 0.0 && probe.radius < kLargestCoordinate)) return false;
  double largest = 0.0;
  for (const Vec3& corner : probe.core.corners())
    largest += corner.cwiseAbs().sum();  // NaN stays NaN
  if (largest < kLargestCoordinate) return true;
  for (const Vec3& corner : probe.core.corners())
    if (!is_in_range(corner)) return false;
  return true;
}

/// @param name  which probe that is
inline void list_probe_problems(const Probe& probe, std::ostream& problems,
                                const std::string& name = "the probe") {
  if (probe.core.count < 1 || probe.core.count > 3) {
    problems << name << " has " << probe.core.count << " corners; expected 1, 2 or 3\n";
    return;
  }
  if (!(probe.radius >= 0.0 && probe.radius < kLargestCoordinate))
    problems << name << " has radius " << probe.radius << " m; expected from 0 to below 1e75\n";
  for (const Vec3& corner : probe.core.corners()) {
    if (!is_in_range(corner)) {
      problems << name << " has a corner at (" << corner.transpose()
               << ") m; coordinates must be finite and below 1e75\n";
    }
  }
}

/// Calls list(i) for the first of those of a count that are wrong.
/// @param plural  what they are
template <class IsWrong, class List>
void list_first(std::size_t count, const char* plural, std::ostream& problems,
                const IsWrong& is_wrong, const List& list) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (is_wrong(i) && wrong++ < kMostListed) list(i);
  }
  if (wrong > kMostListed)
    problems << "and " << wrong - kMostListed << " more " << plural << " like these\n";
}

inline void list_probe_problems(std::span<const Probe> probes, std::ostream& problems) {
  list_first(
      probes.size(), "probes", problems, [&](std::size_t i) { return !is_usable(probes[i]); },
      [&](std::size_t i) {
        list_probe_problems(probes[i], problems, "probe " + std::to_string(i));
      });
}

/// @param is_asked  whether it is asked where a node is, by its number
template <class IsAsked>
void list_node_problems(Positions x, std::ostream& problems, const IsAsked& is_asked) {
  list_first(
      x.size(), "nodes", problems, [&](std::size_t n) { return is_asked(n) && !is_in_range(x[n]); },
      [&](std::size_t n) {
        problems << "node " << n << " is at (" << x[n].transpose()
                 << ") m; coordinates must be finite and below 1e75\n";
      });
}

}  // namespace plekton::geometry
