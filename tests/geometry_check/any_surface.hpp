// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/contact_surfaces.hpp"

namespace plekton::geometry_check {

/// One of the small surfaces of the tests: closed, open, non-manifold, mixed, nearly flat; on a
/// lattice, turned, or anywhere.
inline test::Complex any_surface(test::Random& random) {
  const test::Complex surface = [&]() -> test::Complex {
    switch (random.integer(0, 9)) {
      case 0:
        return test::cube(random.integer(1, 3));
      case 1:
        return test::ball(random.integer(0, 1));
      case 2:
        return test::sheet(random.integer(1, 4));
      case 3:
        return test::net(random.integer(1, 3));
      case 4:
        return test::book({0, 90, 180});
      case 5:
        return test::bow_tie();
      case 6:
        return test::roughened(test::sheet(3), 1.0, random.signed_power(-16.0, -1.0), random);
      default:
        return test::random_complex(random, random.coin());
    }
  }();
  return random.coin() ? surface : test::rotated(surface, random.rotation());
}

}  // namespace plekton::geometry_check
