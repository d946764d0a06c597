// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/sphere_sphere/ball_stretch.hpp"
#include "contact/sphere_surface/lone_batch.hpp"

namespace plekton::contact {

/// The loops over many contacts of one law. Compiled in the library for the laws that come with it
/// (shipped_laws.hpp), and by its user for a law of one's own.
template <ContactLaw Law>
struct LawLoops {
  static void balls(const BallStretch& stretch, BallWork& work) {
    advance_balls<Law>(stretch, work);
  }
  static bool touching(BallBatch& batch, std::size_t count, double dt) requires LaneLaw<Law> {
    return advance_batch<Law>(batch, count, dt);
  }
  static void on_facets(LoneBatch& batch, const Motion& motion, double dt) requires LaneLaw<Law> {
    advance_lone<Law>(batch, motion, dt);
  }

  static constexpr decltype(AnyLaw::Functions::advance_batch) batch() noexcept {
    if constexpr (LaneLaw<Law>) return touching;
    return nullptr;
  }
  static constexpr decltype(AnyLaw::Functions::advance_lone) lone() noexcept {
    if constexpr (LaneLaw<Law>) return on_facets;
    return nullptr;
  }
};

}  // namespace plekton::contact
