// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/sphere_surface/patch_contacts.hpp"
#include "contact/tracking/force_records.hpp"
#include "geometry/base/function_ref.hpp"
#include "geometry/base/state_archive.hpp"
#include "geometry/neighbor/broad_phase.hpp"
#include "geometry/primitives/elements.hpp"

#include <cstdint>
#include <vector>

namespace plekton::contact {

/// Contacts of spheres with a surface as they are in a state: in the order of their pairs,
/// whichever thread had them.
struct SurfaceContactsState {
  struct Contact {
    geometry::IndexPair pair;  ///< sphere and structure
    PatchContact contact;      ///< but for where its minima are
    std::vector<geometry::Feature> minima;
  };
  /// What a term of a contact did in the last step.
  struct Force {
    std::uint32_t contact;  ///< place in contacts
    SurfaceForce record;    ///< of a state that was read without its sphere and its pair
  };

  double largest_overlap_ratio = 0.0;
  std::vector<Contact> contacts;
  std::vector<Force> forces;

  /// @param surface  that the contacts are on
  /// @param law_of   (sphere and structure) -> law of their contacts; asked for one contact after
  ///                 the other
  using LawOf = geometry::FunctionRef<const AnyLaw::Functions*(const geometry::IndexPair&)>;
  void exchange(const geometry::StateArchive& archive, const geometry::Surface& surface,
                LawOf law_of);
};

}  // namespace plekton::contact
