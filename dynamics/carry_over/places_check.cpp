// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/carry_over/places_check.hpp"

#include "geometry/base/problems.hpp"
#include "geometry/base/state_tree.hpp"

#include <cstdint>
#include <ostream>
#include <sstream>
#include <string_view>
#include <vector>

namespace plekton::dynamics {

namespace {

/// @param what   as in "nodes"
/// @param there  how many there were
/// @param here   how many there are now
void list_problems(std::string_view what, const std::vector<std::int32_t>& places,
                   std::size_t there, std::size_t here, std::ostream& problems) {
  if (places.size() != there) {
    problems << "go_on_from: places." << what << " has " << places.size() << " entries; expected "
             << there << ", a place among the " << what << " of now for each of before, or -1\n";
    return;
  }
  std::vector<bool> is_taken(here, false);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::int32_t place = places[i];
    if (place == -1) continue;
    const bool is_none = place < 0 || static_cast<std::size_t>(place) >= here;
    if (is_none)
      problems << "go_on_from: places." << what << '[' << i << "] is " << place << "; there are "
               << here << ' ' << what << " now, counted from 0, and -1 is none of them\n";
    else if (is_taken[static_cast<std::size_t>(place)])
      problems << "go_on_from: places." << what << '[' << i << "] is " << place
               << ", as of one before; no two are the same of now\n";
    if (!is_none) is_taken[static_cast<std::size_t>(place)] = true;
  }
}

}  // namespace

void require_places(const Scene& before, const Scene& now, const SceneChange& change) {
  std::ostringstream problems;
  const contact::BodyPlaces& places = change.places;
  list_problems("nodes", places.nodes, before.state.size(), now.state.size(), problems);
  list_problems("spheres", places.spheres, before.elements.spheres.size(),
                now.elements.spheres.size(), problems);
  list_problems("planes", places.planes, before.planes.size(), now.planes.size(), problems);
  if (!change.moved_planes.empty() && change.moved_planes.size() != now.planes.size())
    problems << "go_on_from: moved_planes has " << change.moved_planes.size()
             << " entries; expected " << now.planes.size()
             << ", one for each plane of now, or none\n";
  geometry::throw_if_any(problems);
}

void require_same_structures(const geometry::Surface& before,
                             const std::vector<std::int32_t>& places) {
  for (std::size_t node = 0; node < before.node_count(); ++node) {
    if (before.structure_of(geometry::id_at<NodeId>(node)) != geometry::StructureId{-1} &&
        places[node] != static_cast<std::int32_t>(node))
      throw geometry::StateMismatch("the nodes of structures have other ids than before");
  }
}

}  // namespace plekton::dynamics
