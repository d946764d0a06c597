// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/state_hash.hpp"

#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/sheet_facets.hpp"
#include "geometry/base/bit_hash.hpp"

namespace plekton::dynamics {
namespace {

using geometry::BitHash;

void add_nodes(const NodeState& state, BitHash& hash) {
  for (std::size_t i = 0; i < state.size(); ++i) {
    hash.add(state.position[i]);
    hash.add(state.velocity[i]);
    hash.add(state.angular_velocity[i]);
    const Quat& turn = state.orientation[i];
    hash.add(Vec3(turn.x(), turn.y(), turn.z()));
    hash.add(turn.w());
  }
}

void add_planes(const std::vector<contact::Plane>& planes, BitHash& hash) {
  for (const contact::Plane& plane : planes) {
    hash.add(plane.point);
    hash.add(plane.velocity);
    if (plane.form == contact::Plane::Form::flat) continue;
    hash.add(plane.radius);
    hash.add(plane.widening);
  }
}

/// Of bonds or facets of sheets.
template <class Elements>
void add_broken(const Elements& elements, BitHash& hash) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (elements.is_broken(i)) hash.add(std::uint64_t{i});
  }
}

}  // namespace

std::uint64_t state_hash(const Simulation& simulation) {
  BitHash hash;
  hash.add(static_cast<std::uint64_t>(simulation.steps()));
  hash.add(simulation.time());
  add_nodes(simulation.state(), hash);
  add_planes(simulation.planes(), hash);
  for (const std::size_t count : {simulation.state().size(), simulation.planes().size(),
                                  simulation.bonds().size(), simulation.sheet_facets().size()})
    hash.add(std::uint64_t{count});
  add_broken(simulation.bonds(), hash);
  add_broken(simulation.sheet_facets(), hash);
  return hash.value();
}

}  // namespace plekton::dynamics
