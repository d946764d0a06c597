// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/grains/container.hpp"
#include "apps/grains/free_space.hpp"
#include "apps/scenario/scenario.hpp"

#include <functional>
#include <span>
#include <stdexcept>
#include <vector>

namespace plekton::apps {

/// Spheres to be made.
struct PlacedGrain {
  Vec3 centre;    ///< m
  double radius;  ///< m
};

/// What must be kept clear of.
struct Surroundings {
  std::span<const Obstacle> obstacles;
  std::span<const contact::Plane> planes;
  const Container* container = nullptr;  ///< that is to hold the grains; nothing: box or cylinder
  double young_modulus = 0.0;            ///< Pa, of the grains, for a packing to a stress
  std::span<const double> plane_moduli = {};  ///< by plane, over that of the grains; empty: all 1
};

/// Grains that do not fit the space they are given. The message names both volumes, how far it
/// went, and ways out.
struct DoesNotFit : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Draws grains from the size curve and places them in their space, the largest first; without
/// overlap, unless they are packed to a stress.
///
/// Placed at random, each is tried at random positions, with a bounded number of trials; for equal
/// grains that ends at about 0.38 of a box that is far larger than they are. On a lattice,
/// face-centred cubic with the spacing of the largest diameter, each is moved by a random part of
/// the room it has there; that goes up to 0.74 less what the edges of the box take. Packed, they are
/// placed at random a good deal smaller, then grow together (sphere_packing.hpp): to their sizes, or
/// until they press on each other as asked for, with sizes that may be some percent off. None of
/// these stands in for another. The result depends on the settings and the surroundings alone, not on the
/// standard library.
/// @param tell  called now and then with the part of the grains that are placed, if given
/// @throws DoesNotFit  with how many found room
std::vector<PlacedGrain> generate_grains(const GrainSettings& settings,
                                         const Surroundings& surroundings,
                                         const std::function<void(double)>& tell = {});

}  // namespace plekton::apps
