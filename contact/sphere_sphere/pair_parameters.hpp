// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/lane_law.hpp"
#include "contact/law/material_pairs.hpp"
#include "contact/sphere_sphere/ball_blocks.hpp"
#include "contact/sphere_sphere/ball_kernel.hpp"
#include "contact/tracking/rekey.hpp"
#include "geometry/base/rows.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace plekton::contact {

/// The parameters of the law for each pair of a list. If all balls are of one material, with no
/// properties of its own, and the law asks for no more than radii, computing them anew takes less
/// time than reading them would; otherwise they are kept.
template <ContactLaw Law>
class PairParameters {
 public:
  using Parameters = typename Law::Parameters;

  /// Takes a new list. Allocates only for a longer one than ever before.
  /// @param keys    the pairs of which the blocks were made
  /// @param balls   must not change until the next list
  void assign(std::span<const geometry::IndexPair> keys, std::span<const Ball> balls,
              const BallBlocks& blocks, const MaterialPairs<Law>& materials);

  /// Of a pair of the list in a slot of the blocks.
  Parameters of_pair(const Ball& a, const Ball& b, std::size_t slot) const noexcept {
    if constexpr (CombinesRadii<Law>) {
      if (common_) return Law::combine(*common_, a.radius, *common_, b.radius);
    }
    return rows_[slot / kLanes].template at<Parameters>(slot % kLanes);
  }

  /// Of the pair in a lane of a row.
  Parameters of_lane(std::size_t row, std::size_t lane,
                     const BallMotionOf<double>& balls) const noexcept {
    if constexpr (CombinesRadii<Law>) {
      if (common_) return Law::combine(*common_, balls.radius_a, *common_, balls.radius_b);
    }
    return rows_[row].template at<Parameters>(lane);
  }

  /// Of W pairs from a lane of a row on.
  template <int W>
  PLEKTON_INLINE auto of_lanes(
      std::size_t row, std::size_t lane,
      const BallMotionOf<Pack<W>>& balls) const noexcept requires LaneLaw<Law> {
    if constexpr (CombinesRadii<Law>) {
      if (common_) return Law::combine(*common_, balls.radius_a, *common_, balls.radius_b);
    }
    return rows_[row].template load<typename Law::template ParametersOf<Pack<W>>>(lane);
  }

 private:
  static constexpr std::size_t kLanes = BallBlocks::kLanes;
  static_assert(std::is_trivially_copyable_v<Parameters> &&
                sizeof(Parameters) % sizeof(double) == 0);

  std::optional<Material> common_;  ///< of all balls of the list
  std::vector<geometry::RowsOf<Parameters, kLanes>> rows_;
};

template <ContactLaw Law>
void PairParameters<Law>::assign(std::span<const geometry::IndexPair> keys,
                                 std::span<const Ball> balls, const BallBlocks& blocks,
                                 const MaterialPairs<Law>& materials) {
  common_.reset();
  rows_.clear();
  if (keys.empty()) return;
  if constexpr (CombinesRadii<Law>) {
    const MaterialId first = balls.front().material;
    const std::span<const Ball> in_list = balls.first(blocks.ball_count());
    if (!materials.has_properties(first, first) &&
        std::all_of(in_list.begin(), in_list.end(),
                    [&](const Ball& ball) { return ball.material == first; })) {
      common_ = materials.at(first);
      return;
    }
  }
  make_room(rows_, blocks.row_count());
  rows_.resize(blocks.row_count());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Ball& a = balls[static_cast<std::size_t>(keys[i].a)];
    const Ball& b = balls[static_cast<std::size_t>(keys[i].b)];
    rows_[blocks.slot(i) / kLanes].set(blocks.slot(i) % kLanes, materials.combine(a, b));
  }
}

}  // namespace plekton::contact
