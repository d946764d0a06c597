// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/loads.hpp"
#include "geometry/primitives/facet.hpp"

#include <array>
#include <cstddef>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>

namespace plekton::dynamics {

struct Scene;

/// Whether facets have no rim: each side belongs to as many facets in one direction as in the
/// other.
bool are_closed(std::span<const geometry::Facet> facets);

/// Two of them, by place, that share a side and face opposite ways there; nothing if there are none.
std::optional<std::array<std::size_t, 2>> opposite_neighbours(
    std::span<const geometry::Facet> facets);

/// Pa, absolute, the lowest at any time that a load gives its gas in the volume of the start.
/// @param load  has a gas
double lowest_gas_pressure(const SurfacePressure& load) noexcept;

/// Writes a line for everything that is wrong with a pressure: facets that do not exist or are
/// named twice, neighbours that face opposite ways, a gas that is not enclosed, numbers out of
/// range.
/// @param name  how the lines begin, as in "surface pressure 0"
void list_problems(const SurfacePressure& load, const Scene& scene, const std::string& name,
                   std::ostream& problems);

}  // namespace plekton::dynamics
