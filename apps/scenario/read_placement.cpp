// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_placement.hpp"

namespace plekton::apps {

Placement read_placement(Section& section) {
  Placement placement;
  placement.scale = section.quantity("scale", {kNumber, kPositive}, placement.scale);
  placement.translation = section.vector("translate", {kLength}, placement.translation);
  if (auto rotate = section.optional_table("rotate")) {
    placement.axis = rotate->vector("axis", {kNumber}, placement.axis);
    placement.angle = rotate->quantity("angle", {kAngle});
    if (placement.axis.stableNorm() == 0.0)
      rotate->complain("axis", "got a vector of no length; expected a direction");
    placement.axis.stableNormalize();
    rotate->finish();
  }
  return placement;
}

}  // namespace plekton::apps
