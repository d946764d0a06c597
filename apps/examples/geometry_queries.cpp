// SPDX-License-Identifier: GPL-3.0-or-later
// Questions to a tent of two thick facets and a rope, with plekton::geometry alone.
#include <plekton/geometry/queries.hpp>

#include <iostream>
#include <vector>

using namespace plekton::geometry;

int main() {
  const std::vector<Vec3> x{{0, 0, 1}, {4, 0, 1}, {2, -2, 0}, {2, 2, 0}, {0, 0, 3}, {4, 1, 2}};
  Elements scene;
  scene.facets = {{{NodeId{0}, NodeId{1}, NodeId{2}}, 0.05},
                  {{NodeId{1}, NodeId{0}, NodeId{3}}, 0.05}};
  scene.cylinders = {{{NodeId{4}, NodeId{5}}, 0.02}};
  const Surface surface(scene.cylinders, scene.facets, x.size());
  const SurfaceQuery query(surface, x);

  // What is nearest to a ball, a cylinder and a facet that belong to no scene?
  const auto ball = query.nearest(Probe::ball(Vec3(2, 0.5, 1.2), 0.1));
  std::cout << "ball: " << ball->proximity.b.feature << " of cell " << static_cast<int>(ball->cell)
            << ", gap " << ball->proximity.gap << " m\n";
  const auto bar = query.nearest(Probe::cylinder(Vec3(1, -1, 1.5), Vec3(3, 1, 1.5), 0.1));
  std::cout << "cylinder: " << bar->proximity.a.feature << " of it, " << bar->proximity.b.feature
            << " of the scene, gap " << bar->proximity.gap << " m\n";
  const auto flap =
      query.nearest(Probe::facet({Vec3(1, 0, 0.5), Vec3(3, 0, 0.5), Vec3(2, 0, 2)}, 0.05));
  const bool crosses = flap->proximity.relation == Relation::touching_or_crossing;
  std::cout << "facet: " << (crosses ? "goes through" : "is apart from") << " cell "
            << static_cast<int>(flap->cell) << ", gap " << flap->proximity.gap << " m\n";

  // Every pair of the scene that is nearer than 1.5 m; the facets are neighbours, so no pair.
  ProximityQuery pairs(scene, x.size(), PairChoice{1.5});
  for (const Proximity& p : pairs.find(x))
    std::cout << "pair: " << p.a.feature << " - " << p.b.feature << ", gap " << p.gap << " m\n";

  // Rain: many rays at once, on two threads.
  std::vector<Ray> rays;
  for (int i = 0; i < 9; ++i) rays.push_back({Vec3(0.25 + 0.5 * i, 0.5, 5), Vec3(0, 0, -1)});
  ThreadPool pool(2);
  int wet = 0;
  for (const auto& hit : query.first_hits(rays, pool)) {
    if (!hit) continue;
    ++wet;
    std::cout << "drop: lands at height " << hit->point.z() << " m on " << hit->core.feature
              << '\n';
  }

  // Two surfaces.
  const std::vector<Facet> floor_facets{{{NodeId{0}, NodeId{1}, NodeId{2}}, 0.1}};
  const std::vector<Vec3> floor_x{{-9, -9, -1}, {9, -9, -1}, {0, 20, -1}};
  const Surface floor({}, floor_facets, floor_x.size());
  const auto height = query.nearest(SurfaceQuery(floor, floor_x));
  std::cout << "the tent hangs " << height->proximity.gap << " m above the floor, nearest at "
            << height->proximity.a.feature << '\n';

  return wet > 0 && crosses && height->proximity.gap > 0.0 ? 0 : 1;
}
