// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/bodies.hpp"
#include "geometry/neighbor/neighbours.hpp"
#include "geometry/primitives/elements.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::apps {

/// m, around all elements and around the feet of that on the planes, grown on every side by its own
/// longest side; empty without elements.
geometry::Box roaming_box(const geometry::Elements& elements, geometry::Positions x,
                          std::span<const contact::Plane> planes);

/// Which grains a simulation has lost. A grain is lost for good
/// - when its centre has passed through a facet of a membrane, which no contact force should let
///   happen, or
/// - when its centre has left roaming_box() and nothing is left that could stop it: no plane lies
///   below it along gravity (without gravity: ahead of it), and it is not near the membranes and
///   rigid bodies as they are now, in the box around them, grown likewise.
///
/// So a grain that rolls away on a floor without end, flies above one, or lies in a bag that is
/// carried off, is not lost. A container stops what is inside, a cylinder nothing that falls along
/// its axis. The second kind depends on the state of now alone.
///
/// Between two looks a grain and the corners of a facet are taken to move straight and evenly. The
/// centre passes through the facet if it changes sides of its plane and, at the moment it lies in
/// that plane, lies in the triangle. Going around the rim is therefore no passing. Only pairs that
/// the broad phase lists are asked: a centre in the plane of a facet touches it.
class LostGrains {
 public:
  /// What moves grains, and stops them.
  struct Surroundings {
    std::span<const contact::Plane> planes;
    geometry::Vec3 gravity = geometry::Vec3::Zero();  ///< m/s²
    std::span<const geometry::Vec3> velocities;       ///< m/s, of all nodes
  };

  /// @param x  m, at the start. The elements must outlive this.
  LostGrains(const geometry::Elements& elements, geometry::Positions x,
             std::span<const contact::Plane> planes);

  /// Looks at what happened since the last look. Call it so often that no grain moves by its radius
  /// in between, see steps_to_next_look.
  void look(geometry::Positions x, const geometry::Neighbours& neighbours,
            const Surroundings& surroundings);

  /// Time steps, from 1 to kMostSteps, within which no grain gets nearer to a facet than by half
  /// the radius of the smallest grain, at the speeds of now. What moves further in a single step
  /// can pass unseen.
  /// @param velocities  m/s, of all nodes
  /// @param time_step   s
  std::int64_t steps_to_next_look(std::span<const geometry::Vec3> velocities,
                                  double time_step) const;

  static constexpr std::int64_t kMostSteps = 16;  ///< so that a look costs little among the steps

  /// What it knows from the last look. @throws geometry::StateMismatch
  void exchange(const geometry::StateArchive& archive);

  std::size_t through_membranes() const noexcept { return through_; }
  std::size_t out_of_bounds() const noexcept { return out_; }
  /// Grains that are either, also those that a stage has taken out since.
  std::size_t total() const noexcept;

 private:
  void look_for_passing(geometry::Positions x, const geometry::Neighbours& neighbours);
  void look_for_leaving(geometry::Positions x, const Surroundings& surroundings);

  const geometry::Elements& elements_;
  geometry::Box bounds_;
  double smallest_radius_;              // m, of the grains; infinite if there are none
  std::vector<geometry::Vec3> before_;  // m, all nodes at the last look
  std::vector<bool> is_through_;
  std::vector<bool> is_out_;
  std::size_t through_ = 0;
  std::size_t out_ = 0;
  std::size_t removed_ = 0;  // lost grains that stages have taken out
};

/// How many lost grains stages have taken out, of what LostGrains::exchange() exchanges. A state
/// has the number only where there are some.
void exchange_removed(const geometry::StateArchive& archive, std::size_t& removed);

/// Whether a point passes through a triangle while both move straight and evenly.
bool passes_through(const geometry::Vec3& point0, const geometry::Vec3& point1,
                    const std::array<geometry::Vec3, 3>& triangle0,
                    const std::array<geometry::Vec3, 3>& triangle1) noexcept;

}  // namespace plekton::apps
