// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "contact/surface_surface/pair_terms.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace plekton::contact {

/// How structures push each other apart as a function of places alone, beside those of the last
/// step: for differences of forces.
class StructureProbe {
 public:
  /// @param terms, springs  of the last step; the springs must last as long as this is asked
  void begin(const structure::PairTerms& terms, std::span<const structure::NormalSpring> springs) {
    terms_ = terms;
    springs_ = springs;
    has_begun_ = true;
  }
  /// Nothing touches. The room for terms is kept.
  void clear() noexcept { has_begun_ = false; }

  /// Whether anything touched in the last step.
  bool touches() const noexcept { return has_begun_ && !terms_->acting().empty(); }

  /// Calls visit(nodes of one side, nodes of the other) for all that touch.
  template <class Visit>
  void for_each_pair(Visit&& visit) const {
    for (const std::uint32_t acting : terms_->acting())
      visit((*terms_)[acting].a, (*terms_)[acting].b);
  }

  /// Adds the elastic forces (N) of all terms with the nodes at x, also where a patch pushes with
  /// one of them (PatchEnergy).
  /// @param moved  m, no node is further from where it was at the last call, or in the last step
  void add_forces(Positions x, double moved, NodeForces& forces);

 private:
  bool has_begun_ = false;
  std::optional<structure::PairTerms> terms_;
  std::span<const structure::NormalSpring> springs_;
  geometry::ThreadPool pool_{1};
};

}  // namespace plekton::contact
