// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neighbours.hpp"

#include <algorithm>

namespace plekton::geometry {

Neighbours::Neighbours(std::span<const Sphere> spheres, const Surface& surface, double skin)
    : spheres_(spheres), surface_(&surface), skin_(skin) {}

bool Neighbours::update(Positions x, ThreadPool& pool) {
  if (!skin_.needs_rebuild(x, pool)) return false;
  rebuild(x);
  skin_.mark_built(x);
  ++rebuild_count_;
  return true;
}

void Neighbours::rebuild(Positions x) {
  const double margin = skin_.margin();
  boxes_.clear();
  for (const Sphere& sphere : spheres_) boxes_.push_back(box(sphere, x, margin));
  sphere_tree_.rebuild(boxes_);
  sphere_tree_.self_pairs(sphere_pairs_);
  drop_distant_pairs(x);

  boxes_.clear();
  for (std::size_t c = 0; c < surface_->cell_count(); ++c) {
    const CellId cell = id_at<CellId>(c);
    std::array<Vec3, 3> corners;
    std::size_t count = 0;
    for (const NodeId node : surface_->nodes_of(cell)) corners[count++] = x[index_of(node)];
    const double radius = surface_->radius(surface_->structure_of(cell));
    boxes_.push_back(bounding_box({corners.data(), count}, radius + margin));
  }
  cell_tree_.rebuild(boxes_);
  sphere_tree_.pairs_with(cell_tree_, sphere_cells_);
  group_by_structure();
}

void Neighbours::drop_distant_pairs(Positions x) {
  std::erase_if(sphere_pairs_, [&](const IndexPair& pair) {
    const Sphere& a = spheres_[static_cast<std::size_t>(pair.a)];
    const Sphere& b = spheres_[static_cast<std::size_t>(pair.b)];
    // Squares and sums are within a few eps of their values; the factor pays for all of it.
    const double range = (1.0 + 1e-12) * (a.radius + b.radius + skin());
    return (x[index_of(a.nodes[0])] - x[index_of(b.nodes[0])]).squaredNorm() > range * range;
  });
}

void Neighbours::group_by_structure() {
  const auto structure_of = [this](const IndexPair& pair) {
    return surface_->structure_of(CellId{pair.b});
  };
  std::sort(sphere_cells_.begin(), sphere_cells_.end(),
            [&](const IndexPair& p, const IndexPair& q) {
              if (p.a != q.a) return p.a < q.a;
              const StructureId sp = structure_of(p);
              const StructureId sq = structure_of(q);
              return sp != sq ? sp < sq : p.b < q.b;
            });
  sphere_structures_.clear();
  near_cells_.clear();
  cells_.clear();
  for (const IndexPair& pair : sphere_cells_) {
    const IndexPair key{pair.a, static_cast<std::int32_t>(structure_of(pair))};
    if (sphere_structures_.empty() || sphere_structures_.back() != key) {
      sphere_structures_.push_back(key);
      near_cells_.push_back({static_cast<std::uint32_t>(cells_.size()), 0});
    }
    cells_.push_back(CellId{pair.b});
    ++near_cells_.back().count;
  }
}

}  // namespace plekton::geometry
