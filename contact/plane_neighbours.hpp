// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/bodies.hpp"
#include "geometry/broad_phase.hpp"

#include <span>
#include <vector>

namespace plekton::contact {

/// Which balls may touch which planes: those nearer than a skin (m) when the list was made. Whoever owns it lets the
/// list expire before a ball has moved by more than half the skin; it sees to the planes itself.
class PlaneNeighbours {
 public:
  explicit PlaneNeighbours(double skin) : skin_(skin) {}

  /// Has the list made anew at the next update.
  void expire() noexcept { expired_ = true; }

  /// Makes the list anew if it has expired or a plane has moved by more than half the skin. @returns whether it did
  bool update(std::span<const Ball> balls, std::span<const Plane> planes, Positions x);

  /// Pairs (ball, plane), sorted.
  std::span<const geometry::IndexPair> pairs() const noexcept { return pairs_; }

 private:
  double skin_;
  bool expired_ = true;
  std::vector<Plane> built_for_;
  std::vector<geometry::IndexPair> pairs_;
};

}  // namespace plekton::contact
