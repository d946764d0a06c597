// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/surface_query.hpp"

#include "geometry/base/problems.hpp"
#include "geometry/query/number_checks.hpp"
#include "geometry/query/ray_search.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace plekton::geometry {
namespace {

/// @throws std::invalid_argument for numbers that no distance can be taken of
void check_probe(const Probe& probe) {
  if (is_usable(probe)) return;
  std::ostringstream problems;
  list_probe_problems(probe, problems);
  throw_if_any(problems);
}

/// Why a surface encloses nothing; empty if it does.
std::string reason_to_be_open(const Surface& surface) {
  if (surface.face_count() == 0) return "it has no facets";
  if (surface.cell_count() > surface.face_count())
    return "it has free cylinders, which enclose nothing; ask a surface of its facets alone";
  if (const auto edge = open_edge(surface)) {
    const auto& [a, b] = surface.nodes_of(*edge);
    std::ostringstream reason;
    reason << "the edge between nodes " << index_of(a) << " and " << index_of(b) << " has "
           << surface.faces_of(*edge).size()
           << " facets, but every edge needs an even number; close the hole, or merge the nodes of "
              "facets that only lie side by side";
    return reason.str();
  }
  return {};
}

}  // namespace

SurfaceQuery::SurfaceQuery(const Surface& surface, Positions x)
    : surface_(&surface), open_reason_(reason_to_be_open(surface)) {
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
  list_node_problems(x, problems, [this](std::size_t n) {
    return surface_->structure_of(id_at<NodeId>(n)) != StructureId{-1};
  });
  throw_if_any(problems);
}

ThickBox SurfaceQuery::box_of(CellId cell) const {
  const auto nodes = surface_->nodes_of(cell);
  Box box{x_[index_of(nodes[0])], x_[index_of(nodes[0])]};
  for (const NodeId node : nodes.subspan(1)) {
    box.lower = box.lower.cwiseMin(x_[index_of(node)]);
    box.upper = box.upper.cwiseMax(x_[index_of(node)]);
  }
  return {box, surface_->radius(surface_->structure_of(cell))};
}

void SurfaceQuery::make_boxes() {
  boxes_.clear();
  boxes_.reserve(surface_->cell_count());
  for (std::size_t c = 0; c < surface_->cell_count(); ++c) {
    boxes_.push_back(box_of(id_at<CellId>(c)));
    const auto& [box, radius] = boxes_.back();
    const Vec3 lower = box.lower.array() - radius, upper = box.upper.array() + radius;
    bounds_ = c == 0 ? Box{lower, upper}
                     : Box{bounds_.lower.cwiseMin(lower), bounds_.upper.cwiseMax(upper)};
  }
}

std::optional<NearestCell> SurfaceQuery::nearest(const Probe& probe) const {
  check_probe(probe);
  if (boxes_.empty()) return std::nullopt;
  return nearest_cell(probe, searched());
}

std::vector<NearestCell> SurfaceQuery::within(const Probe& probe, double gap) const {
  check_probe(probe);
  if (std::isnan(gap))
    throw std::invalid_argument("a gap of nan m; expected a length, infinite for all cells");
  // No cell is further away, and the squares of boxes' distances must be numbers.
  constexpr double kFurthest = 8.0 * kLargestCoordinate;
  const double margin = probe.radius + std::clamp(gap, 0.0, kFurthest) * (1.0 + 1e-12);
  std::vector<NearestCell> found;
  tree_.for_each_near(bounding_box(probe.core.corners(), margin), [&](std::int32_t item) {
    const Proximity near = proximity(probe, {*surface_, x_}, CellId{item});
    if (near.gap < gap) found.push_back({CellId{item}, near});
  });
  std::sort(found.begin(), found.end(),
            [](const NearestCell& p, const NearestCell& q) { return p.cell < q.cell; });
  return found;
}

std::optional<NearestCells> SurfaceQuery::nearest(const SurfaceQuery& other) const {
  if (boxes_.empty() || other.boxes_.empty()) return std::nullopt;
  return nearest_cells(searched(), other.searched());
}

std::optional<RayHit> SurfaceQuery::first_hit(const Ray& ray) const {
  return geometry::first_hit(ray, searched(), bounds_);
}

std::vector<RayHit> SurfaceQuery::all_hits(const Ray& ray) const {
  return geometry::all_hits(ray, searched(), bounds_);
}

void SurfaceQuery::require_closed() const {
  if (!is_closed()) throw std::logic_error("the surface is not closed: " + open_reason_);
}

Side SurfaceQuery::side_of(const Vec3& point) const {
  require_closed();
  check_probe(Probe::point(point));
  return geometry::side_of(point, searched(), bounds_);
}

SignedDistance SurfaceQuery::signed_distance(const Vec3& point) const {
  const Side side = side_of(point);
  const auto [nearest, distance] = nearest_core(Probe::point(point), searched());
  if (side == Side::on) return {0.0, side, nearest};  // the computed distance has a rounding error
  return {side == Side::inside ? -distance : distance, side, nearest};
}

std::vector<std::optional<NearestCell>> SurfaceQuery::nearest(std::span<const Probe> probes,
                                                              ThreadPool& pool) const {
  std::vector<std::optional<NearestCell>> answers(probes.size());
  std::atomic<bool> is_any_wrong = false;
  pool.for_each_range(probes.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!is_usable(probes[i])) {
        is_any_wrong = true;
        return;
      }
      if (!boxes_.empty()) answers[i] = nearest_cell(probes[i], searched());
    }
  });
  if (is_any_wrong) {
    std::ostringstream problems;
    list_probe_problems(probes, problems);
    throw_if_any(problems);
  }
  return answers;
}

std::vector<std::optional<RayHit>> SurfaceQuery::first_hits(std::span<const Ray> rays,
                                                            ThreadPool& pool) const {
  std::vector<std::optional<RayHit>> answers(rays.size());
  pool.for_each_range(rays.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) answers[i] = first_hit(rays[i]);
  });
  return answers;
}

}  // namespace plekton::geometry
