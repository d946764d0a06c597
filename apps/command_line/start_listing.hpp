// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/run.hpp"
#include "geometry/primitives/box.hpp"

#include <string>
#include <vector>

namespace plekton::apps {

/// The box around a body, with its radius.
struct NamedBox {
  std::string name;  ///< as in "membranes.net"
  geometry::Box box;
  std::string comes_in = {};  ///< name of a later stage in which it comes; empty: it is there
};

/// Around membranes with their thickness, around grains, and around all of them that are there
/// ("everything"). Planes have none.
std::vector<NamedBox> boxes_at_start(const Scenario& scenario, const PreparedRun& prepared);

/// How a scene begins, in lines: the boxes around its bodies, the bonds that hold, who overlaps
/// whom, with the deepest places, and who begins inside of a closed membrane.
std::string listing_of_start(const Scenario& scenario, const PreparedRun& prepared);

}  // namespace plekton::apps
