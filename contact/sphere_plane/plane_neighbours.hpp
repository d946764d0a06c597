// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/bodies.hpp"
#include "geometry/base/state_archive.hpp"
#include "geometry/neighbor/broad_phase.hpp"

#include <span>
#include <vector>

namespace plekton::contact {

/// Which spheres may touch which planes.
///
/// Whoever owns the list lets it expire before a sphere has moved by more than half the skin since
/// the last time; the list itself sees to the planes, and is made anew when one of them has moved
/// by half the skin. Then the spheres stand anywhere within half the skin of where they were at the
/// last expiry, and may still move to anywhere within it: by the whole skin. So everything nearer
/// than one and a half skins is listed.
class PlaneNeighbours {
 public:
  /// @param skin   m, see expire()
  /// @param reach  m, at which distance of the surfaces a pair is wanted already
  explicit PlaneNeighbours(double skin, double reach = 0.0) : skin_(skin), reach_(reach) {}

  /// Has the list made anew at the next update.
  /// @param skin  m, of which spheres move by no more than half before the next expiry
  void expire(double skin) noexcept {
    skin_ = skin;
    expired_ = true;
  }

  /// Whether it has expired or a plane has moved by more than half the skin.
  bool is_due(std::span<const Plane> planes) const noexcept;
  /// Makes the list anew if it is due. @returns whether it was
  bool update(std::span<const SphereBody> spheres, std::span<const Plane> planes, Positions x);

  /// @throws geometry::StateMismatch if the state has a pair of a sphere or plane that is none here
  void exchange(const geometry::StateArchive& archive, std::size_t sphere_count,
                std::size_t plane_count);

  /// Pairs (sphere, plane), sorted.
  std::span<const geometry::IndexPair> pairs() const noexcept { return pairs_; }

 private:
  double skin_;
  double reach_;
  bool expired_ = true;
  std::vector<Plane> built_for_;
  std::vector<geometry::IndexPair> pairs_;
};

}  // namespace plekton::contact
