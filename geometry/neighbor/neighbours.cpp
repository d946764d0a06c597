// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neighbor/neighbours.hpp"

#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace plekton::geometry {
namespace {

/// Trees follow moving boxes well, and being made anew costs several times as much as following.
constexpr std::int64_t kListsPerTree = 16;

/// What the lists cost, in steps of a dense packing of spheres, and by what share of a step more it
/// gets when the skin grows by a radius (measured: tests/benchmarks/README.md).
constexpr double kCostOfLists = 9.0;
constexpr double kCostOfSkin = 0.7;

template <class Id>
std::size_t kept_of(const SurfaceChange& change, std::size_t count) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (change.now(Feature(id_at<Id>(i)))) ++kept;
  return kept;
}

bool brings_elements(const SurfaceChange& change) {
  const Surface& before = change.before();
  return kept_of<FaceId>(change, before.face_count()) < change.after().face_count() ||
         kept_of<EdgeId>(change, before.edge_count()) < change.after().edge_count();
}

}  // namespace

Neighbours::Neighbours(std::span<const Sphere> spheres, const Surface& surface, double skin,
                       double reach)
    : spheres_(spheres), surface_(&surface), skin_(skin), reach_(reach) {}

bool Neighbours::is_due(Positions x, ThreadPool& pool, double way, const KnownNodes* known) {
  // Where all is at rest a list may last for longer than can be counted; that many are as good.
  if (steps_of_list_ < std::numeric_limits<int>::max()) ++steps_of_list_;
  return skin_.may_need_rebuild(way) && skin_.needs_rebuild(x, pool, known);
}

void Neighbours::make(Positions x, ThreadPool& pool) {
  if (usual_radius_ > 0.0 && rebuild_count_ > 0) choose_skin();
  // Without spheres the lists stay empty; that they are due is news for lists of other bodies.
  if (!spheres_.empty()) rebuild(x, pool);
  skin_.mark_built(x);
  ++rebuild_count_;
  steps_of_list_ = 0;
}

void Neighbours::exchange(const StateArchive& archive, ThreadPool& pool) {
  skin_.exchange(archive);
  archive("steps_of_list", steps_of_list_);
  archive.require(steps_of_list_ >= 0, "steps_of_list");
  archive("rebuild_count", rebuild_count_);
  if (!archive.is_reading()) return;
  if (list_positions().size() != surface_->node_count())
    throw StateMismatch("the state has another number of nodes than there are here");
  if (!spheres_.empty()) rebuild(list_positions(), pool);
}

/// A list of skin s lasts s / w steps, where w is twice the way of the fastest in a step. The cost
/// kCostOfLists w / s + kCostOfSkin s / radius is least at s^2 = kCostOfLists / kCostOfSkin * w *
/// radius.
void Neighbours::choose_skin() {
  const double way = skin() / steps_of_list_;
  const double best = std::sqrt(kCostOfLists / kCostOfSkin * way * usual_radius_);
  const double near = std::clamp(best, 0.7 * skin(), 1.4 * skin());
  skin_.set(std::clamp(near, 0.02 * usual_radius_, 0.8 * usual_radius_));
}

template <class Boxes>
void Neighbours::fit(BroadPhase& tree, const Boxes& boxes) {
  if (tree.size() == boxes.size() && rebuild_count_ % kListsPerTree != 0) {
    tree.refit(boxes);
  } else {
    tree.rebuild(boxes);
  }
}

void Neighbours::rebuild(Positions x, ThreadPool& pool) {
  const double margin = skin_.margin() + 0.5 * reach_;
  fit(sphere_tree_, SphereBoxes(spheres_, x, margin));
  const auto is_near = [&](const IndexPair& pair) { return may_touch(pair, x); };
  sphere_tree_.self_pairs(sphere_pairs_, pool, std::cref(is_near), share_);

  boxes_.clear();
  for (std::size_t c = 0; c < surface_->cell_count(); ++c) {
    const CellId cell = id_at<CellId>(c);
    std::array<Vec3, 3> corners;
    std::size_t count = 0;
    for (const NodeId node : surface_->nodes_of(cell)) corners[count++] = x[index_of(node)];
    const double radius = surface_->radius(surface_->structure_of(cell));
    boxes_.push_back(bounding_box({corners.data(), count}, radius + margin));
  }
  fit(cell_tree_, std::span<const Box>(boxes_));
  sphere_tree_.pairs_with(cell_tree_, sphere_cells_);
  if (!groups_.empty()) {
    std::erase_if(sphere_cells_, [&](const IndexPair& pair) {
      return groups_.exclude(spheres_[static_cast<std::size_t>(pair.a)].nodes,
                             surface_->nodes_of(CellId{pair.b}));
    });
  }
  group_by_structure();
}

bool Neighbours::may_touch(const IndexPair& pair, Positions x) const noexcept {
  const Sphere& a = spheres_[static_cast<std::size_t>(pair.a)];
  const Sphere& b = spheres_[static_cast<std::size_t>(pair.b)];
  // Squares and sums are within a few eps of their values; the factor pays for all of it.
  const double range = (1.0 + 1e-12) * (a.radius + b.radius + reach_ + skin());
  if (groups_.exclude(a.nodes, b.nodes)) return false;
  return !((x[index_of(a.nodes[0])] - x[index_of(b.nodes[0])]).squaredNorm() > range * range);
}

/// A side lies in the box of its facet.
/// Where cells come that are in no list, it is made anew with the next step.
void Neighbours::follow(const SurfaceChange& change) {
  surface_ = &change.after();
  // Of a facet that is left out with a group the sides may stay, and belong to none.
  if (brings_elements(change) || !groups_.empty()) skin_.expire();
  std::vector<IndexPair> left;
  for (const IndexPair& pair : sphere_cells_) {
    for (const CellId cell : change.left_of(CellId{pair.b}))
      left.push_back({pair.a, static_cast<std::int32_t>(cell)});
  }
  std::sort(left.begin(), left.end());
  left.erase(std::unique(left.begin(), left.end()), left.end());
  sphere_cells_.swap(left);
  cell_tree_ = BroadPhase();
  group_by_structure();
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
