// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/generate/generators.hpp"

#include <array>

namespace plekton::geometry {

/// A tube with flat discs over some of its ends: a cylinder, a cup, a membrane around a sample.
///
/// A disc shares the nodes of the end of the tube. It is cut into rings around a node in its middle,
/// as wide as the cells of the tube are around, with nodes evenly on each: facets of nearly the same
/// size. It faces outward as the tube does, so that one with both ends is a closed mesh. Nodes of
/// the tube come first, as those of tube().
/// @param is_closed  at z = 0, and at its length
/// @throws MeshError as tube()
Mesh closed_tube(const Tube& tube, const std::array<bool, 2>& is_closed);

}  // namespace plekton::geometry
