// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/contacts_then.hpp"

#include "geometry/base/state_archive.hpp"

#include <vector>

namespace plekton::dynamics {

void contacts_then(contact::Contacts& contacts, const Scene& scene, double ago,
                   geometry::ThreadPool& pool, geometry::FunctionRef<void()> look) {
  geometry::StateTree kept;
  contacts.exchange(geometry::StateArchive::writer(kept), scene.planes, pool);
  NodeState state = scene.state;
  state.position = positions_before(state, ago);
  std::vector<contact::Plane> planes = scene.planes;
  for (contact::Plane& plane : planes) {
    plane.point -= ago * plane.velocity;
    plane.radius -= ago * plane.widening;
  }
  NodeForces forces(state.size());
  const auto put_back = [&] {
    contacts.exchange(geometry::StateArchive::reader(kept), scene.planes, pool);
  };
  try {
    contacts.advance(state.motion(), planes, 0.0, pool, forces);
    look();
  } catch (...) {
    put_back();
    throw;
  }
  put_back();
}

}  // namespace plekton::dynamics
