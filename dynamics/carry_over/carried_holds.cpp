// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/carry_over/carried_holds.hpp"

#include "dynamics/carry_over/places.hpp"
#include "dynamics/model/scene_figures.hpp"

#include <utility>

namespace plekton::dynamics {

namespace {

/// What of each node is held in a scene.
struct Holds {
  std::vector<Held> all;
  std::vector<Held> prescribed;  ///< by loads, which say how it moves
};

Holds holds_of(const Scene& scene) {
  Scene loaded;
  loaded.properties.held.assign(scene.properties.size(), Held::nothing);
  loaded.loads = scene.loads;
  loaded.rigid_bodies = scene.rigid_bodies;
  return {scene.properties.held, held_as_prescribed(std::move(loaded)).properties.held};
}

/// Motions that are held from now on, and those whose load has ended and that are held without it.
Held stopped(std::size_t then, const Holds& before, std::size_t now, const Holds& holds) {
  constexpr auto kBits = [](Held held) { return static_cast<unsigned>(held); };
  const unsigned own_before = kBits(before.all[then]) & ~kBits(before.prescribed[then]);
  const unsigned own = kBits(holds.all[now]) & ~kBits(holds.prescribed[now]);
  return static_cast<Held>((kBits(holds.all[now]) & ~kBits(before.all[then])) |
                           (own & ~own_before));
}

void stop(Held motions, Vec3& velocity, Vec3& spin) {
  for (int axis = 0; axis < 3; ++axis) {
    if (holds_along(motions, axis)) velocity[axis] = 0.0;
    if (holds_about(motions, axis)) spin[axis] = 0.0;
  }
}

}  // namespace

void follow_holds(const Scene& before, const std::vector<std::int32_t>& places, Scene& now,
                  RigidBodies& bodies) {
  const Holds holds_before = holds_of(before);
  const Holds holds = holds_of(now);
  for_each_kept(places, [&](std::size_t then, std::size_t here) {
    const Held stopping = stopped(then, holds_before, here, holds);
    const Held was = holds_before.all[then], is = holds.all[here];
    if (was == is && stopping == Held::nothing) return;
    stop(stopping, now.state.velocity[here], now.state.angular_velocity[here]);
    const auto node = geometry::id_at<NodeId>(here);
    const bool turns_on = (was & Held::rotation) == (is & Held::rotation) &&
                          (stopping & Held::rotation) == Held::nothing;
    if (turns_on)
      bodies.go_on_turning_from(node, now.state, now.properties);
    else
      bodies.start_from(node, now.state, now.properties);
  });
}

void add_late_starts(const Scene& before, const std::vector<std::int32_t>& places, const Scene& now,
                     LateStarts& starts) {
  std::vector<Held> held_before(now.state.size(), Held::everything);
  for_each_kept(places, [&](std::size_t then, std::size_t here) {
    if (before.is_there(geometry::id_at<NodeId>(then)))
      held_before[here] = before.properties.held[then];
  });
  for (std::size_t i = 0; i < now.state.size(); ++i) {
    const auto node = geometry::id_at<NodeId>(i);
    const auto was = static_cast<unsigned>(held_before[i] & Held::everything);
    const auto is = static_cast<unsigned>(now.properties.held[i]);
    if (now.is_there(node)) starts.add(node, static_cast<Held>(was & ~is));
  }
}

}  // namespace plekton::dynamics
