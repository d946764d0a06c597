// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/bodies.hpp"
#include "contact/contact_law.hpp"

#include <utility>
#include <vector>

namespace plekton::contact {

/// The contact materials of a scene, and what their pairs do.
template <ContactLaw Law>
class MaterialPairs {
 public:
  using Parameters = typename Law::Parameters;

  explicit MaterialPairs(std::vector<Material> materials = {}) : materials_(std::move(materials)) {}

  /// Parameters of a pair of bodies of these materials and radii (m).
  Parameters combine(MaterialId a, double radius_a, MaterialId b, double radius_b) const {
    return Law::combine(at(a), radius_a, at(b), radius_b);
  }
  Parameters combine(const Ball& a, const Ball& b) const {
    return combine(a.material, a.radius, b.material, b.radius);
  }

  const Material& at(MaterialId id) const { return materials_[static_cast<std::size_t>(id)]; }

 private:
  std::vector<Material> materials_;
};

}  // namespace plekton::contact
