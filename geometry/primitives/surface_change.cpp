// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/primitives/surface_change.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace plekton::geometry {
namespace {

/// By their nodes, where both lists have what the other one has not.
template <class Id>
std::vector<Id> sought_ids(const Surface& before, std::size_t count, const Surface& after,
                           std::size_t now) {
  using Nodes = std::remove_cvref_t<decltype(after.nodes_of(Id{0}))>;
  std::vector<std::pair<Nodes, Id>> places;
  for (std::size_t i = 0; i < now; ++i)
    places.emplace_back(after.nodes_of(id_at<Id>(i)), id_at<Id>(i));
  std::sort(places.begin(), places.end());
  std::vector<Id> ids;
  for (std::size_t old = 0; old < count; ++old) {
    const Nodes& nodes = before.nodes_of(id_at<Id>(old));
    const auto found = std::lower_bound(places.begin(), places.end(), std::pair(nodes, Id{-1}));
    ids.push_back(found != places.end() && found->first == nodes ? found->second : Id{-1});
  }
  return ids;
}

/// New ids by old ones: both lists have the same order, so where nothing has come the first that is
/// alike is the one.
template <class Id>
std::vector<Id> new_ids(const Surface& before, std::size_t count, const Surface& after,
                        std::size_t left) {
  std::vector<Id> ids(count, Id{-1});
  std::size_t next = 0;
  for (std::size_t old = 0; old < count && next < left; ++old) {
    if (before.nodes_of(id_at<Id>(old)) != after.nodes_of(id_at<Id>(next))) continue;
    ids[old] = id_at<Id>(next++);
  }
  if (next < left) return sought_ids<Id>(before, count, after, left);
  return ids;
}

}  // namespace

SurfaceChange::SurfaceChange(const Surface& before, const Surface& after)
    : before_(&before),
      after_(&after),
      edges_(new_ids<EdgeId>(before, before.edge_count(), after, after.edge_count())),
      faces_(new_ids<FaceId>(before, before.face_count(), after, after.face_count())) {}

std::optional<Feature> SurfaceChange::now(Feature feature) const noexcept {
  switch (feature.kind) {
    case FeatureKind::node:
      if (after_->structure_of(NodeId{feature.id}) == StructureId{-1}) return std::nullopt;
      return feature;
    case FeatureKind::edge: {
      const EdgeId edge = edges_[static_cast<std::size_t>(feature.id)];
      return edge == EdgeId{-1} ? std::nullopt : std::optional(Feature(edge));
    }
    case FeatureKind::face:
      break;
  }
  const FaceId face = faces_[static_cast<std::size_t>(feature.id)];
  return face == FaceId{-1} ? std::nullopt : std::optional(Feature(face));
}

std::optional<CellId> SurfaceChange::now(CellId cell) const noexcept {
  const std::optional<Feature> feature = now(before_->feature_of(cell));
  if (!feature) return std::nullopt;
  if (feature->kind == FeatureKind::face) return CellId{feature->id};
  return after_->owner_of(EdgeId{feature->id});
}

std::vector<CellId> SurfaceChange::left_of(CellId cell) const {
  if (const std::optional<CellId> same = now(cell)) return {*same};
  std::vector<CellId> sides;
  if (index_of(cell) >= before_->face_count()) return sides;
  for (const EdgeId edge : before_->edges_of(id_at<FaceId>(index_of(cell)))) {
    const EdgeId left = edges_[index_of(edge)];
    if (left != EdgeId{-1} && after_->faces_of(left).empty())
      sides.push_back(after_->owner_of(left));
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

}  // namespace plekton::geometry
