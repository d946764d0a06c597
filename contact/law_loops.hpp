// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/sphere_sphere/sphere_range.hpp"
#include "contact/sphere_surface/single_feature_batch.hpp"

namespace plekton::contact {

/// The loops over many contacts of one law. Compiled in the library for the laws that come with it
/// (shipped_laws.hpp), and by its user for a law of one's own.
template <ContactLaw Law>
struct LawLoops {
  // Defined below: what is defined here would be compiled wherever it is used.
  static void spheres(const SphereRange& range, SphereWork& work);
  static bool touching(SphereBatch& batch, std::size_t count, double dt) requires LaneLaw<Law>;
  static void on_facets(SingleFeatureBatch& batch, const Motion& motion,
                        double dt) requires LaneLaw<Law>;

  static constexpr decltype(AnyLaw::Functions::advance_batch) batch() noexcept {
    if constexpr (LaneLaw<Law>) return touching;
    return nullptr;
  }
  static constexpr decltype(AnyLaw::Functions::advance_single_feature) facets() noexcept {
    if constexpr (LaneLaw<Law>) return on_facets;
    return nullptr;
  }
};

template <ContactLaw Law>
void LawLoops<Law>::spheres(const SphereRange& range, SphereWork& work) {
  advance_spheres<Law>(range, work);
}

template <ContactLaw Law>
bool LawLoops<Law>::touching(SphereBatch& batch, std::size_t count,
                             double dt) requires LaneLaw<Law> {
  return advance_batch<Law>(batch, count, dt);
}

template <ContactLaw Law>
void LawLoops<Law>::on_facets(SingleFeatureBatch& batch, const Motion& motion,
                              double dt) requires LaneLaw<Law> {
  advance_single_feature<Law>(batch, motion, dt);
}

}  // namespace plekton::contact
