// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/carry_over/carried_state.hpp"

#include "dynamics/carry_over/places.hpp"

#include <algorithm>
#include <type_traits>
#include <variant>

namespace plekton::dynamics {

namespace {

/// Puts the rows of an array over those of another one.
void put_over(const geometry::StateArray& before, const std::vector<std::int32_t>& places,
              geometry::StateArray& now) {
  std::visit(
      [&](const auto& from) {
        auto& to = std::get<std::remove_cvref_t<decltype(from)>>(now.numbers);
        const std::size_t columns = now.columns;
        for_each_kept(places, [&](std::size_t i, std::size_t k) {
          std::copy_n(from.data() + i * columns, columns, to.data() + k * columns);
        });
      },
      before.numbers);
}

}  // namespace

geometry::StateTree carried_state(const geometry::StateTree& before, geometry::StateTree now,
                                  std::span<const KeptRows> groups) {
  for (const auto& [name, array] : before.arrays) {
    const auto group =
        std::find_if(groups.begin(), groups.end(),
                     [&, key = &name](const KeptRows& g) { return key->starts_with(g.group); });
    if (group == groups.end())
      now.arrays[name] = array;
    else if (const auto to = now.arrays.find(name); to != now.arrays.end())
      put_over(array, group->places, to->second);
  }
  return now;
}

std::vector<std::int32_t> body_places(const Scene& before, const RigidNodes& now,
                                      const std::vector<std::int32_t>& nodes) {
  std::vector<std::int32_t> places;
  for (const RigidBody& body : before.rigid_bodies) {
    const std::int32_t node = nodes[index_of(body.node)];
    places.push_back(node < 0 ? -1 : now.body_at(NodeId{node}));
  }
  return places;
}

}  // namespace plekton::dynamics
