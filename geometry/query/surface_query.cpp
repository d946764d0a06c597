// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/surface_query.hpp"

#include "geometry/problems.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plekton::geometry {
namespace {

constexpr double kLargestCoordinate = 1e75;  // m

Box box_of_probe(const Probe& probe, double margin) {
  return bounding_box(probe.core.corners(), probe.radius + margin);
}

/// @throws std::invalid_argument for numbers that no distance can be taken of
void check_probe(const Probe& probe) {
  std::ostringstream problems;
  if (probe.core.count < 1 || probe.core.count > 3) {
    problems << "the probe has " << probe.core.count << " corners; expected 1, 2 or 3\n";
    throw_if_any(problems);
  }
  if (!(probe.radius >= 0.0 && probe.radius < kLargestCoordinate))
    problems << "the probe has radius " << probe.radius << " m; expected from 0 to below 1e75\n";
  for (const Vec3& corner : probe.core.corners()) {
    if (!(corner.cwiseAbs().maxCoeff() < kLargestCoordinate && corner.allFinite())) {
      problems << "the probe has a corner at (" << corner.transpose()
               << ") m; coordinates must be finite and below 1e75\n";
    }
  }
  throw_if_any(problems);
}

/// m, 0 if they overlap: no cell in one is nearer to one in the other.
double distance(const Box& a, const Box& b) {
  const Vec3 apart = (a.lower - b.upper).cwiseMax(b.lower - a.upper).cwiseMax(Vec3::Zero());
  return apart.norm();
}

/// The other way round.
Proximity reversed(const Proximity& p) {
  return {p.b, p.a, -p.normal, p.gap, p.arm_b, p.arm_a, p.relation};
}

}  // namespace

SurfaceQuery::SurfaceQuery(const Surface& surface, Positions x) : surface_(&surface) {
  check(x);
  x_.assign(x.begin(), x.end());
  make_boxes();
  tree_.rebuild(boxes_);
}

void SurfaceQuery::move(Positions x) {
  check(x);
  x_.assign(x.begin(), x.end());
  make_boxes();
  tree_.refit(boxes_);
}

void SurfaceQuery::check(Positions x) const {
  std::ostringstream problems;
  if (x.size() != surface_->node_count()) {
    problems << "positions of " << x.size() << " nodes; this query was made for "
             << surface_->node_count() << '\n';
    throw_if_any(problems);
  }
  for (std::size_t n = 0; n < x.size(); ++n) {
    const bool is_used = surface_->structure_of(id_at<NodeId>(n)) != StructureId{-1};
    if (is_used && !(x[n].cwiseAbs().maxCoeff() < kLargestCoordinate && x[n].allFinite())) {
      problems << "node " << n << " is at (" << x[n].transpose()
               << ") m; coordinates must be finite and below 1e75\n";
    }
  }
  throw_if_any(problems);
}

Box SurfaceQuery::box_of(CellId cell, double margin) const {
  return box_of_probe(probe_of(cell), margin);
}

Probe SurfaceQuery::probe_of(CellId cell) const {
  Probe probe{{}, surface_->radius(surface_->structure_of(cell))};
  for (const NodeId node : surface_->nodes_of(cell))
    probe.core.x[probe.core.count++] = x_[index_of(node)];
  return probe;
}

void SurfaceQuery::make_boxes() {
  boxes_.clear();
  cell_size_ = 0.0;
  for (std::size_t c = 0; c < surface_->cell_count(); ++c) {
    boxes_.push_back(box_of(id_at<CellId>(c), 0.0));
    const Box& box = boxes_.back();
    bounds_ =
        c == 0 ? box : Box{bounds_.lower.cwiseMin(box.lower), bounds_.upper.cwiseMax(box.upper)};
    cell_size_ += (box.upper - box.lower).norm();
  }
  if (!boxes_.empty()) cell_size_ /= static_cast<double>(boxes_.size());
}

/// Looks at the cells at most reach away from a probe.
void SurfaceQuery::improve(const Probe& probe, double reach, std::optional<NearestCell>& best,
                           Work& work) const {
  const PlacedSurface placed{*surface_, x_};
  const Box around = box_of_probe(probe, 0.0);
  tree_.query(box_of_probe(probe, reach), work.cells);
  for (const std::int32_t c : work.cells) {
    const CellId cell{c};
    const double least = distance(around, boxes_[static_cast<std::size_t>(c)]);
    if (best && least > 0.0 && least > best->proximity.gap * (1.0 + 1e-12)) continue;
    const Proximity found = proximity(probe, placed, cell);
    if (!best || found.gap < best->proximity.gap ||
        (found.gap == best->proximity.gap && cell < best->cell)) {
      best = NearestCell{cell, found};
    }
  }
}

std::optional<NearestCell> SurfaceQuery::nearest(const Probe& probe, Work& work) const {
  check_probe(probe);
  std::optional<NearestCell> best;
  if (boxes_.empty()) return best;
  // Every box is reached in the end, because the reach doubles; the bound of 1e-12 pays for
  // rounding in the boxes.
  double reach = distance(box_of_probe(probe, 0.0), bounds_) * (1.0 + 1e-12) + 0.5 * cell_size_;
  while (!best) {
    improve(probe, reach, best, work);
    if (!best) reach *= 2.0;
  }
  const double gap = best->proximity.gap * (1.0 + 1e-12);
  if (gap > reach) improve(probe, gap, best, work);
  return best;
}

std::optional<NearestCell> SurfaceQuery::nearest(const Probe& probe) const {
  Work work;
  return nearest(probe, work);
}

std::vector<NearestCell> SurfaceQuery::within(const Probe& probe, double gap) const {
  check_probe(probe);
  Work work;
  tree_.query(box_of_probe(probe, std::max(gap, 0.0) * (1.0 + 1e-12)), work.cells);
  std::vector<NearestCell> found;
  for (const std::int32_t c : work.cells) {
    const Proximity near = proximity(probe, {*surface_, x_}, CellId{c});
    if (near.gap < gap) found.push_back({CellId{c}, near});
  }
  return found;
}

/// Looks at all cells of this for one of the other that is nearer, or as near and lower.
void SurfaceQuery::improve(const SurfaceQuery& other, NearestCells& best, Work& work) const {
  const PlacedSurface here{*surface_, x_};
  const PlacedSurface there{*other.surface_, other.x_};
  for (std::size_t c = 0; c < boxes_.size(); ++c) {
    const CellId a = id_at<CellId>(c);
    const double reach = std::max(best.proximity.gap, 0.0) * (1.0 + 1e-12);
    if (distance(boxes_[c], other.bounds_) > reach) continue;
    other.tree_.query(box_of(a, reach), work.cells);
    for (const std::int32_t found : work.cells) {
      const CellId b{found};
      const Proximity near = proximity(here, a, there, b);
      const bool is_lower = a < best.a || (a == best.a && b < best.b);
      if (near.gap < best.proximity.gap || (near.gap == best.proximity.gap && is_lower))
        best = {a, b, near};
    }
  }
}

std::optional<NearestCells> SurfaceQuery::nearest(const SurfaceQuery& other) const {
  if (boxes_.empty() || other.boxes_.empty()) return std::nullopt;
  Work work;
  // To and fro while that leads nearer: a pair that is near, so that few cells are left to look at.
  CellId a{0};
  NearestCells best{};
  for (bool is_first = true;; is_first = false) {
    const NearestCell to = *other.nearest(probe_of(a), work);
    const NearestCell back = *nearest(other.probe_of(to.cell), work);
    if (!is_first && !(back.proximity.gap < best.proximity.gap)) break;
    best = {back.cell, to.cell, reversed(back.proximity)};
    a = back.cell;
  }
  best.proximity = proximity({*surface_, x_}, best.a, {*other.surface_, other.x_}, best.b);
  improve(other, best, work);
  return best;
}

/// m. Whatever hit() calls a hit at t or before is as near to the point at t or before, also in its
/// rounded box.
double SurfaceQuery::slack(const Ray& ray, double t) const {
  const double size = bounds_.lower.norm() + bounds_.upper.norm();
  return 4.0 * resolution(ray, t) + 1e-12 * size;
}

/// The first hit among the cells near a part of a ray.
std::optional<RayHit> SurfaceQuery::first_hit_near(const Ray& ray, double from, double to,
                                                   Work& work) const {
  const std::array<Vec3, 2> way{ray.origin + from * ray.direction, ray.origin + to * ray.direction};
  tree_.query(bounding_box(way, slack(ray, to)), work.cells);
  std::optional<RayHit> first;
  for (const std::int32_t c : work.cells) {
    const auto found = hit(ray, {*surface_, x_}, CellId{c});
    if (found && (!first || found->t < first->t)) first = found;
  }
  return first;
}

/// The part of the ray inside the ball around the surface is followed in pieces of a few cells.
std::optional<RayHit> SurfaceQuery::first_hit(const Ray& ray, Work& work) const {
  if (boxes_.empty() || !can_hit(ray)) return std::nullopt;
  const double speed = ray.direction.norm();
  const Vec3 centre = 0.5 * (bounds_.lower + bounds_.upper);
  const double nearest_t = (centre - ray.origin).dot(ray.direction / speed) / speed;
  const double margin = slack(ray, std::max(nearest_t, 0.0));
  const double radius = 0.5 * (bounds_.upper - bounds_.lower).norm() * (1.0 + 1e-9) + margin;
  const double begin = std::max(0.0, nearest_t - radius / speed);
  const double end = std::min(ray.t_end, nearest_t + radius / speed);
  if (!(begin <= end)) return std::nullopt;
  const double piece_length = 4.0 * (cell_size_ + margin);
  const double pieces = std::clamp(std::ceil((end - begin) * speed / piece_length), 1.0, 1e4);
  const auto t_at = [&](double piece) { return begin + (end - begin) * (piece / pieces); };
  for (double piece = 0.0; piece < pieces; ++piece) {
    const auto first = first_hit_near(ray, t_at(piece), t_at(piece + 1.0), work);
    // What is hit beyond the end of the piece may lie behind cells of the next one.
    const bool is_last = piece + 1.0 >= pieces;
    if (first && (is_last || first->t <= t_at(piece + 1.0))) return first;
  }
  return std::nullopt;
}

std::optional<RayHit> SurfaceQuery::first_hit(const Ray& ray) const {
  Work work;
  return first_hit(ray, work);
}

std::vector<std::optional<NearestCell>> SurfaceQuery::nearest(std::span<const Probe> probes,
                                                              ThreadPool& pool) const {
  std::vector<std::optional<NearestCell>> answers(probes.size());
  pool.for_each_range(probes.size(), [&](std::size_t begin, std::size_t end, int) {
    Work work;
    for (std::size_t i = begin; i < end; ++i) answers[i] = nearest(probes[i], work);
  });
  return answers;
}

std::vector<std::optional<RayHit>> SurfaceQuery::first_hits(std::span<const Ray> rays,
                                                            ThreadPool& pool) const {
  std::vector<std::optional<RayHit>> answers(rays.size());
  pool.for_each_range(rays.size(), [&](std::size_t begin, std::size_t end, int) {
    Work work;
    for (std::size_t i = begin; i < end; ++i) answers[i] = first_hit(rays[i], work);
  });
  return answers;
}

}  // namespace plekton::geometry
