// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/bonds_along.hpp"

#include "dynamics/structure/beam_bonds.hpp"
#include "geometry/primitives/node_sets.hpp"

#include <algorithm>
#include <array>

namespace plekton::dynamics {
namespace {

using geometry::sorted;

struct Along {
  std::array<NodeId, 2> nodes;  ///< lower one first
  bool is_broken;
  std::size_t bond;

  friend auto operator<=>(const Along&, const Along&) = default;
};

}  // namespace

std::vector<std::size_t> bonds_along(std::span<const geometry::Cylinder> cylinders,
                                     const BeamBonds& bonds) {
  std::vector<Along> all(bonds.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = {sorted(bonds.nodes(i)), bonds.is_broken(i), i};
  std::sort(all.begin(), all.end());
  std::vector<std::size_t> along;
  along.reserve(cylinders.size());
  for (const geometry::Cylinder& cylinder : cylinders) {
    const auto nodes = sorted(cylinder.nodes);
    const auto first = std::lower_bound(all.begin(), all.end(), Along{nodes, false, 0});
    const bool is_there = first != all.end() && first->nodes == nodes;
    along.push_back(is_there ? first->bond : kNoBond);
  }
  return along;
}

}  // namespace plekton::dynamics
