// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/facets_beside.hpp"

#include "geometry/closest/face_foot.hpp"

namespace plekton::contact {
namespace {

/// Sides of two facets.
struct SharedSide {
  std::size_t of_first = 3;  ///< 3: they share none
  std::size_t of_second = 3;
};

SharedSide shared_side(const geometry::Surface& surface, geometry::FaceId first,
                       geometry::FaceId second) noexcept {
  const auto& edges = surface.edges_of(first);
  const auto& others = surface.edges_of(second);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (edges[k] == others[j]) return {k, j};
    }
  }
  return {};
}

}  // namespace

bool are_beside(const geometry::Surface& surface, geometry::FaceId face,
                std::span<const geometry::CellId> cells, const Vec3& centre, double range,
                Positions x, SideFlags& sides) noexcept {
  bool has_face = false;
  for (const geometry::CellId cell : cells) {
    if (index_of(cell) >= surface.face_count()) return false;
    const auto other = geometry::id_at<geometry::FaceId>(index_of(cell));
    if (other == face) {
      has_face = true;
      continue;
    }
    const SharedSide shared = shared_side(surface, face, other);
    if (shared.of_first == 3) return false;
    const auto& nodes = surface.nodes_of(other);
    const auto corner = [&](std::size_t k) {
      return x[index_of(nodes[(shared.of_second + k) % 3])];
    };
    if (!geometry::is_across_first_side(centre, {corner(0), corner(1), corner(2)}, range))
      return false;
    sides[shared.of_first] = 1.0;
  }
  return has_face;
}

}  // namespace plekton::contact
