// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <compare>
#include <ostream>

namespace plekton::geometry {

enum class FeatureKind : std::uint8_t { node, edge, face };

/// A node, edge or face of a Surface: what a closest point lies in the interior of.
struct Feature {
  FeatureKind kind = FeatureKind::node;
  std::int32_t id = -1;  ///< NodeId, EdgeId or FaceId, by kind

  constexpr Feature() = default;
  constexpr explicit Feature(NodeId node)
      : kind(FeatureKind::node), id(static_cast<std::int32_t>(node)) {}
  constexpr explicit Feature(EdgeId edge)
      : kind(FeatureKind::edge), id(static_cast<std::int32_t>(edge)) {}
  constexpr explicit Feature(FaceId face)
      : kind(FeatureKind::face), id(static_cast<std::int32_t>(face)) {}

  /// Nodes before edges before faces, then by id.
  friend constexpr auto operator<=>(const Feature&, const Feature&) = default;
};

inline std::ostream& operator<<(std::ostream& out, const Feature& feature) {
  constexpr const char* kNames[] = {"node", "edge", "face"};
  return out << kNames[static_cast<std::size_t>(feature.kind)] << ' ' << feature.id;
}

}  // namespace plekton::geometry
