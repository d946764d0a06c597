// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_placement.hpp"

#include <numbers>

namespace plekton::apps {
namespace {

/// A place turned by more is that of a smaller angle, so that 90 without a unit is a slip.
constexpr double kFullTurn = 2.0 * std::numbers::pi * (1.0 + 1e-12);  // rad, and rounding
constexpr Range kWithinATurn{-kFullTurn, kFullTurn, true, true, " from -360 deg to 360 deg"};

}  // namespace

Placement read_placement(Section& section) {
  Placement placement;
  placement.scale = section.quantity("scale", {kNumber, kPositive}, placement.scale);
  placement.translation = section.vector("translate", {kLength}, placement.translation);
  if (auto rotate = section.optional_table("rotate")) {
    placement.axis = rotate->vector("axis", {kNumber}, placement.axis);
    placement.angle = rotate->quantity("angle", {kAngle, kWithinATurn});
    if (placement.axis.stableNorm() == 0.0)
      rotate->complain("axis", "got a vector of no length; expected a direction");
    placement.axis.stableNormalize();
    rotate->finish();
  }
  return placement;
}

}  // namespace plekton::apps
