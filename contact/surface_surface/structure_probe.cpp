// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/structure_probe.hpp"

namespace plekton::contact {

void StructureProbe::add_forces(Positions x, double moved, NodeForces& forces) {
  terms_->evaluate(springs_, {x, {}, {}, moved}, pool_);
  for (const std::uint32_t acting : terms_->acting()) {
    const structure::PairTerm& term = (*terms_)[acting];
    const auto add = [&](const structure::PairForces& by) {
      for (std::size_t k = 0; k < term.a.count; ++k)
        forces.force[index_of(term.a.ids[k])] += by.on_a[k];
      for (std::size_t k = 0; k < term.b.count; ++k)
        forces.force[index_of(term.b.ids[k])] += by.on_b[k];
    };
    add(term.forces);
    if (const structure::PairForces* const ends = terms_->at_ends(acting)) add(*ends);
  }
}

}  // namespace plekton::contact
